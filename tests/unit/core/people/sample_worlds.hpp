// SPDX-License-Identifier: MIT
// sample_worlds.hpp: worlds with people, as the tests of core/people need them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <dmrp/toolkit/vec2.hpp>
#include <span>
#include <vector>

#include "core/world/world.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

namespace dmrp::core::test {

inline constexpr double body_radius_m = PeopleSettings{}.radius_m;

inline World world_of(const Scenario& scenario, std::uint64_t seed = 1) {
  return World(scenario, RobotSettings{}, SimulationSettings{}, geometry_of(scenario), seed);
}

// The velocities of people who walk straight to their targets.
inline std::vector<dmrp_vec2> straight_on(const World& world) {
  std::vector<dmrp_vec2> velocities;
  for (const dmrp_person& person : world.people())
    velocities.push_back(person.desired_speed * toolkit::normalized(person.target - person.position));
  return velocities;
}

// The least distance between the centres of two people.
inline double nearest_pair(std::span<const dmrp_person> people) {
  double nearest_m = 1e9;
  for (std::size_t a = 0; a < people.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      nearest_m = std::min(nearest_m, toolkit::distance(people[a].position, people[b].position));
  return nearest_m;
}

// Without robots that take part, but with their starts kept free.
inline Scenario without_robots(Scenario scenario) {
  for (const RobotTask& task : scenario.robots) scenario.other_starts.push_back({task.start.x, task.start.y});
  scenario.robots.clear();
  return scenario;
}

}  // namespace dmrp::core::test
