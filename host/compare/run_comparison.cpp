// SPDX-License-Identifier: MIT
#include "host/compare/run_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <regex>
#include <tuple>

#include "host/errors/input_error.hpp"
#include "host/findings/summary.hpp"
#include "host/report/data/report_frame.hpp"
#include "host/report/data/report_values.hpp"

namespace dmrp::host {
namespace {

// The trials of both runs, those before the change first, and their values.
struct BothRuns {
  ReportFrame before;
  ReportFrame after;
  const ExperimentFacts& facts_before;
  const ExperimentFacts& facts_after;
  std::vector<TrialRecord> trials;  // without their values
  Observations observations;

  bool is_before(std::size_t trial) const { return trial < before.trials.size(); }
};

bool has_one_pedestrian_model(const ReportRun& run) {
  return !run.trials.empty() && std::all_of(run.trials.begin(), run.trials.end(), [&](const TrialRecord& trial) {
    return trial.pedestrian_model == run.trials.front().pedestrian_model;
  });
}

// What tells trials apart, without what was measured. Where each run has one pedestrian model, or nobody walks, they count as
// the same.
std::vector<TrialRecord> keys_of(const ReportRun& before, const ReportRun& after) {
  const bool is_one_model = has_one_pedestrian_model(before) && has_one_pedestrian_model(after);
  std::vector<TrialRecord> keys;
  for (const ReportRun* run : {&before, &after})
    for (const TrialRecord& trial : run->trials) {
      TrialRecord& key = keys.emplace_back();
      std::tie(key.scenario, key.robots, key.global_planner, key.local_controller, key.pedestrian_model) =
          std::tie(trial.scenario, trial.robots, trial.global_planner, trial.local_controller, trial.pedestrian_model);
      std::tie(key.seed, key.task, key.task_is_drawn, key.swept, key.outcome) =
          std::tie(trial.seed, trial.task, trial.task_is_drawn, trial.swept, trial.outcome);
      if (is_one_model) key.pedestrian_model = before.trials.front().pedestrian_model;
    }
  return keys;
}

// The runs are the entries, in all situations or in those of one combination.
Findings findings_of(const BothRuns& runs, const CombinationLabels* only = nullptr) {
  return make_findings(runs.trials, runs.observations, [&](std::size_t trial) -> std::optional<Split> {
    const CombinationLabels cell = combination_of(runs.trials[trial]);
    if (only && cell != *only) return std::nullopt;
    return Split{{runs.is_before(trial) ? "before" : "after", 0, "", "", ""}, cell};
  });
}

// The situations of both runs.
std::uint32_t pairs_of(const Findings& findings, std::uint32_t& only_first, std::uint32_t& only_second) {
  std::uint32_t pairs = 0;
  for (std::size_t i = 0; i < findings.situations.size(); ++i) {
    const auto has = [&](std::size_t entry) {
      return entry < findings.entries.size() && !findings.trials[entry][i].empty();
    };
    if (has(0) && has(1)) ++pairs;
    if (has(0) && !has(1)) ++only_first;
    if (has(1) && !has(0)) ++only_second;
  }
  return pairs;
}

// The trials in the situations of both runs.
std::vector<std::size_t> trials_of_both(const Findings& findings) {
  std::vector<std::size_t> both;
  for (std::size_t i = 0; i < findings.situations.size() && findings.entries.size() > 1; ++i) {
    const auto& before = findings.trials[0][i];
    const auto& after = findings.trials[1][i];
    if (before.empty() || after.empty()) continue;
    both.insert(both.end(), before.begin(), before.end());
    both.insert(both.end(), after.begin(), after.end());
  }
  return both;
}

// How values of a metric count, by the layouts.
CountedValue rule_of(const std::string& metric, const ReportLayouts& layouts) {
  CountedValue rule;
  const auto& counts = layouts.summary.counts_failures;
  rule.counts_failures = std::find(counts.begin(), counts.end(), metric) != counts.end();
  for (const ComparedMetric& compared : layouts.report.comparisons)
    if (compared.metric == metric) {
      rule.censored = compared.censored;
      rule.successes_only = compared.both_succeeded;
    }
  return rule;
}

// A metric that both runs have.
struct MeasuredTwice {
  CountedValue before;
  CountedValue after;
};

MetricComparison compare_metric(const MeasuredTwice& metric, const BothRuns& runs, const Findings& findings) {
  const JointValues values = means_of([&](std::size_t trial) {
    return runs.is_before(trial)
               ? counted_value(runs.before, runs.facts_before, metric.before, trial)
               : counted_value(runs.after, runs.facts_after, metric.after, trial - runs.before.trials.size());
  });
  const MetricColumn& column = runs.before.metrics[metric.before.metric];
  MetricComparison result;
  result.metric = column.name;
  result.unit = column.unit;
  if (findings.entries.size() < 2) return result;
  const JointFindings joint = joint_findings(findings, runs.observations, std::vector<std::size_t>{0, 1}, values);
  const core::Bounds bounds = bounds_of_values(metric.before.counts_failures);
  result.pairs = joint.situations;
  result.before = core::mean_of_tasks(joint.values[0], bounds, runs.observations.resampling).mean;
  result.after = core::mean_of_tasks(joint.values[1], bounds, runs.observations.resampling).mean;
  result.difference =
      paired_difference(joint.differences(0, 1), PairedTest::mean, bounds, runs.observations.resampling);
  return result;
}

std::vector<CombinationComparison> compare_combinations(std::span<const MeasuredTwice> metrics, const BothRuns& runs) {
  std::vector<CombinationComparison> combinations;
  for (const CombinationLabels& labels : runs.before.combinations) {
    const Findings findings = findings_of(runs, &labels);
    std::uint32_t alone = 0;
    if (pairs_of(findings, alone, alone) == 0) continue;
    combinations.push_back({labels, {}});
    for (const MeasuredTwice& metric : metrics)
      combinations.back().metrics.push_back(compare_metric(metric, runs, findings));
  }
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    std::vector<PairedDifference*> family;
    for (CombinationComparison& one : combinations) family.push_back(&one.metrics[i].difference);
    adjust_by_holm(family);
  }
  return combinations;
}

std::vector<ComparedLibrary> libraries_of(const Manifest& before, const Manifest& after) {
  std::map<std::string, ComparedLibrary> libraries;
  const auto add = [&](const Manifest& manifest, std::string ComparedLibrary::*hash) {
    for (const HashedFile& file : manifest.files) {
      if (file.role != "plugin library") continue;
      const std::string name = std::filesystem::path(file.path).filename().string();
      ComparedLibrary& library = libraries[name];
      library.name = name;
      (library.*hash) += ((library.*hash).empty() ? "" : ", ") + file.sha256;
    }
  };
  add(before, &ComparedLibrary::before);
  add(after, &ComparedLibrary::after);
  std::vector<ComparedLibrary> list;
  for (auto& [name, library] : libraries) list.push_back(std::move(library));
  return list;
}

// One line each; of the keys, the first ones.
std::vector<std::string> changes_between(const Manifest& before, const Manifest& after) {
  constexpr std::size_t most_keys = 12;
  std::vector<std::string> changes = differences(before, after);
  const std::vector<KeyDifference> keys = differences(before.identity, after.identity);
  for (std::size_t i = 0; i < std::min(keys.size(), most_keys); ++i)
    changes.push_back(fmt::format("{}: {}, now {}{}", keys[i].key, keys[i].before, keys[i].now,
                                  keys[i].key == "behaviour" ? " (dmrp-host itself moves values)" : ""));
  if (keys.size() > most_keys) changes.push_back(fmt::format("and {} more keys", keys.size() - most_keys));
  return changes;
}

}  // namespace

