// SPDX-License-Identifier: MIT
// clearance_field.hpp: the distance field of the costmap's window, as the search and the smoothing read it.
#ifndef DMRP_CONTROLLERS_E3MOP_CLEARANCE_FIELD_HPP
#define DMRP_CONTROLLERS_E3MOP_CLEARANCE_FIELD_HPP

#include <dmrp/ext/distance_field.h>

#include <algorithm>
#include <cstdint>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

namespace dmrp::controllers::e3mop {

struct Clearance {
  double distance_m = 0.0;
  dmrp_vec2 gradient = {0.0, 0.0};  // of the distance, 1
};

// A copy of the field, with what is known of others' motion added to it. Outside the window counts as its border.
class ClearanceField {
 public:
  void read(const dmrp_field& field);

  // Adds a disc that moves from one point to the other, with its inside: distances become those to its outline, 0
  // inside.
  void add_swept_disc(dmrp_vec2 from, dmrp_vec2 to, double radius_m);

  bool contains(dmrp_vec2 point) const {
    return point.x >= origin_.x && point.y >= origin_.y && point.x < upper_.x && point.y < upper_.y;
  }
  dmrp_vec2 lower() const { return origin_; }
  dmrp_vec2 upper() const { return upper_; }
  double resolution_m() const { return resolution_m_; }

  // Of the cell that holds the point.
  float of_cell(double x, double y) const {
    const auto column = std::clamp(static_cast<std::int32_t>((x - origin_.x) * cells_per_m_), 0, width_ - 1);
    const auto row = std::clamp(static_cast<std::int32_t>((y - origin_.y) * cells_per_m_), 0, height_ - 1);
    return distances_m_[static_cast<std::size_t>(row * width_ + column)];
  }

  // Interpolated bilinearly between the cells' centres, with the gradient of just that.
  Clearance at(dmrp_vec2 point) const;

 private:
  std::int32_t width_ = 0;
  std::int32_t height_ = 0;
  double resolution_m_ = 1.0;
  double cells_per_m_ = 1.0;
  dmrp_vec2 origin_ = {0.0, 0.0};
  dmrp_vec2 upper_ = {0.0, 0.0};
  double distance_max_m_ = 0.0;
  std::vector<float> distances_m_;
};

}  // namespace dmrp::controllers::e3mop

#endif
