// SPDX-License-Identifier: MIT
// planner_process.hpp: one call of plan() in a process of its own, so that a planner that crashes, hangs or eats all
// memory takes nothing with it.
#pragma once

#include <optional>
#include <string>

#include "host/plan/plan_task.hpp"

namespace dmrp::host {

struct PlannerRun {
  std::optional<PlannerAnswer> answer;  // not yet checked; nothing after a fault
  std::string fault;                    // kind, as in results.sqlite; empty if there was none
  std::string detail;                   // of the fault, in one line that names plugin and function
  double peak_rss_mb = 0.0;             // of the process
};

// Loads the experiment's library, makes its global planner with its parameters, starts it with the experiment's seed
// and calls plan() on the task. A planner that does not stop some seconds after its time is over is killed.
// The planner's log lines go to standard error. Throws std::system_error.
PlannerRun run_planner(const Experiment& experiment, const PlanTask& task);

}  // namespace dmrp::host
