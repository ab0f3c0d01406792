// SPDX-License-Identifier: MIT
// preparation.hpp: what a planner does before its search: the problem on the graph, the distance tables, and cheap
// proofs that there is no plan.
#pragma once

#include <dmrp/plugin.hpp>
#include <optional>
#include <string>
#include <vector>

#include "planners/mapf/tour_table.hpp"

namespace dmrp::planners {

struct Preparation {
  Problem problem;
  std::vector<TourTable> tables;  // one for each agent
  std::string obstruction;        // why there is no plan; empty if that is not known

  // The sum of the robots' costs alone.
  double lower_bound() const {
    double sum = 0;
    for (std::size_t i = 0; i < tables.size(); ++i) sum += tables[i].distance(0, problem.agents[i].start);
    return sum;
  }
};

// Nothing if `stop` was raised. Robots that differ or do not fit their cells are an obstruction (unequal_robots.hpp).
std::optional<Preparation> prepare(const PlanningProblem& host_problem, StopSignal& stop);

}  // namespace dmrp::planners
