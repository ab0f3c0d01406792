// SPDX-License-Identifier: MIT
// distance_transform.hpp: the exact Euclidean distance of every cell to the nearest obstacle cell.
//
// Felzenszwalb and Huttenlocher: Distance transforms of sampled functions, Theory of Computing 8 (2012): linear in the
// number of cells. Columns first, by two running counts, which is what their lower envelope comes to for a mask; then
// every row as the lower envelope of parabolas. Squared distances are integers, so the answer is exact up to the last
// rounding to float.
#ifndef DMRP_TOOLKIT_DISTANCE_TRANSFORM_HPP
#define DMRP_TOOLKIT_DISTANCE_TRANSFORM_HPP

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

namespace dmrp::toolkit {

// Keeps its buffers: no allocation after the first call on the largest grid.
class DistanceTransform {
 public:
  // Row-major cells, index = row * width + column, up to 30,000 a side. `is_obstacle(index)` is asked once a cell, in
  // the order of the indices. Gives metres between cell centres, 0 in an obstacle, `cap_m` where the nearest is
  // further away or there is none (infinity by default). The reference holds until the next call.
  template <class IsObstacle, class = std::enable_if_t<std::is_invocable_v<const IsObstacle&, std::size_t>>>
  const std::vector<float>& compute(std::uint32_t width, std::uint32_t height, double resolution_m,
                                    const IsObstacle& is_obstacle,
                                    double cap_m = std::numeric_limits<double>::infinity()) {
    width_ = width;
    height_ = height;
    resolution_m_ = resolution_m;
    cap_m_ = cap_m;
    reach_cells_ = static_cast<std::int32_t>(std::min(std::ceil(cap_m / resolution_m), far - 1.0));
    reserve();
    measure_columns(is_obstacle);
    for (std::size_t row = 0; row < height_; ++row) measure_row(row);
    return distances_m_;
  }

  // From a mask: nonzero is an obstacle.
  const std::vector<float>& compute(std::uint32_t width, std::uint32_t height, double resolution_m,
                                    const std::uint8_t* mask, double cap_m = std::numeric_limits<double>::infinity()) {
    return compute(
        width, height, resolution_m, [mask](std::size_t index) { return mask[index] != 0; }, cap_m);
  }

 private:
  static constexpr std::int32_t far = 40000;  // more than any distance along a column, its square within int32

  void reserve() {
    distances_m_.resize(width_ * height_);
    column_distances_.resize(width_ * height_);
    apexes_.resize(width_);
    heights_.resize(width_);
    borders_.resize(width_ + 1);
  }

  // Cells to the nearest obstacle of the same column: down, then up.
  template <class IsObstacle>
  void measure_columns(const IsObstacle& is_obstacle) {
    for (std::size_t index = 0; index < width_ * height_; ++index) {
      const std::int32_t below = index >= width_ ? column_distances_[index - width_] + 1 : far;
      column_distances_[index] = is_obstacle(index) ? 0 : std::min(below, far);
    }
    for (std::size_t index = width_ * (height_ - (height_ > 0)); index-- > 0;)
      column_distances_[index] = std::min(column_distances_[index], column_distances_[index + width_] + 1);
  }

  // The lower envelope of one parabola a column: apexes_ are their columns, borders_[k] is where number k begins.
  std::size_t build_envelope(const std::int32_t* column_distances) {
    std::size_t count = 0;
    for (std::size_t column = 0; column < width_; ++column) {
      const std::int64_t distance = column_distances[column];
      if (distance > reach_cells_) continue;  // beyond the cap, or no obstacle in the column
      const std::int64_t apex = static_cast<std::int64_t>(column);
      const std::int64_t height = distance * distance;
      double begin = -std::numeric_limits<double>::infinity();
      while (count > 0) {
        const std::int64_t other = apexes_[count - 1];
        begin = static_cast<double>(height + apex * apex - heights_[count - 1] - other * other) /
                static_cast<double>(2 * (apex - other));
        if (begin > borders_[count - 1]) break;
        --count;
        begin = -std::numeric_limits<double>::infinity();
      }
      apexes_[count] = apex;
      heights_[count] = height;
      borders_[count] = begin;
      ++count;
    }
    borders_[count] = std::numeric_limits<double>::infinity();
    return count;
  }

  void measure_row(std::size_t row) {
    float* distances = distances_m_.data() + row * width_;
    if (build_envelope(column_distances_.data() + row * width_) == 0) {
      std::fill(distances, distances + width_, static_cast<float>(cap_m_));
      return;
    }
    std::size_t k = 0;
    for (std::size_t column = 0; column < width_; ++column) {
      while (borders_[k + 1] < static_cast<double>(column)) ++k;
      const std::int64_t aside = static_cast<std::int64_t>(column) - apexes_[k];
      const double squared = static_cast<double>(aside * aside + heights_[k]);
      distances[column] = static_cast<float>(std::min(std::sqrt(squared) * resolution_m_, cap_m_));
    }
  }

  std::size_t width_ = 0;
  std::size_t height_ = 0;
  double resolution_m_ = 1.0;
  double cap_m_ = 0.0;
  std::int32_t reach_cells_ = 0;
  std::vector<float> distances_m_;
  std::vector<std::int32_t> column_distances_;
  std::vector<std::int64_t> apexes_;
  std::vector<std::int64_t> heights_;
  std::vector<double> borders_;
};

}  // namespace dmrp::toolkit

#endif
