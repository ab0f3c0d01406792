// SPDX-License-Identifier: MIT
// summary.hpp: summary statistics of the trials of each combination, for summary.csv and the table.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/statistics/descriptive.hpp"
#include "host/findings/findings.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

// One metric's system values over the trials of a combination. NaN where undefined.
struct MetricSummary {
  std::uint32_t tasks = 0;    // with a value: the observations
  std::uint32_t defined = 0;  // trials with a value
  double mean = 0.0;          // of the tasks' means
  double sd = 0.0;            // over trials
  double median = 0.0;        // likewise
  core::Interval interval{};  // 95 %, of the mean
  core::TrimmedMean paper{};  // over successful trials, or all trials if the metric counts failures
};

struct CombinationSummary {
  CombinationLabels combination;
  std::uint32_t trials = 0;            // without skipped ones
  std::vector<MetricSummary> metrics;  // in the order of the metrics
  std::vector<SweptValue> swept{};     // of its trials
};

// In order of first appearance. `trials` are ordered by id. `counts_failures`: metrics that count failures, which are
// shares of robots (SummaryLayout).
std::vector<CombinationSummary> summarise(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials,
                                          std::span<const std::string> counts_failures);

// The same for groups of trials with equal `labels_of`.
std::vector<CombinationSummary> summarise(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials,
                                          std::span<const std::string> counts_failures,
                                          CombinationLabels (*labels_of)(const TrialRecord&));

// summary.csv: one line for each combination and metric.
std::string summary_csv(std::span<const MetricColumn> metrics, std::span<const CombinationSummary> summaries);

}  // namespace dmrp::host
