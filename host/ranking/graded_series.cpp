// SPDX-License-Identifier: MIT
#include "host/ranking/graded_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/statistics/descriptive.hpp"
#include "core/statistics/resampling.hpp"
#include "host/ranking/measures.hpp"

namespace dmrp::host {
namespace {

// "Door (people 2)": the title with the swept values of the series' name.
std::string title_of(const ScenarioFacts& facts) {
  return facts.title + facts.series.substr(std::min(facts.series.find(" ("), facts.series.size()));
}

// The series with its levels from the hardest to the easiest.
std::vector<GradedSeries> empty_series(std::span<const ScenarioFacts> scenarios) {
  std::vector<GradedSeries> all;
  for (const ScenarioFacts& facts : scenarios) {
    if (facts.series.empty()) continue;
    auto series = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.name == facts.series; });
    if (series == all.end())
      series = all.insert(
          all.end(), {facts.series, title_of(facts), facts.quantity, facts.unit, facts.harder_when_higher, {}, {}, {}});
    const auto is_easier = [&](double level) {
      return facts.harder_when_higher ? level < facts.level : level > facts.level;
    };
    const auto at = std::find_if(series->levels.begin(), series->levels.end(), is_easier);
    series->scenarios.insert(series->scenarios.begin() + (at - series->levels.begin()), facts.name);
    series->levels.insert(at, facts.level);
  }
  return all;
}

// The results of one combination while trials are collected.
struct Collected {
  GradedResult result;
  std::vector<core::LevelOutcomes> levels;
};

Collected& collected_for(std::vector<Collected>& all, const TrialRecord& trial, const GradedSeries& series) {
  const auto is_same = [&](const Collected& one) {
    return one.result.global_planner == trial.global_planner && one.result.local_controller == trial.local_controller &&
           one.result.pedestrian_model == trial.pedestrian_model;
  };
  if (const auto found = std::find_if(all.begin(), all.end(), is_same); found != all.end()) return *found;
  Collected& added = all.emplace_back();
  added.result.global_planner = trial.global_planner;
  added.result.local_controller = trial.local_controller;
  added.result.pedestrian_model = trial.pedestrian_model;
  for (const double level : series.levels) added.levels.push_back({level, {}});
  return added;
}

// A repetition passes if all of its robots do: with a helper in the test, half of the robots is nobody's success.
void take(const TrialRecord& trial, std::size_t level, const std::string& share, Collected& into) {
  std::vector<double>& values = into.levels[level].by_repetition;
  if (values.size() <= trial.repetition) values.resize(trial.repetition + 1, core::undefined);
  const auto value = system_value(trial, share);
  if (value) values[trial.repetition] = *value >= 1.0 - rounding ? 1.0 : 0.0;
  if (!value && trial.outcome == trial_outcome::fault) values[trial.repetition] = 0.0;
}

GradedResult finished(Collected& one) {
  std::size_t repetitions = 0;
  for (const core::LevelOutcomes& level : one.levels) repetitions = std::max(repetitions, level.by_repetition.size());
  for (core::LevelOutcomes& level : one.levels) {
    level.by_repetition.resize(repetitions, core::undefined);
    std::vector<double> defined;
    for (const double value : level.by_repetition)
      if (!std::isnan(value)) defined.push_back(value);
    one.result.means.push_back(core::mean(defined));
  }
  const core::Resampling resampling(std::vector<std::uint32_t>(repetitions), core::Scope::these_worlds);
  one.result.estimate = core::estimate_threshold(one.levels, resampling);
  return one.result;
}

// Three digits are more than any interval here is worth.
std::string shown(double level) {
  return fmt::format("{:.3g}", level);
}

std::string shown(const GradedSeries& series, const core::Threshold& end) {
  if (end.beyond_hardest) return (series.harder_when_higher ? "≥ " : "≤ ") + shown(end.level);
  if (end.beyond_easiest) return (series.harder_when_higher ? "< " : "> ") + shown(end.level);
  return shown(end.level);
}

}  // namespace

std::vector<GradedSeries> graded_series(const SummaryLayout& layout, std::span<const ScenarioFacts> scenarios,
                                        std::span<const TrialRecord> trials) {
  const std::string& share = layout.answer.safe;
  if (share.empty()) return {};
  std::vector<GradedSeries> all = empty_series(scenarios);
  for (GradedSeries& series : all) {
    std::vector<Collected> collected;
    for (const TrialRecord& trial : trials) {
      const auto level = std::find(series.scenarios.begin(), series.scenarios.end(), trial.scenario);
      if (level == series.scenarios.end() || trial.robots == 0 || !has_result(trial)) continue;
      take(trial, static_cast<std::size_t>(level - series.scenarios.begin()), share,
           collected_for(collected, trial, series));
    }
    for (Collected& one : collected) series.results.push_back(finished(one));
  }
  std::erase_if(all, [](const GradedSeries& series) { return series.results.empty(); });
  return all;
}

std::string threshold_words(const GradedSeries& series, const core::ThresholdEstimate& estimate) {
  const std::string unit = series.unit == "1" ? "" : " " + series.unit;
  if (const core::ThresholdBracket& bracket = estimate.bracket; bracket.is_steep) {
    const auto [low, high] = std::minmax(*bracket.last_failed, *bracket.first_passed);
    return fmt::format("between {} and {}{}", shown(low), shown(high), unit);
  }
  const std::string at = shown(series, estimate.threshold);
  const std::string low = shown(series, series.harder_when_higher ? estimate.high : estimate.low);
  const std::string high = shown(series, series.harder_when_higher ? estimate.low : estimate.high);
  if (low == high) return at + unit;
  return fmt::format("{} [{}, {}]{}", at, low, high, unit);
}

std::string combination_name(std::span<const GradedSeries> all, const GradedResult& result) {
  const GradedResult& first = all.front().results.front();
  bool planners = false;
  bool models = false;
  for (const GradedSeries& series : all)
    for (const GradedResult& other : series.results) {
      planners = planners || other.global_planner != first.global_planner;
      models = models || (!other.pedestrian_model.empty() && other.pedestrian_model != result.pedestrian_model &&
                          !result.pedestrian_model.empty());
    }
  std::string name = planners ? result.global_planner + " + " + result.local_controller : result.local_controller;
  if (models) name += " · " + result.pedestrian_model;
  return name;
}

}  // namespace dmrp::host
