// SPDX-License-Identifier: MIT
// run_comparison.hpp: two runs of the same trials, before and after a change: what differs?
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/findings/summary.hpp"
#include "host/ranking/paired_difference.hpp"
#include "host/report/data/report_data.hpp"
#include "host/report/data/report_run.hpp"

namespace dmrp::host {

// One metric over the trials that both runs have: the same scenario, robots, seed and labels. Differences are after -
// before, by observation.
struct MetricComparison {
  std::string metric;
  std::string unit;
  std::uint32_t pairs = 0;  // of trials
  double before = 0.0;      // means over observations
  double after = 0.0;
  PairedDifference difference;  // p_holm: over the metrics of the comparison
};

// A plugin library of either run, known by its file's name.
struct ComparedLibrary {
  std::string name;
  std::string before;  // SHA-256, of each file of this name; empty if the run did not have it
  std::string after;
};

// The trials of one combination.
struct CombinationComparison {
  CombinationLabels combination;
  std::vector<MetricComparison> metrics;  // difference.p_holm: over the combinations, for the metric
};

struct RunComparison {
  Met met{};  // by the trials of both
  std::uint32_t pairs = 0;
  std::uint32_t only_before = 0;  // trials without a partner
  std::uint32_t only_after = 0;
  std::vector<std::string> changes;  // another program, machine or plugin library, other settings
  std::vector<ComparedLibrary> libraries;
  std::vector<MetricComparison> metrics;              // over all pairs
  std::vector<CombinationComparison> combinations{};  // in order of the first run's trials
};

// `metrics`: names. The rules of the report's comparisons hold: a trial that ended in a fault failed, times of failed
// trials count as the time limit, lengths are compared where both succeeded. Metrics that a run lacks are left out.
RunComparison compare_runs(const ReportRun& before, const ReportRun& after, const ReportLayouts& layouts,
                           std::span<const std::string> metrics);

// "success < -0.02": a limit for a difference.
struct FailCondition {
  std::string metric;
  bool below = true;
  double limit = 0.0;
};
FailCondition parse_fail_condition(const std::string& text);  // throws InputError

// Whether the true difference lies beyond the limit: if the whole interval does, it does; if no part of it does, or two
// trials at least are equal in both runs and none differs, it does not.
enum class Verdict { holds, fails, undecided };
Verdict judge(const FailCondition& condition, const MetricComparison& comparison);

}  // namespace dmrp::host
