// SPDX-License-Identifier: MIT
// A planning case as the planners' own problem, for tests of their parts.
#pragma once

#include <dmrp/plugin.hpp>

#include "planners/mapf/problem.hpp"
#include "planners/mapf/stop_signal.hpp"
#include "tests/unit/planners/planning_case.hpp"

namespace dmrp::test {

// A signal that is never raised.
inline planners::StopSignal& never() {
  static planners::StopSignal stop([] { return false; });
  return stop;
}

inline planners::Problem problem_of(const PlanningCase& c) {
  const CProblem host(c);
  return planners::make_problem(PlanningProblem(host.problem()), true);
}

}  // namespace dmrp::test
