// SPDX-License-Identifier: MIT
// planner_process.hpp: one call of plan() in a child process, which alone ends if the planner crashes, hangs or takes
// all memory.
#pragma once

#include <optional>
#include <string>

#include "host/plan/plan_task.hpp"

namespace dmrp::host {

struct PlannerRun {
  std::optional<PlannerAnswer> answer;  // not yet validated; nothing after a fault
  std::string fault;                    // its kind, as in results.sqlite; empty if there was none
  std::string detail;                   // of the fault, one line with the plugin and the function
  double peak_rss_mb = 0.0;             // of the process
};

// Loads the experiment's library, creates its global planner with its parameters, starts it with the experiment's seed
// and calls plan() on the task. Kills a planner that does not return within 5 s of the end of its time budget. The
// planner's log lines go to standard error. Throws MachineError.
PlannerRun run_planner(const Experiment& experiment, const PlanTask& task);

}  // namespace dmrp::host