RunComparison compare_runs(const ReportRun& before, const ReportRun& after, const ReportLayouts& layouts,
                           std::span<const std::string> metrics) {
  std::vector<TrialRecord> keys = keys_of(before, after);
  const Observations observations = observations_of(keys);
  const BothRuns runs{make_report_frame(before.metrics, before.trials),
                      make_report_frame(after.metrics, after.trials),
                      before.manifest.experiment,
                      after.manifest.experiment,
                      std::move(keys),
                      observations};
  const Findings findings = findings_of(runs);
  RunComparison result;
  result.pairs = pairs_of(findings, result.only_before, result.only_after);
  result.met = observations.met_by(trials_of_both(findings));
  result.changes = changes_between(before.manifest, after.manifest);
  result.libraries = libraries_of(before.manifest, after.manifest);

  std::vector<MeasuredTwice> compared;
  for (const std::string& metric : metrics) {
    const auto index_before = runs.before.metric(metric);
    const auto index_after = runs.after.metric(metric);
    if (!index_before || !index_after) continue;
    MeasuredTwice& both = compared.emplace_back(MeasuredTwice{rule_of(metric, layouts), rule_of(metric, layouts)});
    both.before.metric = *index_before;
    both.after.metric = *index_after;
  }
  for (const MeasuredTwice& metric : compared) result.metrics.push_back(compare_metric(metric, runs, findings));
  std::vector<PairedDifference*> family;
  for (MetricComparison& one : result.metrics) family.push_back(&one.difference);
  adjust_by_holm(family);
  result.combinations = compare_combinations(compared, runs);
  return result;
}

FailCondition parse_fail_condition(const std::string& text) {
  static const std::regex form(R"(\s*(\w+)\s*([<>])\s*([-+0-9.eE]+)\s*)");
  std::smatch parts;
  FailCondition condition;
  if (std::regex_match(text, parts, form)) {
    condition.metric = parts[1];
    condition.below = parts[2] == "<";
    const std::string number = parts[3];
    const char* const begin = number.data() + (number.front() == '+' ? 1 : 0);
    const auto [end, error] = std::from_chars(begin, number.data() + number.size(), condition.limit);
    if (error == std::errc() && end == number.data() + number.size()) return condition;
  }
  throw InputError(
      fmt::format("--fail-if: '{}' is not of the form \"success < -0.02\" (METRIC, < or >, NUMBER)", text));
}

Verdict judge(const FailCondition& condition, const MetricComparison& comparison) {
  const core::Interval& interval = comparison.difference.over_tasks.interval;
  const auto is_beyond = [&](double value) {
    return condition.below ? value < condition.limit : value > condition.limit;
  };
  if (comparison.pairs > 1 && comparison.difference.equal && !is_beyond(0.0)) return Verdict::holds;
  if (std::isnan(interval.low)) return Verdict::undecided;
  const bool low = is_beyond(interval.low);
  const bool high = is_beyond(interval.high);
  return low && high ? Verdict::fails : low || high ? Verdict::undecided : Verdict::holds;
}

}  // namespace dmrp::host
