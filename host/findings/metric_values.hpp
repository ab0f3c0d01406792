// SPDX-License-Identifier: MIT
// metric_values.hpp: how the values of metrics count: as shares, as values of a plan, within their ranges.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/statistics/mean_of_tasks.hpp"
#include "host/findings/findings.hpp"
#include "host/results/summary_layout.hpp"
#include "host/results/system_values.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

// Kinds of metrics, by name (SummaryLayout): those that count failures are shares of robots; those of plans depend on the
// plan alone.
struct MetricKinds {
  std::span<const std::string> counts_failures{};
  std::span<const std::string> of_plans{};
};
inline MetricKinds kinds_of(const SummaryLayout& layout) {
  return {layout.counts_failures, layout.of_plans};
}

// No interval goes beyond what the metric can be.
core::Interval within(const MetricColumn& metric, core::Interval interval);

// Where a value that is never negative was 0 in all observations, there is no interval, but a largest share of them that
// may have more, by the rule of three; else undefined.
double at_most(const MetricColumn& metric, const core::MeanOfTasks& found);

// The system's values of all metrics in all trials.
class MetricValues {
 public:
  // Keeps the lists.
  MetricValues(const MetricKinds& kinds, std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials);

  const MetricColumn& column(std::size_t metric) const { return metrics_[metric]; }
  bool is_share(std::size_t metric) const { return is_share_[metric]; }
  bool is_of_plans(std::size_t metric) const { return is_of_plans_[metric]; }

  // None if undefined; 0 of a share in a trial that ended in a fault.
  std::optional<double> of(std::size_t trial, std::size_t metric) const;

  // Of trials, or of plans.
  const Observations& observations(std::size_t metric) const { return is_of_plans_[metric] ? plans_ : observations_; }

  // Over those observations. Its interval stays within the metric's range.
  core::MeanOfTasks mean(std::span<const std::size_t> trials, std::size_t metric) const;

 private:
  std::span<const MetricColumn> metrics_;
  std::span<const TrialRecord> trials_;
  std::vector<bool> is_share_;     // by metric
  std::vector<bool> is_of_plans_;  // likewise
  SystemValues values_;
  Observations observations_;
  Observations plans_;
};

}  // namespace dmrp::host
