// SPDX-License-Identifier: MIT
// comparison_data.hpp: the data of a comparison's page, and of `compare --json`, as one JSON text. NaN is null. As far as they go, keys are those of
// a report (report_data.hpp):
//
//   format        1
//   before        {path, name, version, commit, started, repetitions}
//   scenarios, metrics, layouts    of the first run
//   runs          each later one: {path, name, version, commit, started, repetitions, pairs, only_before, only_after,
//                 changes: [text], libraries: [{name, before, after}] with SHA-256s, or null where the run has none,
//                 differences: [difference], combinations: [{scenario, robots, global_planner, local_controller,
//                 pedestrian_model}], of_combinations: [combination][metric]: difference}
//   difference    {metric, pairs, n, before, after, difference, low, high, equal, p, p_holm}; p: null below five
//                 observations, or if no pair differs
#pragma once

#include <string>
#include <vector>

#include "host/compare/run_comparison.hpp"

namespace dmrp::host {

struct ComparedRun {
  std::string path;  // as the user wrote it
  ReportRun run;     // its trials are not needed
};

struct ComparedRuns {
  struct Other {
    ComparedRun run;
    RunComparison comparison;
  };
  ComparedRun before;
  std::vector<Other> others;
};

std::string comparison_data_json(const ComparedRuns& runs, const ReportLayouts& layouts);

}  // namespace dmrp::host
