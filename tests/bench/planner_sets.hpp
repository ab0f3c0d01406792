// SPDX-License-Identifier: MIT
// planner_sets.hpp: what the planners are measured on.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/planner_runs.hpp"

namespace dmrp::bench {

// A row of the table: a planner on so many agents of a map, or on a shipped scenario.
struct PlannerSet {
  PlannerChoice planner;
  std::string map;         // its name; "" for a scenario
  int agents = 0;          // 0 for a scenario: all of its robots
  int instances = 5;       // random-1 to random-K; of a scenario: times that it is planned
  int wanted = -1;         // instances that should be solved; -1: nobody has said
  std::string scenario{};  // "" for a map
};

// What the project wants its planners to solve within 10 s.
std::vector<PlannerSet> acceptance_sets();

// Some of it, for a look in half a minute.
std::vector<PlannerSet> quick_sets();

// Every planner on every scenario, `times` times.
std::vector<PlannerSet> scenario_sets(const std::vector<KnownPlanner>& planners,
                                      const std::vector<std::string>& scenarios, int times);

}  // namespace dmrp::bench
