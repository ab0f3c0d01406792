// SPDX-License-Identifier: MIT
// summary.hpp: summary statistics of the trials of each combination, for summary.csv and the table.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/statistics/descriptive.hpp"
#include "host/findings/metric_values.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

// One metric's system values over the trials of a combination. NaN where undefined.
struct MetricSummary {
  std::uint32_t n = 0;               // observations with a value
  Met met{};                         // by the trials with a value
  std::uint32_t defined = 0;         // those trials
  double mean = 0.0;                 // of the observations' means
  double sd = 0.0;                   // over trials
  double median = 0.0;               // likewise
  core::Interval interval{};         // 95 %, of the mean
  double at_most = core::undefined;  // none had any: the largest share of observations with some, at 95 %
  core::TrimmedMean paper{};         // over successful trials, or all trials if the metric counts failures
};

struct CombinationSummary {
  CombinationLabels combination;
  std::uint32_t trials = 0;            // without skipped ones
  std::vector<MetricSummary> metrics;  // in the order of the metrics
  std::vector<SweptValue> swept{};     // of its trials
};

// Of groups of trials with equal `labels_of`, in order of first appearance. `trials` are ordered by id.
std::vector<CombinationSummary> summarise(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials,
                                          const MetricKinds& kinds,
                                          CombinationLabels (*labels_of)(const TrialRecord&) = combination_of);

// What all these trials have met.
Met met_by_all(std::span<const TrialRecord> trials);

// summary.csv: one line for each combination and metric.
std::string summary_csv(std::span<const MetricColumn> metrics, std::span<const CombinationSummary> summaries);

}  // namespace dmrp::host
