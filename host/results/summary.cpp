// SPDX-License-Identifier: MIT
#include "host/results/summary.hpp"

#include <algorithm>
#include <map>

#include "host/results/csv.hpp"
#include "host/results/system_values.hpp"

namespace dmrp::host {
namespace {

// The trials of one combination, and its trials with each seed.
struct Group {
  std::vector<std::size_t> trials;  // indices
  std::map<std::uint64_t, std::vector<std::size_t>> of_seed;
};

// All metrics with values for the same number of seeds share the bootstrap draws.
class Intervals {
 public:
  core::Interval of(std::span<const std::vector<double>> clusters) {
    const auto found = draws_.try_emplace(clusters.size(), clusters.size());
    return core::cluster_bootstrap_interval(clusters, found.first->second);
  }

 private:
  std::map<std::size_t, core::BootstrapDraws> draws_;
};

MetricSummary summarise_metric(std::size_t metric, bool counts_failures, const Group& group,
                               std::span<const TrialRecord> trials, const SystemValues& system, Intervals& intervals) {
  const auto value_of = [&](std::size_t trial) {
    const std::optional<double>& value = system[trial][metric];
    return !value && counts_failures && trials[trial].outcome == trial_outcome::fault ? std::optional(0.0) : value;
  };
  std::vector<double> values;
  std::vector<double> values_of_successful;
  for (const std::size_t trial : group.trials) {
    const std::optional<double> value = value_of(trial);
    if (!value) continue;
    values.push_back(*value);
    if (counts_failures || trials[trial].outcome == trial_outcome::succeeded) values_of_successful.push_back(*value);
  }
  std::vector<std::vector<double>> clusters;
  for (const auto& [seed, of_seed] : group.of_seed) {
    std::vector<double> cluster;
    for (const std::size_t trial : of_seed)
      if (const std::optional<double> value = value_of(trial)) cluster.push_back(*value);
    if (!cluster.empty()) clusters.push_back(std::move(cluster));
  }

  MetricSummary summary;
  summary.defined = static_cast<std::uint32_t>(values.size());
  summary.mean = core::mean(values);
  summary.sd = core::sample_sd(values);
  summary.median = core::median(values);
  summary.interval = intervals.of(clusters);
  summary.paper = core::paper_mean(values_of_successful);
  return summary;
}

}  // namespace

CombinationLabels combination_of(const TrialRecord& trial) {
  return {trial.scenario, trial.robots, trial.global_planner, trial.local_controller, trial.pedestrian_model};
}

std::vector<CombinationSummary> summarise(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials,
                                          std::span<const std::string> counts_failures) {
  return summarise(metrics, trials, counts_failures, combination_of);
}

std::vector<CombinationSummary> summarise(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials,
                                          std::span<const std::string> counts_failures,
                                          CombinationLabels (*labels_of)(const TrialRecord&)) {
  std::vector<CombinationSummary> summaries;
  std::vector<Group> groups;  // of each summary
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
    ++summaries[index].trials;
    groups[index].trials.push_back(i);
    groups[index].of_seed[trial.seed].push_back(i);
  }
  const SystemValues system = system_values(metrics, trials);
  Intervals intervals;
  for (std::size_t i = 0; i < summaries.size(); ++i)
    for (std::size_t metric = 0; metric < metrics.size(); ++metric) {
      const bool counts =
          std::find(counts_failures.begin(), counts_failures.end(), metrics[metric].name) != counts_failures.end();
      summaries[i].metrics.push_back(summarise_metric(metric, counts, groups[i], trials, system, intervals));
    }
  return summaries;
}

std::string summary_csv(std::span<const MetricColumn> metrics, std::span<const CombinationSummary> summaries) {
  CsvWriter csv;
  for (const char* name : {"scenario", "robots", "global_planner", "local_controller", "pedestrian_model"})
    csv.field(name);
  const std::vector<std::string> swept = swept_columns(summaries);
  for (const std::string& name : swept) csv.field(name);
  for (const char* name : {"metric", "unit", "n", "n_defined", "mean", "sd", "median", "ci_low", "ci_high",
                           "paper_mean", "paper_n", "paper_trimmed_all_nonzero"})
    csv.field(name);
  csv.end_line();

  for (const CombinationSummary& summary : summaries) {
    for (std::size_t i = 0; i < metrics.size(); ++i) {
      const CombinationLabels& combination = summary.combination;
      const MetricSummary& metric = summary.metrics[i];
      csv.field(combination.scenario).field(combination.robots).field(combination.global_planner);
      csv.field(combination.local_controller).field(combination.pedestrian_model);
      for (const std::string& name : swept) csv.field(swept_value(summary.swept, name));
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
