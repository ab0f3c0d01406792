// SPDX-License-Identifier: MIT
#include "host/compare/run_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <regex>
#include <tuple>

#include "core/statistics/descriptive.hpp"
#include "core/statistics/holm.hpp"
#include "host/errors/input_error.hpp"
#include "host/ranking/paired_test.hpp"
#include "host/report/data/report_frame.hpp"
#include "host/report/data/report_values.hpp"

namespace dmrp::host {
namespace {

// A crowd and a task, under a seed.
using Situation = std::tuple<std::string, std::uint32_t, std::uint64_t>;
// A trial: its situation, then its plugins' labels.
using TrialKey = std::tuple<Situation, std::string, std::string, std::string>;

TrialKey key_of(const TrialRecord& trial) {
  return {
      {trial.scenario, trial.robots, trial.seed}, trial.global_planner, trial.local_controller, trial.pedestrian_model};
}

std::map<TrialKey, std::size_t> trials_by_key(std::span<const TrialRecord> trials) {
  std::map<TrialKey, std::size_t> found;
  for (std::size_t i = 0; i < trials.size(); ++i)
    if (trials[i].outcome != trial_outcome::skipped) found.emplace(key_of(trials[i]), i);
  return found;
}

struct TrialPair {
  std::size_t before;
  std::size_t after;
  Situation situation;
};

std::vector<TrialPair> pairs_of(const std::map<TrialKey, std::size_t>& before,
                                const std::map<TrialKey, std::size_t>& after) {
  std::vector<TrialPair> pairs;
  for (const auto& [key, trial] : before)
    if (const auto partner = after.find(key); partner != after.end())
      pairs.push_back({trial, partner->second, std::get<0>(key)});
  return pairs;
}

// The trials and values of both runs.
struct ComparedFrames {
  ReportFrame before;
  ReportFrame after;
  const ExperimentFacts& facts_before;
  const ExperimentFacts& facts_after;
};

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

// The values of one metric in both runs.
class ComparedMetricValues {
 public:
  ComparedMetricValues(std::size_t before, std::size_t after, const CountedValue& rule)
      : rule_before_(rule), rule_after_(rule) {
    rule_before_.metric = before;
    rule_after_.metric = after;
  }

  const CountedValue& rule() const { return rule_before_; }

  std::optional<double> before(const ComparedFrames& frames, const TrialPair& pair) const {
    return counted_value(frames.before, frames.facts_before, rule_before_, pair.before);
  }
  std::optional<double> after(const ComparedFrames& frames, const TrialPair& pair) const {
    return counted_value(frames.after, frames.facts_after, rule_after_, pair.after);
  }

 private:
  CountedValue rule_before_;
  CountedValue rule_after_;
};

MetricComparison compare_metric(const ComparedMetricValues& metric, const ComparedFrames& frames,
                                std::span<const TrialPair> pairs) {
  std::vector<double> befores;
  std::vector<double> afters;
  std::map<Situation, std::vector<double>> by_situation;
  for (const TrialPair& pair : pairs) {
    const auto a = metric.before(frames, pair);
    const auto b = metric.after(frames, pair);
    if (!a || !b) continue;
    befores.push_back(*a);
    afters.push_back(*b);
    by_situation[pair.situation].push_back(*b - *a);
  }
  std::vector<double> differences;
  std::vector<std::vector<double>> clusters;
  for (const auto& [situation, values] : by_situation) {
    differences.push_back(core::mean(values));
    clusters.push_back({differences.back()});
  }
  const MetricColumn& column = frames.before.metrics[metric.rule().metric];
  MetricComparison result;
  result.metric = column.name;
  result.unit = column.unit;
  result.pairs = static_cast<std::uint32_t>(befores.size());
  result.seeds = static_cast<std::uint32_t>(differences.size());
  if (differences.empty()) return result;
  result.before = core::mean(befores);
  result.after = core::mean(afters);
  result.difference = core::mean(differences);
  result.interval = core::cluster_bootstrap_interval(clusters);
  const bool equal = std::all_of(differences.begin(), differences.end(), [](double one) { return one == 0.0; });
  const PairedTest test = metric.rule().counts_failures ? PairedTest::sign_flip : PairedTest::signed_rank;
  result.p = equal ? std::numeric_limits<double>::quiet_NaN() : paired_test(differences, test).p;
  return result;
}

void adjust_by_holm(std::span<MetricComparison* const> family) {
  std::vector<double> p_values;
  for (const MetricComparison* one : family) p_values.push_back(one->p);
  const std::vector<double> adjusted = core::holm_adjusted(p_values);
  for (std::size_t i = 0; i < adjusted.size(); ++i) family[i]->p_holm = adjusted[i];
}

std::vector<CombinationComparison> compare_combinations(std::span<const ComparedMetricValues> metrics,
                                                        const ComparedFrames& frames,
                                                        std::span<const TrialPair> pairs) {
  std::map<std::size_t, std::vector<TrialPair>> of_combination;
  for (const TrialPair& pair : pairs) of_combination[frames.before.combination_of[pair.before]].push_back(pair);
  std::vector<CombinationComparison> combinations;
  for (const auto& [combination, own] : of_combination) {
    combinations.push_back({frames.before.combinations[combination], {}});
    for (const ComparedMetricValues& metric : metrics)
      combinations.back().metrics.push_back(compare_metric(metric, frames, own));
  }
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    std::vector<MetricComparison*> family;
    for (CombinationComparison& one : combinations) family.push_back(&one.metrics[i]);
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
  if (before.identity.empty() || after.identity.empty()) return changes;  // of older versions
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
  const auto trials_before = trials_by_key(before.trials);
  const auto trials_after = trials_by_key(after.trials);
  const std::vector<TrialPair> pairs = pairs_of(trials_before, trials_after);
  RunComparison result;
  result.pairs = static_cast<std::uint32_t>(pairs.size());
  result.only_before = static_cast<std::uint32_t>(trials_before.size() - pairs.size());
  result.only_after = static_cast<std::uint32_t>(trials_after.size() - pairs.size());
  result.changes = changes_between(before.manifest, after.manifest);

  result.libraries = libraries_of(before.manifest, after.manifest);

  const ComparedFrames frames{make_report_frame(before.metrics, before.trials),
                              make_report_frame(after.metrics, after.trials), before.manifest.experiment,
                              after.manifest.experiment};
  std::vector<ComparedMetricValues> compared;
  for (const std::string& metric : metrics) {
    const auto index_before = frames.before.metric(metric);
    const auto index_after = frames.after.metric(metric);
    if (index_before && index_after) compared.emplace_back(*index_before, *index_after, rule_of(metric, layouts));
  }
  for (const ComparedMetricValues& metric : compared) result.metrics.push_back(compare_metric(metric, frames, pairs));
  std::vector<MetricComparison*> family;
  for (MetricComparison& one : result.metrics) family.push_back(&one);
  adjust_by_holm(family);
  result.combinations = compare_combinations(compared, frames, pairs);
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
  const core::Interval& interval = comparison.interval;
  if (comparison.seeds < 2) return Verdict::undecided;  // no interval
  const bool whole = condition.below ? interval.high < condition.limit : interval.low > condition.limit;
  const bool part = condition.below ? interval.low < condition.limit : interval.high > condition.limit;
  if (!part) return Verdict::holds;
  return whole && comparison.seeds >= fewest_observations ? Verdict::fails : Verdict::undecided;
}

}  // namespace dmrp::host
