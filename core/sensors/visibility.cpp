// SPDX-License-Identifier: MIT
#include "core/sensors/visibility.hpp"

#include <algorithm>
#include <cassert>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>

namespace dmrp::core {
namespace {

constexpr double cell_m = 2.0;

}  // namespace

void Sight::look() {
  if (looked_ns_ == world_.t_ns()) return;
  looked_ns_ = world_.t_ns();
  const auto robots = world_.robot_agents();
  const auto people = world_.person_agents();
  robots_.build(robots.size(), cell_m, [&](std::size_t i) { return toolkit::position(robots[i].pose); });
  people_.build(people.size(), cell_m, [&](std::size_t i) { return toolkit::position(people[i].pose); });
  greatest_radius_m_ = 0.0;
  for (const auto& agents : {robots, people})
    for (const dmrp_agent& agent : agents) greatest_radius_m_ = std::max(greatest_radius_m_, agent.radius_m);
}

void Sight::scan_from(std::uint32_t robot, Lidar& lidar, std::span<float> ranges) {
  assert(robot < world_.robots().size());
  look();
  discs_.clear();
  polygons_.clear();
  const dmrp_pose& sensor = world_.robots()[robot].pose;
  const double reach_m = lidar.range_m() + greatest_radius_m_;
  robots_.visit(toolkit::position(sensor), reach_m, [&](std::uint32_t i) {
    if (i == robot) return;
    const dmrp_pose& pose = world_.robots()[i].pose;
    const RobotSettings& type = world_.robot_settings(i);
    if (type.parts.empty()) discs_.push_back({toolkit::position(pose), type.radius_m});
    for (const ConvexPolygon& part : type.parts) polygons_.push_back(toolkit::to_world(pose, part));
  });
  people_.visit(toolkit::position(sensor), reach_m, [&](std::uint32_t i) {
    const dmrp_agent& agent = world_.person_agents()[i];
    discs_.push_back({toolkit::position(agent.pose), agent.radius_m});
  });
  lidar.scan(sensor, discs_, polygons_, ranges);
}

void Sight::visible_agents(std::uint32_t robot, std::vector<dmrp_agent>& agents) {
  assert(robot < world_.robots().size());
  agents.clear();
  const Tracking tracking = world_.settings().tracking;
  if (tracking == Tracking::none) return;
  look();
  const dmrp_vec2 eye = toolkit::position(world_.robots()[robot].pose);
  const double range_m = world_.settings().tracking_range_m;
  const auto add = [&](const dmrp_agent& agent) {
    const dmrp_vec2 there = toolkit::position(agent.pose);
    if (tracking == Tracking::all ||
        (toolkit::distance(eye, there) <= range_m && world_.geometry().line_of_sight(eye, there)))
      agents.push_back(agent);
  };
  const double reach_m = tracking == Tracking::all ? std::numeric_limits<double>::max() : range_m;
  robots_.visit(eye, reach_m, [&](std::uint32_t i) {
    if (i != robot) add(world_.robot_agents()[i]);
  });
  people_.visit(eye, reach_m, [&](std::uint32_t i) { add(world_.person_agents()[i]); });
  std::sort(agents.begin(), agents.end(), [](const dmrp_agent& one, const dmrp_agent& two) {
    return one.kind != two.kind ? one.kind < two.kind : one.id < two.id;
  });
}

}  // namespace dmrp::core
