// SPDX-License-Identifier: MIT
// summary.hpp: what the trials of each combination have in common: the numbers behind summary.csv and the table.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/statistics/bootstrap.hpp"
#include "core/statistics/descriptive.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

// What is compared: all repetitions of one choice of everything.
struct CombinationLabels {
  std::string scenario;
  std::uint32_t robots = 0;
  std::string global_planner;
  std::string local_controller;
  std::string pedestrian_model;

  bool operator==(const CombinationLabels&) const = default;
};

// One metric's system values over the trials of a combination. NaN where undefined.
struct MetricSummary {
  std::uint32_t defined = 0;  // trials in which it has a value
  double mean = 0.0;
  double sd = 0.0;  // between trials
  double median = 0.0;
  core::Interval interval{};  // 95 %, of the mean, over seeds
  core::TrimmedMean paper{};  // of the trials that succeeded; of all where failures count
};

struct CombinationSummary {
  CombinationLabels combination;
  std::uint32_t trials = 0;            // that ran; skipped ones don't count
  std::vector<MetricSummary> metrics;  // as in the list of metrics
};

CombinationLabels combination_of(const TrialRecord& trial);

// In the order in which the combinations first appear. Trials are ordered by id. `counts_failures`: the metrics that are
// about failing itself (SummaryLayout).
std::vector<CombinationSummary> summarise(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials,
                                          std::span<const std::string> counts_failures);

// The same over coarser groups: trials whose labels are equal belong together.
std::vector<CombinationSummary> summarise(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials,
                                          std::span<const std::string> counts_failures,
                                          CombinationLabels (*labels_of)(const TrialRecord&));

// summary.csv: a line for each combination and metric.
std::string summary_csv(std::span<const MetricColumn> metrics, std::span<const CombinationSummary> summaries);

}  // namespace dmrp::host
