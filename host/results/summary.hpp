// SPDX-License-Identifier: MIT
// summary.hpp: summary statistics of the trials of each combination, for summary.csv and the table.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/statistics/bootstrap.hpp"
#include "core/statistics/descriptive.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

// A combination: its trials differ in repetition and seed only.
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
  std::uint32_t defined = 0;  // trials with a value
  double mean = 0.0;
  double sd = 0.0;  // over trials
  double median = 0.0;
  core::Interval interval{};  // 95 %, of the mean, over seeds
  core::TrimmedMean paper{};  // over successful trials, or all trials if the metric counts failures
};

struct CombinationSummary {
  CombinationLabels combination;
  std::uint32_t trials = 0;            // without skipped ones
  std::vector<MetricSummary> metrics;  // in the order of the metrics
  std::vector<SweptValue> swept{};     // of its trials
};

CombinationLabels combination_of(const TrialRecord& trial);

// In order of first appearance. `trials` are ordered by id. `counts_failures`: metrics that count failures
// (SummaryLayout).
std::vector<CombinationSummary> summarise(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials,
                                          std::span<const std::string> counts_failures);

// The same for groups of trials with equal `labels_of`.
std::vector<CombinationSummary> summarise(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials,
                                          std::span<const std::string> counts_failures,
                                          CombinationLabels (*labels_of)(const TrialRecord&));

// summary.csv: one line for each combination and metric.
std::string summary_csv(std::span<const MetricColumn> metrics, std::span<const CombinationSummary> summaries);

}  // namespace dmrp::host
