// SPDX-License-Identifier: MIT
#include "host/findings/summary.hpp"

#include <algorithm>
#include <map>

#include "host/results/csv.hpp"

namespace dmrp::host {
namespace {

MetricSummary summarise_metric(std::size_t metric, std::span<const std::size_t> of_group, const Met& met_by_group,
                               std::span<const TrialRecord> trials, const MetricValues& metric_values) {
  std::vector<double> values;
  std::vector<std::size_t> with_value;
  std::vector<double> values_of_successful;
  for (const std::size_t trial : of_group) {
    const std::optional<double> value = metric_values.of(trial, metric);
    if (!value) continue;
    values.push_back(*value);
    with_value.push_back(trial);
    if (metric_values.is_share(metric) || trials[trial].outcome == trial_outcome::succeeded)
      values_of_successful.push_back(*value);
  }
  const core::MeanOfTasks over_tasks = metric_values.mean(of_group, metric);
  MetricSummary summary;
  summary.n = over_tasks.n;
  summary.met =
      with_value.size() == of_group.size() ? met_by_group : metric_values.observations(metric).met_by(with_value);
  summary.defined = static_cast<std::uint32_t>(values.size());
  summary.mean = over_tasks.mean;
  summary.sd = core::sample_sd(values);
  summary.median = core::median(values);
  summary.interval = over_tasks.interval;
  summary.at_most = at_most(metric_values.column(metric), over_tasks);
  summary.paper = core::paper_mean(values_of_successful);
  return summary;
}

}  // namespace

std::vector<CombinationSummary> summarise(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials,
                                          const MetricKinds& kinds,
                                          CombinationLabels (*labels_of)(const TrialRecord&)) {
  std::vector<CombinationSummary> summaries;
  std::vector<std::vector<std::size_t>> groups;  // of each summary: indices of trials
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const TrialRecord& trial = trials[i];
    if (trial.outcome == trial_outcome::skipped) continue;
    const CombinationLabels labels = labels_of(trial);
    const auto found = std::find_if(summaries.begin(), summaries.end(),
                                    [&](const CombinationSummary& summary) { return summary.combination == labels; });
    const auto index = static_cast<std::size_t>(found - summaries.begin());
    if (found == summaries.end()) {
      summaries.push_back({labels, 0, {}, trial.swept});
      groups.emplace_back();
    }
    if (!has_result(trial)) continue;
    ++summaries[index].trials;
    groups[index].push_back(i);
  }
  const MetricValues values(kinds, metrics, trials);
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    const Met met = metrics.empty() ? Met{} : values.observations(0).met_by(groups[i]);
    for (std::size_t metric = 0; metric < metrics.size(); ++metric)
      summaries[i].metrics.push_back(summarise_metric(metric, groups[i], met, trials, values));
  }
  return summaries;
}

Met met_by_all(std::span<const TrialRecord> trials) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < trials.size(); ++i)
    if (has_result(trials[i])) all.push_back(i);
  return observations_of(trials).met_by(all);
}

std::string summary_csv(std::span<const MetricColumn> metrics, std::span<const CombinationSummary> summaries) {
  CsvWriter csv;
  for (const char* name : {"scenario", "robots", "global_planner", "local_controller", "pedestrian_model"})
    csv.field(name);
  const std::vector<std::string> swept = swept_columns(summaries);
  for (const std::string& name : swept) csv.field(name);
  for (const char* name : {"metric", "unit", "tasks", "crowds", "n", "n_defined", "mean", "sd", "median", "ci_low",
                           "ci_high", "paper_mean", "paper_n", "paper_trimmed_all_nonzero", "trials"})
    csv.field(name);
  csv.end_line();

  for (const CombinationSummary& summary : summaries) {
    for (std::size_t i = 0; i < metrics.size(); ++i) {
      const CombinationLabels& combination = summary.combination;
      const MetricSummary& metric = summary.metrics[i];
      csv.field(combination.scenario).field(combination.robots).field(combination.global_planner);
      csv.field(combination.local_controller).field(combination.pedestrian_model);
      for (const std::string& name : swept) csv.field(swept_value(summary.swept, name));
      csv.field(metrics[i].name).field(metrics[i].unit).field(metric.met.tasks).field(metric.met.crowds);
      csv.field(metric.n).field(metric.defined);
      csv.field(metric.mean).field(metric.sd).field(metric.median);
      csv.field(metric.interval.low).field(metric.interval.high);
      csv.field(metric.paper.mean).field(metric.paper.count).field(metric.paper.trimmed_all_nonzero ? 1 : 0);
      csv.field(summary.trials);
      csv.end_line();
    }
  }
  return csv.text();
}

}  // namespace dmrp::host
