// SPDX-License-Identifier: MIT
// free_space.hpp: the collision check of a robot against the distance field.
#pragma once

#include <dmrp/cpp/local_controller.hpp>
#include <dmrp/toolkit/angle.hpp>

#include "controllers/e3mop/clearance_field.hpp"
#include "controllers/motion/footprint_check.hpp"

namespace dmrp::controllers::e3mop {

// A disc is free if the distance to the nearest obstacle is at least its radius and the padding. Polygons are free if
// that holds for their circumscribed circle, and in collision if it fails for the inscribed circle; in between, their
// outlines decide.
//
// A robot that already stands too close to an obstacle may move near its position as long as it comes no closer.
class FreeSpace {
 public:
  // `outline` checks polygons; if it is NULL, they count as their circumscribed circle.
  FreeSpace(const ClearanceField& field, const Footprint& footprint, double padding_m, const Pose& now,
            const FootprintCheck* outline = nullptr)
      : field_(&field), outline_(footprint.part_count > 0 ? outline : nullptr), start_(toolkit::position(now)) {
    const double radius_m = outline_ ? footprint.inscribed_radius_m : footprint.radius_m;
    surely_m_ = static_cast<float>(footprint.radius_m + padding_m);
    needed_m_ = static_cast<float>(radius_m + padding_m);
    const double start_clearance_m = field.at(start_).distance_m;
    escapes_ = start_clearance_m < needed_m_ + 0.7 * field.resolution_m();
    // the tolerance must not add up from period to period: near contact, the robot may come no closer. The corner of an
    // obstacle lies up to 0.7 cells beyond the centre of its cell, from which distances count; the other 0.25 cells, of
    // 0.05 m, are more than the 0.01 m that a collision monitor keeps.
    const double nearest_m = radius_m + 0.95 * field.resolution_m();
    tolerated_m_ = std::max(std::min<double>(start_clearance_m, needed_m_) - variation_m,
                            std::min(start_clearance_m, nearest_m) - least_variation_m);
  }

  // The clearance that the robot's centre needs at any heading.
  double needed_m() const { return needed_m_; }

  bool is_free(const DirectedPoint& robot) const {
    const double clearance_m = field_->at(robot.at).distance_m;
    if (clearance_m >= surely_m_) return true;
    if (clearance_m < needed_m_) return tolerated(robot.at);
    return !outline_ || outline_->cost(robot) != in_collision;
  }

  // Whether the robot can stand at a point at some heading; of a polygon, eight are tried.
  bool can_stand(Vec2 at) const {
    const int headings = outline_ ? 8 : 1;
    for (int k = 0; k < headings; ++k)
      if (is_free(directed(at, 2.0 * toolkit::pi * k / headings))) return true;
    return false;
  }

  // Whether a robot that already stands too close to an obstacle may be at a point that is too close as well.
  bool tolerated(Vec2 at) const {
    return escapes_ && toolkit::squared_distance(start_, at) < escape_reach_m * escape_reach_m &&
           field_->at(at).distance_m >= tolerated_m_;
  }

 private:
  // The longest distance that an escape may lead through points that are too close.
  static constexpr double escape_reach_m = 0.6;
  // The interpolated distance varies by this much along a wall.
  static constexpr double variation_m = 0.01;
  static constexpr double least_variation_m = 1e-4;

  const ClearanceField* field_;
  const FootprintCheck* outline_;
  Vec2 start_;
  bool escapes_ = false;  // the robot stands too close to an obstacle, or nearly so
  double tolerated_m_ = 0.0;
  float surely_m_;
  float needed_m_;
};

}  // namespace dmrp::controllers::e3mop
