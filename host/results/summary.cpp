// SPDX-License-Identifier: MIT
#include "host/results/summary.hpp"

#include <algorithm>
#include <map>

#include "host/results/csv.hpp"

namespace dmrp::host {
namespace {

CombinationLabels combination_of(const TrialRecord& trial) {
  return {trial.scenario, trial.robots, trial.global_planner, trial.local_controller, trial.pedestrian_model};
}

MetricSummary summarise_metric(const std::string& metric, bool counts_failures,
                               const std::vector<const TrialRecord*>& trials) {
  std::vector<double> values;
  std::vector<double> values_of_successful;
  std::map<std::uint64_t, std::vector<double>> by_seed;
  for (const TrialRecord* trial : trials) {
    std::optional<double> value = system_value(*trial, metric);
    if (!value && counts_failures && trial->outcome == trial_outcome::fault) value = 0.0;
    if (!value) continue;
    values.push_back(*value);
    by_seed[trial->seed].push_back(*value);
    if (counts_failures || trial->outcome == trial_outcome::succeeded) values_of_successful.push_back(*value);
  }
  std::vector<std::vector<double>> clusters;
  for (auto& [seed, cluster] : by_seed) clusters.push_back(std::move(cluster));

  MetricSummary summary;
  summary.defined = static_cast<std::uint32_t>(values.size());
  summary.mean = core::mean(values);
  summary.sd = core::sample_sd(values);
  summary.median = core::median(values);
  summary.interval = core::cluster_bootstrap_interval(clusters);
  summary.paper = core::paper_mean(values_of_successful);
  return summary;
}

}  // namespace

std::vector<CombinationSummary> summarise(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials,
                                          std::span<const std::string> counts_failures) {
  std::vector<CombinationSummary> summaries;
  std::vector<std::vector<const TrialRecord*>> trials_of;  // of each summary
  for (const TrialRecord& trial : trials) {
    if (trial.outcome == trial_outcome::skipped) continue;
    const CombinationLabels combination = combination_of(trial);
    const auto found = std::find_if(summaries.begin(), summaries.end(), [&](const CombinationSummary& summary) {
      return summary.combination == combination;
    });
    const auto index = static_cast<std::size_t>(found - summaries.begin());
    if (found == summaries.end()) {
      summaries.push_back({combination, 0, {}});
      trials_of.emplace_back();
    }
    ++summaries[index].trials;
    trials_of[index].push_back(&trial);
  }
  for (std::size_t i = 0; i < summaries.size(); ++i)
    for (const MetricColumn& metric : metrics) {
      const bool counts =
          std::find(counts_failures.begin(), counts_failures.end(), metric.name) != counts_failures.end();
      summaries[i].metrics.push_back(summarise_metric(metric.name, counts, trials_of[i]));
    }
  return summaries;
}

std::string summary_csv(std::span<const MetricColumn> metrics, std::span<const CombinationSummary> summaries) {
  CsvWriter csv;
  for (const char* name :
       {"scenario", "robots", "global_planner", "local_controller", "pedestrian_model", "metric", "unit", "n",
        "n_defined", "mean", "sd", "median", "ci_low", "ci_high", "paper_mean", "paper_n", "paper_trimmed_all_nonzero"})
    csv.field(name);
  csv.end_line();

  for (const CombinationSummary& summary : summaries) {
    for (std::size_t i = 0; i < metrics.size(); ++i) {
      const CombinationLabels& combination = summary.combination;
      const MetricSummary& metric = summary.metrics[i];
      csv.field(combination.scenario).field(combination.robots).field(combination.global_planner);
      csv.field(combination.local_controller).field(combination.pedestrian_model);
      csv.field(metrics[i].name).field(metrics[i].unit).field(summary.trials).field(metric.defined);
      csv.field(metric.mean).field(metric.sd).field(metric.median);
      csv.field(metric.interval.low).field(metric.interval.high);
      csv.field(metric.paper.mean).field(metric.paper.count).field(metric.paper.trimmed_all_nonzero ? 1 : 0);
      csv.end_line();
    }
  }
  return csv.text();
}

}  // namespace dmrp::host
