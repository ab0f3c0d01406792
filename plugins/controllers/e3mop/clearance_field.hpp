// SPDX-License-Identifier: MIT
// clearance_field.hpp: the distance field of the costmap's window, for the lattice search and the path smoothing.
#pragma once

#include <dmrp/ext/distance_field.h>

#include <algorithm>
#include <cstdint>
#include <dmrp/cpp/local_controller.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

namespace dmrp::controllers::e3mop {

struct Clearance {
  double distance_m = 0.0;
  Vec2 gradient = {0.0, 0.0};  // of the distance; dimensionless
};

// A copy of the field, to which the motion of agents can be added. Points outside the window count as its border.
class ClearanceField {
 public:
  void read(const dmrp_field& field);

  // Adds the area that a disc sweeps from one point to another as an obstacle; distances inside it become 0.
  void add_swept_disc(Vec2 from, Vec2 to, double radius_m);

  bool contains(Vec2 point) const {
    return point.x >= origin_.x && point.y >= origin_.y && point.x < upper_.x && point.y < upper_.y;
  }
  Vec2 lower() const { return origin_; }
  Vec2 upper() const { return upper_; }
  double resolution_m() const { return resolution_m_; }

  // The distance of the cell that contains the point.
  float of_cell(Vec2 point) const {
    const auto column = std::clamp(static_cast<std::int32_t>((point.x - origin_.x) * cells_per_m_), 0, width_ - 1);
    const auto row = std::clamp(static_cast<std::int32_t>((point.y - origin_.y) * cells_per_m_), 0, height_ - 1);
    return distances_m_[static_cast<std::size_t>(row * width_ + column)];
  }

  // The distance interpolated bilinearly between the cells' centres, and the gradient of the interpolation.
  Clearance at(Vec2 point) const;

 private:
  std::int32_t width_ = 0;
  std::int32_t height_ = 0;
  double resolution_m_ = 1.0;
  double cells_per_m_ = 1.0;
  Vec2 origin_ = {0.0, 0.0};
  Vec2 upper_ = {0.0, 0.0};
  double distance_max_m_ = 0.0;
  std::vector<float> distances_m_;
};

}  // namespace dmrp::controllers::e3mop
