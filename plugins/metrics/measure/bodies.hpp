// SPDX-License-Identifier: MIT
// bodies.hpp: robots and people as discs in the world frame, and when two of them touch.
#pragma once

#include <cmath>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/neighbour_grid.hpp>
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

// |v| as measured, not as commanded, m/s. (sqrt is correctly rounded in every libm, hypot is not.)
inline double speed_of(const RobotSample& robot) {
  return std::sqrt(robot.velocity.v_x * robot.velocity.v_x + robot.velocity.v_y * robot.velocity.v_y);
}

// The measured velocity in the world frame, m/s. (Samples hold it in the robot's frame.)
inline Vec2 world_velocity(const RobotSample& robot) {
  return toolkit::rotate({robot.velocity.v_x, robot.velocity.v_y}, robot.pose.theta);
}

struct Moving {
  Disc disc;
  Vec2 velocity;  // m/s, world frame
};

inline Moving moving(const Robot& robot, const RobotSample& now) {
  return {disc_of(robot, now), world_velocity(now)};
}

inline Moving moving(const Person& person) {
  return {disc_of(person), person.velocity};
}

// The smallest tau > 0 with |dp + dv tau| = r1 + r2; 0 if they overlap already, NaN if they never meet.
inline double time_to_contact(const Moving& a, const Moving& b) {
  const Vec2 apart = b.disc.center - a.disc.center;
  const Vec2 drift = b.velocity - a.velocity;
  const double reach_m = a.disc.radius_m + b.disc.radius_m;
  const double gap = toolkit::squared_norm(apart) - reach_m * reach_m;
  if (gap < 0.0) return 0.0;
  const double approach = -toolkit::dot(apart, drift);
  if (!(approach > 0.0)) return undefined;
  const double discriminant = approach * approach - toolkit::squared_norm(drift) * gap;
  if (discriminant < 0.0) return undefined;
  return gap / (approach + std::sqrt(discriminant));  // the smaller root, without cancellation
}

// The side of cells in which bodies are looked for, about their usual distance.
constexpr double near_m = 2.0;

inline void sort_robots(toolkit::NeighbourGrid& grid, const Sample& sample) {
  grid.build(sample.robots.size(), near_m,
             [&](std::size_t robot) { return toolkit::position(sample.robots[robot].pose); });
}

inline void sort_people(toolkit::NeighbourGrid& grid, const Sample& sample) {
  grid.build(sample.people.size(), near_m, [&](std::size_t person) { return sample.people[person].position; });
}

}  // namespace dmrp::metrics
