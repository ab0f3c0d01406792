// SPDX-License-Identifier: MIT
#include "host/findings/metric_values.hpp"

#include <algorithm>
#include <cmath>

namespace dmrp::host {

core::Interval within(const MetricColumn& metric, core::Interval interval) {
  // undefined ends stay so: std::max and std::min return the first of two if one is undefined
  return {std::max(interval.low, metric.minimum), std::min(interval.high, metric.maximum)};
}

double at_most(const MetricColumn& metric, const core::MeanOfTasks& found) {
  const bool nobody = metric.minimum == 0.0 && found.mean == 0.0 && found.n > 1 && std::isnan(found.interval.low);
  return nobody ? core::rule_of_three(found.n) : core::undefined;
}

MetricValues::MetricValues(const MetricKinds& kinds, std::span<const MetricColumn> metrics,
                           std::span<const TrialRecord> trials)
    : metrics_(metrics),
      trials_(trials),
      values_(system_values(metrics, trials)),
      observations_(observations_of(trials)),
      plans_(observations_of(trials, Unit::plan)) {
  const auto contains = [](std::span<const std::string> names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const MetricColumn& metric : metrics) {
    is_share_.push_back(contains(kinds.counts_failures, metric.name));
    is_of_plans_.push_back(contains(kinds.of_plans, metric.name));
  }
}

std::optional<double> MetricValues::of(std::size_t trial, std::size_t metric) const {
  const std::optional<double>& value = values_[trial][metric];
  return !value && is_share_[metric] && trials_[trial].outcome == trial_outcome::fault ? std::optional(0.0) : value;
}

core::MeanOfTasks MetricValues::mean(std::span<const std::size_t> trials, std::size_t metric) const {
  const auto value = [&](std::size_t trial) { return of(trial, metric); };
  core::MeanOfTasks found = core::mean_of_tasks(observation_means(observations(metric), trials, value),
                                                bounds_of_values(is_share_[metric]), observations(metric).resampling);
  found.interval = within(metrics_[metric], found.interval);
  return found;
}

}  // namespace dmrp::host
