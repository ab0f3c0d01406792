// SPDX-License-Identifier: MIT
#include "core/execution/clear_way.hpp"

#include <cassert>
#include <dmrp/toolkit/vec2.hpp>
#include <utility>
#include <vector>

#include "core/execution/sensed_bodies.hpp"

namespace dmrp::core {
namespace {

constexpr double far_m = 1.0;  // gaps are measured up to this
constexpr double rounding_m = 1e-9;

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
    std::vector<double> gaps_m = {gap_to_static(world.geometry(), body, far_m)};
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
