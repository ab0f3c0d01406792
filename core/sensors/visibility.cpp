// SPDX-License-Identifier: MIT
#include "core/sensors/visibility.hpp"

#include <algorithm>
#include <cassert>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::core {

void scan_from(const World& world, std::uint32_t robot, Lidar& lidar, std::span<float> ranges) {
  assert(robot < world.robots().size());
  std::vector<Disc> discs;
  std::vector<ConvexPolygon> polygons;
  for (std::uint32_t i = 0; i < world.robots().size(); ++i) {
    if (i == robot) continue;
    const dmrp_pose& pose = world.robots()[i].pose;
    const RobotSettings& type = world.robot_settings(i);
    if (type.parts.empty()) discs.push_back({toolkit::position(pose), type.radius_m});
    for (const ConvexPolygon& part : type.parts) polygons.push_back(toolkit::to_world(pose, part));
  }
  for (const dmrp_agent& agent : world.person_agents())
    discs.push_back({toolkit::position(agent.pose), agent.radius_m});
  lidar.scan(world.robots()[robot].pose, discs, polygons, ranges);
}

void visible_agents(const World& world, std::uint32_t robot, std::vector<dmrp_agent>& agents) {
  assert(robot < world.robots().size());
  agents.clear();
  const Tracking tracking = world.settings().tracking;
  if (tracking == Tracking::none) return;
  const dmrp_vec2 eye = toolkit::position(world.robots()[robot].pose);
  const auto is_visible = [&](const dmrp_agent& agent) {
    if (tracking == Tracking::all) return true;
    const dmrp_vec2 there = toolkit::position(agent.pose);
    return toolkit::distance(eye, there) <= world.settings().tracking_range_m &&
           world.geometry().line_of_sight(eye, there);
  };
  for (const dmrp_agent& agent : world.robot_agents())
    if (agent.id != robot && is_visible(agent)) agents.push_back(agent);
  for (const dmrp_agent& agent : world.person_agents())
    if (is_visible(agent)) agents.push_back(agent);
  std::sort(agents.begin(), agents.end(), [](const dmrp_agent& one, const dmrp_agent& two) {
    return one.kind != two.kind ? one.kind < two.kind : one.id < two.id;
  });
}

}  // namespace dmrp::core
