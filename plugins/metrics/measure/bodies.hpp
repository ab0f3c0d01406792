// SPDX-License-Identifier: MIT
// bodies.hpp: robots and people as discs in the world frame.
#pragma once

#include <cmath>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>

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

// The least surface distance from a disc to discs added one by one. Computes a square root only for nearer ones.
class NearestDisc {
 public:
  explicit NearestDisc(const Disc& own) : own_(own) {}
  void add(const Disc& other) {
    const double reach_m = distance_m_ + own_.radius_m + other.radius_m;
    const double squared_distance = toolkit::squared_distance(own_.center, other.center);
    if (reach_m > 0.0 && squared_distance < reach_m * reach_m) distance_m_ = surface_distance(own_, other);
  }

  // NaN if no disc was added.
  double distance_m() const { return std::isinf(distance_m_) ? undefined : distance_m_; }

 private:
  Disc own_;
  double distance_m_ = std::numeric_limits<double>::infinity();
};

// The measured velocity in the world frame, m/s. (Samples hold it in the robot's frame.)
inline Vec2 world_velocity(const RobotSample& robot) {
  return toolkit::rotate({robot.velocity.v_x, robot.velocity.v_y}, robot.pose.theta);
}

}  // namespace dmrp::metrics
