// SPDX-License-Identifier: MIT
// hidden_places.hpp: what a robot can see among static shapes, and who may come from where it cannot.
#pragma once

#include <algorithm>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/disc_sweep.hpp>
#include <numbers>
#include <vector>

#include "metrics/measure/bodies.hpp"

namespace dmrp::metrics {

template <class Shapes>
bool in_sight(const Shapes& shapes, Vec2 from, Vec2 to) {
  return std::all_of(shapes.begin(), shapes.end(), [&](const Shape& shape) {
    return toolkit::distance(shape, dmrp_segment{from, to}) > 0.0;
  });
}

// Whether somebody of this radius and speed could come straight out of a place that the robot does not see and touch it
// within the horizon, while it keeps its velocity. Tries two places of the robot, 16 points where it is touched, and 16
// directions and two distances from which somebody comes there.
inline bool may_be_surprised(const World& world, const Moving& robot, double horizon_s, double speed, double radius_m) {
  constexpr int times = 2, directions = 16, distances = 2;
  constexpr double turn_rad = 2.0 * std::numbers::pi / directions;
  const Vec2 here = robot.disc.center;
  const double touching_m = robot.disc.radius_m + radius_m;
  const double reach_m = horizon_s * (toolkit::norm(robot.velocity) + speed) + touching_m + radius_m;
  std::vector<Shape> near;
  for (const Shape& shape : world.shapes())
    if (toolkit::distance(toolkit::bounds(shape), here) <= reach_m) near.push_back(shape);
  const auto is_way = [&](Vec2 from, Vec2 to) {
    return toolkit::disc_sweep_is_clear({from, to}, radius_m, near, {world->lower, world->upper});
  };
  for (int k = 1; k <= times && !near.empty(); ++k) {
    const double t_s = horizon_s * k / times;
    const Vec2 there = here + t_s * robot.velocity;
    if (!in_sight(near, here, there)) return false;  // the robot will turn before
    for (int side = 0; side < directions; ++side) {
      const Vec2 touched = there + touching_m * toolkit::from_angle(turn_rad * side);
      if (!is_way(touched, touched)) continue;
      for (int from = 0; from < directions * distances; ++from) {
        const double way_m = speed * t_s * (1 + from / directions) / distances;
        const Vec2 place = touched + way_m * toolkit::from_angle(turn_rad * (from % directions));
        if (!in_sight(near, here, place) && is_way(place, touched)) return true;
      }
    }
  }
  return false;
}

}  // namespace dmrp::metrics
