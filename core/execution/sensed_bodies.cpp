// SPDX-License-Identifier: MIT
#include "core/execution/sensed_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "core/scene/convex_separation.hpp"

namespace dmrp::core {

Body body_of(const RobotSettings& settings, const dmrp_pose& pose) {
  Body body = {toolkit::position(pose), settings.radius_m, {}};
  for (const ConvexPolygon& part : settings.parts) body.parts.push_back(toolkit::to_world(pose, part));
  return body;
}

double gap_between(const Body& a, const Body& b) {
  if (a.parts.empty() && b.parts.empty()) return toolkit::distance(a.center, b.center) - a.radius_m - b.radius_m;
  if (a.parts.empty()) return gap_between(b, a);
  double gap_m = toolkit::distance(a.center, b.center);
  for (const ConvexPolygon& part : a.parts) {
    if (b.parts.empty()) gap_m = std::min(gap_m, separation(part, b.center, b.radius_m).distance_m);
    for (const ConvexPolygon& other : b.parts) gap_m = std::min(gap_m, separation(part, other).distance_m);
  }
  return gap_m;
}

double gap_to_static(const StaticGeometry& geometry, const Body& body, double at_most_m) {
  if (body.parts.empty()) return geometry.clearance(body.center) - body.radius_m;
  double gap_m = at_most_m;
  for (const ConvexPolygon& part : body.parts) gap_m = std::min(gap_m, geometry.clearance(part, at_most_m));
  return gap_m;
}

bool senses(const World& world, std::uint32_t robot, const dmrp_agent& agent) {
  const dmrp_pose& pose = world.robots()[robot].pose;
  const LidarSettings& lidar = world.robot_settings(robot).lidar;
  const dmrp_vec2 eye = toolkit::position(pose);
  const dmrp_vec2 there = toolkit::position(agent.pose);
  return toolkit::distance(eye, there) <= lidar.range_max_m &&
         std::abs(toolkit::difference(pose.theta, toolkit::bearing(eye, there))) <= 0.5 * lidar.field_of_view_rad &&
         world.geometry().line_of_sight(eye, there);
}

}  // namespace dmrp::core
