// SPDX-License-Identifier: MIT
#include "controllers/e3mop/clearance_field.hpp"

#include <cmath>
#include <dmrp/toolkit/segment.hpp>

namespace dmrp::controllers::e3mop {

void ClearanceField::read(const dmrp_field& field) {
  width_ = static_cast<std::int32_t>(field.width);
  height_ = static_cast<std::int32_t>(field.height);
  resolution_m_ = field.resolution_m;
  cells_per_m_ = 1.0 / field.resolution_m;
  origin_ = field.origin;
  upper_ = field.origin + Vec2{width_ * resolution_m_, height_ * resolution_m_};
  distance_max_m_ = field.distance_max_m;
  distances_m_.assign(field.distances_m, field.distances_m + std::size_t{field.width} * field.height);
}

void ClearanceField::add_swept_disc(Vec2 from, Vec2 to, double radius_m) {
  // neither the search nor the smoothing uses larger distances
  const double reach_m = radius_m + std::min(distance_max_m_, 1.0);
  const auto cell = [this](double along_m, std::int32_t count) {
    return std::clamp(static_cast<std::int32_t>(std::floor(along_m * cells_per_m_)), 0, count - 1);
  };
  const std::int32_t first_column = cell(std::min(from.x, to.x) - reach_m - origin_.x, width_);
  const std::int32_t last_column = cell(std::max(from.x, to.x) + reach_m - origin_.x, width_);
  const std::int32_t first_row = cell(std::min(from.y, to.y) - reach_m - origin_.y, height_);
  const std::int32_t last_row = cell(std::max(from.y, to.y) + reach_m - origin_.y, height_);
  const Segment path = {from, to};
  for (std::int32_t row = first_row; row <= last_row; ++row) {
    for (std::int32_t column = first_column; column <= last_column; ++column) {
      const Vec2 center = origin_ + resolution_m_ * Vec2{column + 0.5, row + 0.5};
      float& distance_m = distances_m_[static_cast<std::size_t>(row * width_ + column)];
      const double to_center_m = toolkit::distance(center, toolkit::closest_point(path, center));
      distance_m = std::min(distance_m, static_cast<float>(std::max(0.0, to_center_m - radius_m)));
    }
  }
}

Clearance ClearanceField::at(Vec2 point) const {
  const double x = std::clamp((point.x - origin_.x) * cells_per_m_ - 0.5, 0.0, width_ - 1.0);
  const double y = std::clamp((point.y - origin_.y) * cells_per_m_ - 0.5, 0.0, height_ - 1.0);
  const auto column = std::min(static_cast<std::int32_t>(x), width_ - 2);
  const auto row = std::min(static_cast<std::int32_t>(y), height_ - 2);
  const double right = x - column;
  const double up = y - row;
  const float* below = distances_m_.data() + static_cast<std::size_t>(row * width_ + column);
  const float* above = below + width_;
  const double low = below[0] + right * (below[1] - below[0]);
  const double high = above[0] + right * (above[1] - above[0]);
  const double slope_low = below[1] - below[0];
  const double slope_high = above[1] - above[0];
  return {low + up * (high - low),
          {cells_per_m_ * (slope_low + up * (slope_high - slope_low)), cells_per_m_ * (high - low)}};
}

}  // namespace dmrp::controllers::e3mop
