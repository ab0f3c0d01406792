// SPDX-License-Identifier: MIT
// free_space.hpp: where the robot can stand, by the distance field.
#ifndef DMRP_CONTROLLERS_E3MOP_FREE_SPACE_HPP
#define DMRP_CONTROLLERS_E3MOP_FREE_SPACE_HPP

#include <dmrp/cpp/local_controller.hpp>

#include "controllers/e3mop/clearance_field.hpp"
#include "controllers/motion/footprint_check.hpp"

namespace dmrp::controllers::e3mop {

// A disc stands where the distance is its radius and the padding. A polygon stands where that holds for the circle
// about it, never where the one inside it fails, and in between where its outline meets no lethal cell.
//
// A robot that stands too near to something already may move about its place as long as it comes no nearer.
class FreeSpace {
 public:
  // `outline` is for polygons; NULL makes a polygon count as the circle about it.
  FreeSpace(const ClearanceField& field, const Footprint& footprint, double padding_m, const Pose& now,
            const FootprintCheck* outline = nullptr)
      : field_(&field), outline_(footprint.vertex_count > 0 ? outline : nullptr), start_(toolkit::position(now)) {
    const double radius_m = outline_ ? footprint.inscribed_radius_m : footprint.radius_m;
    surely_m_ = static_cast<float>(footprint.radius_m + padding_m);
    needed_m_ = static_cast<float>(radius_m + padding_m);
    const double start_clearance_m = field.at(start_).distance_m;
    escapes_ = start_clearance_m < needed_m_ + 0.7 * field.resolution_m();
    // not period after period: a robot that would then touch comes no nearer at all
    const double nearest_m = radius_m + 0.85 * field.resolution_m();
    tolerated_m_ = std::max(std::min<double>(start_clearance_m, needed_m_) - waver_m,
                            std::min(start_clearance_m, nearest_m) - least_waver_m);
  }

  // How far a place must be from every obstacle, whatever the heading.
  double needed_m() const { return needed_m_; }

  bool is_free(const ArcState& at) const {
    const float clearance_m = field_->of_cell(at.x, at.y);
    if (clearance_m >= surely_m_) return true;
    if (clearance_m < needed_m_) return tolerated(at);
    return !outline_ || outline_->cost(at) != in_collision;
  }

  // Whether a robot that stands too near to something may be at this place, whose cell is too near too.
  bool tolerated(const ArcState& at) const {
    if (!escapes_) return false;
    const double dx = at.x - start_.x;
    const double dy = at.y - start_.y;
    return dx * dx + dy * dy < escape_reach_m * escape_reach_m && field_->at({at.x, at.y}).distance_m >= tolerated_m_;
  }

 private:
  // How far an escape may lead through places that are too near.
  static constexpr double escape_reach_m = 0.6;
  // Along a wall the distance wavers by so much.
  static constexpr double waver_m = 0.01;
  static constexpr double least_waver_m = 1e-4;

  const ClearanceField* field_;
  const FootprintCheck* outline_;
  Vec2 start_;
  bool escapes_ = false;  // the robot's own place is too near to something, or nearly so
  double tolerated_m_ = 0.0;
  float surely_m_;
  float needed_m_;
};

}  // namespace dmrp::controllers::e3mop

#endif
