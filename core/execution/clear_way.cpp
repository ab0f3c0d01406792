// SPDX-License-Identifier: MIT
#include "core/execution/clear_way.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

#include "core/scene/convex_separation.hpp"

namespace dmrp::core {
namespace {

constexpr double far_m = 1.0;  // gaps are measured up to this
constexpr double rounding_m = 1e-9;

// In the world; a disc if it has no parts.
struct Body {
  dmrp_vec2 center;
  double radius_m;
  std::vector<ConvexPolygon> parts;
};

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

double gap_to_static(const StaticGeometry& geometry, const Body& body) {
  if (body.parts.empty()) return geometry.clearance(body.center) - body.radius_m;
  double gap_m = far_m;
  for (const ConvexPolygon& part : body.parts) gap_m = std::min(gap_m, geometry.clearance(part, far_m));
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

std::vector<Body> sensed_bodies(const World& world, std::uint32_t robot) {
  std::vector<Body> bodies;
  for (std::uint32_t i = 0; i < world.robots().size(); ++i)
    if (i != robot && senses(world, robot, world.robot_agents()[i]))
      bodies.push_back(body_of(world.robot_settings(i), world.robots()[i].pose));
  for (const dmrp_agent& person : world.person_agents())
    if (senses(world, robot, person)) bodies.push_back({toolkit::position(person.pose), person.radius_m, {}});
  return bodies;
}

}  // namespace

bool way_is_clear(const World& world, std::uint32_t robot, std::span<const dmrp_pose> poses) {
  assert(robot < world.robots().size());
  const std::vector<Body> others = sensed_bodies(world, robot);
  const auto gaps_at = [&](const dmrp_pose& pose) {
    const Body body = body_of(world.robot_settings(robot), pose);
    std::vector<double> gaps_m = {gap_to_static(world.geometry(), body)};
    for (const Body& other : others) gaps_m.push_back(gap_between(body, other));
    return gaps_m;
  };
  std::vector<double> before_m = gaps_at(world.robots()[robot].pose);
  for (const dmrp_pose& pose : poses) {
    std::vector<double> gaps_m = gaps_at(pose);
    for (std::size_t i = 0; i < gaps_m.size(); ++i)
      if (gaps_m[i] < clear_gap_m && gaps_m[i] < before_m[i] - rounding_m) return false;
    before_m = std::move(gaps_m);
  }
  return true;
}

}  // namespace dmrp::core
