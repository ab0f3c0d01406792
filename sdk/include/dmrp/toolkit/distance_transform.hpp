// SPDX-License-Identifier: MIT
// distance_transform.hpp: the exact Euclidean distance of every cell to the nearest obstacle cell.
//
// Felzenszwalb and Huttenlocher: Distance transforms of sampled functions, Theory of Computing 8 (2012): linear in the
// number of cells. Columns first, by two running counts, the lower envelope's special case for a mask; then every row
// as the lower envelope of parabolas. Squared distances are integers, so the result is exact up to the final rounding
// to float.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "../abi.h"

namespace dmrp::toolkit {

// Keeps its buffers: no allocation after the first call on the largest grid.
class DistanceTransform {
 public:
  // Row-major cells, index = row * width + column, at most 30,000 per side. Calls `is_obstacle(index)` once per cell,
  // in the order of the indices. Returns metres between cell centres: 0 in an obstacle, `cap_m` (infinity by default)
  // where the nearest obstacle is farther away or there is none. The reference is valid until the next call.
  template <class IsObstacle, class = std::enable_if_t<std::is_invocable_v<const IsObstacle&, std::size_t>>>
  const std::vector<float>& compute(std::uint32_t width, std::uint32_t height, double resolution_m,
                                    const IsObstacle& is_obstacle,
                                    double cap_m = std::numeric_limits<double>::infinity()) {
    assert(width <= 30000 && height <= 30000 && resolution_m > 0.0);
    width_ = width;
    height_ = height;
    if (resolution_m != resolution_m_ || cap_m != cap_m_) tabled_m_.clear();
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
  // More than any distance along a column, its square within int32.
  DMRP_LOCAL static constexpr std::int32_t far = 40000;

  DMRP_LOCAL static constexpr std::int64_t most_tabled = 1 << 16;

  void reserve() {
    distances_m_.resize(width_ * height_);
    column_distances_.resize(width_ * height_);
    apexes_.resize(width_);
    heights_.resize(width_);
    begins_.resize(width_ + 1);
    const std::size_t squares = width_ * width_ + height_ * height_;
    while (tabled_m_.size() < std::min<std::size_t>(squares, most_tabled))
      tabled_m_.push_back(metres(static_cast<std::int64_t>(tabled_m_.size())));
  }

  float metres(std::int64_t squared_cells) const {
    return static_cast<float>(std::min(std::sqrt(static_cast<double>(squared_cells)) * resolution_m_, cap_m_));
  }

  // Cells to the nearest obstacle of the same column: up, then down.
  template <class IsObstacle>
  void measure_columns(const IsObstacle& is_obstacle) {
    std::int32_t* distances = column_distances_.data();
    for (std::size_t column = 0; column < std::min(width_, width_ * height_); ++column)
      distances[column] = is_obstacle(column) ? 0 : far;
    for (std::size_t row = 1; row < height_; ++row) {
      const std::int32_t* const before = distances;
      distances += width_;
      for (std::size_t column = 0; column < width_; ++column)
        distances[column] = std::min(before[column] + 1, far) * !is_obstacle(row * width_ + column);
    }
    for (std::size_t row = height_; row-- > 1;) {
      const std::int32_t* const before = distances;
      distances -= width_;
      for (std::size_t column = 0; column < width_; ++column)
        distances[column] = std::min(distances[column], before[column] + 1);
    }
  }

  // The lower envelope of one parabola per column: apexes_ holds the columns of the parabolas in the envelope,
  // begins_[k] the first column where parabola k is the lowest.
  std::size_t build_envelope(const std::int32_t* column_distances) {
    const auto width = static_cast<std::int64_t>(width_);
    std::size_t count = 0;
    for (std::int64_t apex = 0; apex < width; ++apex) {
      const std::int64_t distance = column_distances[apex];
      if (distance > reach_cells_) continue;  // beyond the cap, or no obstacle in the column
      const std::int64_t height = distance * distance;
      while (count > 0) {
        const std::int64_t at = begins_[count - 1];
        if (square(at - apex) + height > square(at - apexes_[count - 1]) + heights_[count - 1]) break;
        --count;
      }
      std::int64_t begin = 0;
      if (count > 0) {
        const std::int64_t other = apexes_[count - 1];
        const std::int64_t dividend = height + square(apex) - heights_[count - 1] - square(other);
        const std::int64_t divisor = 2 * (apex - other);
        if (dividend >= divisor * (width - 1)) continue;  // nowhere the lowest
        // A double is exact enough: the quotient is an integer or far from the next one.
        begin = static_cast<std::int64_t>(static_cast<double>(dividend) / static_cast<double>(divisor)) + 1;
      }
      apexes_[count] = apex;
      heights_[count] = height;
      begins_[count] = begin;
      ++count;
    }
    begins_[count] = width;
    return count;
  }

  void measure_row(std::size_t row) {
    float* distances = distances_m_.data() + row * width_;
    const std::size_t count = build_envelope(column_distances_.data() + row * width_);
    if (count == 0) std::fill(distances, distances + width_, static_cast<float>(cap_m_));
    for (std::size_t k = 0; k < count; ++k) {
      for (std::int64_t column = begins_[k]; column < begins_[k + 1]; ++column) {
        const std::int64_t squared = square(column - apexes_[k]) + heights_[k];
        distances[column] = squared < static_cast<std::int64_t>(tabled_m_.size())
                                ? tabled_m_[static_cast<std::size_t>(squared)]
                                : metres(squared);
      }
    }
  }

  static std::int64_t square(std::int64_t value) { return value * value; }

  std::size_t width_ = 0;
  std::size_t height_ = 0;
  double resolution_m_ = 1.0;
  double cap_m_ = 0.0;
  std::int32_t reach_cells_ = 0;
  std::vector<float> distances_m_;
  std::vector<std::int32_t> column_distances_;
  std::vector<std::int64_t> apexes_;
  std::vector<std::int64_t> heights_;
  std::vector<std::int64_t> begins_;
  std::vector<float> tabled_m_;  // metres, indexed by the squared distance in cells
};

}  // namespace dmrp::toolkit
