// SPDX-License-Identifier: MIT
#include "tests/bench/planner_sets.hpp"

namespace dmrp::bench {

namespace {

PlannerSet set(const char* planner, const char* map, int agents, int instances = 5, int wanted = -1) {
  return {planner_choice(planner), map, agents, instances, wanted < 0 ? instances : wanted, ""};
}

}  // namespace

std::vector<PlannerSet> acceptance_sets() {
  const char* const eecbs = "eecbs suboptimality=1.2";
  const char* const loose_eecbs = "eecbs suboptimality=1.5";
  const char* const ecbs = "ecbs suboptimality=1.2";
  const char* const ecbs8 = "ecbs8 suboptimality=2.0";
  return {set(eecbs, "random-32-32-20", 100),
          set(eecbs, "random-32-32-20", 150),
          set(eecbs, "room-32-32-4", 80),
          set(eecbs, "maze-32-32-2", 60),
          set(eecbs, "empty-32-32", 300),
          set(eecbs, "warehouse-10-20-10-2-1", 300),
          set(eecbs, "den312d", 200),
          set(loose_eecbs, "random-32-32-20", 200),
          set(loose_eecbs, "empty-32-32", 400),
          set("cbs", "random-32-32-20", 20, 10),
          set("cbs", "random-32-32-20", 50, 5, 3),
          set("cbs", "empty-32-32", 100),
          set("cbs", "warehouse-10-20-10-2-1", 100),
          set(ecbs, "random-32-32-20", 100),
          set(ecbs, "empty-32-32", 200),
          set(ecbs, "warehouse-10-20-10-2-1", 300),
          set(ecbs8, "gen-random-40-40-10", 20, 10),
          set(ecbs8, "gen-random-40-40-20", 20, 10),
          set(ecbs8, "gen-rooms-40-40", 20, 10),
          set("sipp", "random-32-32-20", 150),
          set("sipp", "empty-32-32", 400),
          set("sipp", "warehouse-10-20-10-2-1", 300)};
}

std::vector<PlannerSet> quick_sets() {
  return {set("eecbs suboptimality=1.2", "random-32-32-20", 50, 2), set("cbs", "random-32-32-20", 20, 2),
          set("ecbs suboptimality=1.2", "random-32-32-20", 50, 2),
          set("ecbs8 suboptimality=2.0", "gen-rooms-40-40", 10, 2), set("sipp", "random-32-32-20", 50, 2)};
}

std::vector<PlannerSet> scenario_sets(const std::vector<KnownPlanner>& planners,
                                      const std::vector<std::string>& scenarios, int times) {
  std::vector<PlannerSet> sets;
  for (const std::string& scenario : scenarios)
    for (const KnownPlanner& planner : planners) sets.push_back({{planner.id, {}}, "", 0, times, times, scenario});
  return sets;
}

}  // namespace dmrp::bench
