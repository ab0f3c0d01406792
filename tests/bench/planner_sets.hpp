// SPDX-License-Identifier: MIT
// planner_sets.hpp: the instances on which bench_planners measures the planners.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/planner_runs.hpp"

namespace dmrp::bench {

// A row of the table: a planner with a number of agents on a map, or on a shipped scenario.
struct PlannerSet {
  PlannerChoice planner;
  std::string map;         // its name; "" for a scenario
  int agents = 0;          // 0 for a scenario: all of its robots
  int instances = 5;       // random-1 to random-K; for a scenario: the number of runs
  int wanted = -1;         // instances that should be solved; -1: no target
  std::string scenario{};  // "" for a map
};

// The instances that the project wants its planners to solve within 10 s.
std::vector<PlannerSet> acceptance_sets();

// A selection that takes half a minute.
std::vector<PlannerSet> quick_sets();

// Many robots on small maps, and on large ones: planners that find a plan there.
std::vector<PlannerSet> crowded_sets();
std::vector<PlannerSet> large_sets();

// Every planner on every scenario, `times` times.
std::vector<PlannerSet> scenario_sets(const std::vector<KnownPlanner>& planners,
                                      const std::vector<std::string>& scenarios, int times);

}  // namespace dmrp::bench
