// SPDX-License-Identifier: MIT
// bodies.hpp: robots and people as discs in the world frame.
#pragma once

#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::metrics {

struct Disc {
  Vec2 center;
  double radius_m;
};

// A polygonal footprint counts as its circumscribed circle.
inline Disc disc_of(const Robot& robot, const RobotSample& now) {
  return {toolkit::position(now.pose), robot.footprint->radius_m};
}

inline Disc disc_of(const Person& person) {
  return {person.position, person.radius_m};
}

// Negative where they overlap.
inline double surface_distance(const Disc& a, const Disc& b) {
  return toolkit::distance(a.center, b.center) - a.radius_m - b.radius_m;
}

// The measured velocity in the world frame, m/s. (Samples hold it in the robot's frame.)
inline Vec2 world_velocity(const RobotSample& robot) {
  return toolkit::rotate({robot.velocity.v_x, robot.velocity.v_y}, robot.pose.theta);
}

}  // namespace dmrp::metrics
