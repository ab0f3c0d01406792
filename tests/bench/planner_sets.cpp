// SPDX-License-Identifier: MIT
#include "tests/bench/planner_sets.hpp"

namespace dmrp::bench {

namespace {

PlannerSet set(const char* planner, const char* map, int agents, int instances = 5, int wanted = -1) {
  return {planner_choice(planner), map, agents, instances, wanted < 0 ? instances : wanted, ""};
}

struct Crowd {
  const char* map;
  int agents;
};

// Scenarios 1 and 2 of each: first plans, then what is made of them within the time limit.
std::vector<PlannerSet> sets_of(const std::vector<Crowd>& crowds) {
  std::vector<PlannerSet> sets;
  for (const char* planner : {"lacam iterations=1", "sipp", "lns iterations=0"})
    for (const Crowd& crowd : crowds) sets.push_back(set(planner, crowd.map, crowd.agents, 2, 0));
  return sets;
}

}  // namespace

std::vector<PlannerSet> crowded_sets() {
  return sets_of({{"random-32-32-20", 200},
                  {"random-32-32-20", 300},
                  {"random-32-32-20", 409},
                  {"room-32-32-4", 150},
                  {"room-32-32-4", 250},
                  {"maze-32-32-4", 100},
                  {"maze-32-32-4", 200},
                  {"maze-32-32-2", 250},
                  {"empty-48-48", 1000},
                  {"room-64-64-8", 400},
                  {"room-64-64-8", 700},
                  {"room-64-64-8", 1000},
                  {"maze-128-128-1", 300}});
}

std::vector<PlannerSet> large_sets() {
  return sets_of({{"random-64-64-20", 700},
                  {"random-64-64-20", 1000},
                  {"warehouse-10-20-10-2-1", 1000},
                  {"warehouse-20-40-10-2-2", 1000},
                  {"den520d", 1000},
                  {"Paris_1_256", 1000},
                  {"orz900d", 200}});
}

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
