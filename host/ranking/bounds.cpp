// SPDX-License-Identifier: MIT
#include "host/ranking/bounds.hpp"

#include <dmrp/descriptor.h>
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

#include "core/statistics/descriptive.hpp"
#include "host/ranking/contest.hpp"
#include "host/ranking/measures.hpp"
#include "host/ranking/paired_test.hpp"

namespace dmrp::host {
namespace {

// In one situation; none unless all three are defined.
using Find = std::function<std::optional<BoundedValue>(std::size_t lower, std::size_t upper, std::size_t trial)>;

std::size_t index_of(const Contest& contest, const std::string& controller) {
  const auto found = std::find_if(contest.contestants.begin(), contest.contestants.end(),
                                  [&](const auto& labels) { return labels.local_controller == controller; });
  return static_cast<std::size_t>(found - contest.contestants.begin());
}

BoundedValue mean_of(const std::vector<BoundedValue>& values) {
  BoundedValue sum{0.0, 0.0, 0.0};
  for (const BoundedValue& one : values) {
    sum.lower += one.lower;
    sum.upper += one.upper;
    sum.value += one.value;
  }
  const auto count = static_cast<double>(values.size());
  return {sum.lower / count, sum.upper / count, sum.value / count};
}

std::vector<BoundedValue> observations(const Contest& contest, const Bounds& bounds, const std::string& controller,
                                       const Find& find) {
  const std::size_t lower = index_of(contest, bounds.lower);
  const std::size_t upper = index_of(contest, bounds.upper);
  const std::size_t one = index_of(contest, controller);
  const std::size_t count = contest.contestants.size();
  if (lower == count || upper == count || one == count) return {};
  std::map<std::size_t, std::vector<BoundedValue>> found;
  for (std::size_t i = 0; i < contest.situations.size(); ++i) {
    if (contest.trials[lower][i].empty() || contest.trials[upper][i].empty() || contest.trials[one][i].empty())
      continue;
    const auto values =
        find(contest.trials[lower][i].front(), contest.trials[upper][i].front(), contest.trials[one][i].front());
    if (values) found[in_general(contest) ? contest.situations[i].task : i].push_back(*values);
  }
  std::vector<BoundedValue> means;
  for (const auto& [observation, values] : found) means.push_back(mean_of(values));
  return means;
}

Find share_of(const Measures& measures) {
  return [&measures](std::size_t lower, std::size_t upper, std::size_t trial) -> std::optional<BoundedValue> {
    const Criterion& first = measures.criteria().front();
    const auto of_lower = measures.value(lower, first);
    const auto of_upper = measures.value(upper, first);
    const auto of_trial = measures.value(trial, first);
    if (!of_lower || !of_upper || !of_trial) return std::nullopt;
    return BoundedValue{*of_lower, *of_upper, *of_trial};
  };
}

Find time_of(const Measures& measures) {
  return [&times = measures.times()](std::size_t lower, std::size_t upper,
                                     std::size_t trial) -> std::optional<BoundedValue> {
    std::vector<BoundedValue> robots;
    const std::size_t count = std::min({times[lower].size(), times[upper].size(), times[trial].size()});
    for (std::size_t robot = 0; robot < count; ++robot)
      if (times[lower][robot] && times[upper][robot] && times[trial][robot])
        robots.push_back({*times[lower][robot], *times[upper][robot], *times[trial][robot]});
    if (robots.empty()) return std::nullopt;
    return mean_of(robots);
  };
}

MetricSummary summary_of(const Place& place, std::uint32_t trials) {
  MetricSummary summary;
  summary.defined = std::isnan(place.place) ? 0 : trials;
  summary.mean = place.place;
  summary.sd = core::undefined;
  summary.median = core::undefined;
  summary.interval = place.interval;
  summary.paper.mean = core::undefined;
  return summary;
}

}  // namespace

Bounds bounds_of(std::string_view effective_toml) {
  Bounds bounds;
  const toml::table root = toml::parse(effective_toml);
  const toml::array* controllers = root["local_controller"].as_array();
  for (std::size_t i = 0; controllers && i < controllers->size(); ++i) {
    const toml::table* use = controllers->get(i)->as_table();
    if (!use) continue;
    const auto bound = (*use)["bound"].value<std::string>();
    if (bound == "lower") bounds.lower = (*use)["label"].value_or(std::string());
    if (bound == "upper") bounds.upper = (*use)["label"].value_or(std::string());
  }
  return bounds;
}

Place place_between(std::span<const BoundedValue> observations, bool higher_is_better) {
  Place result;
  result.observations = static_cast<std::uint32_t>(observations.size());
  if (observations.empty()) return result;
  std::vector<double> gains;  // of the upper bound over the lower one
  for (const BoundedValue& one : observations) gains.push_back(one.upper - one.lower);
  const double gain = core::mean(gains);
  const double p = paired_test(gains, higher_is_better ? PairedTest::sign_flip : PairedTest::signed_rank).p;
  if (!(p < significant) || (gain > 0.0) != higher_is_better) return result;

  const auto place_of = [&](auto&& indices) {
    double of_value = 0.0;
    double of_upper = 0.0;
    for (const std::size_t i : indices) {
      of_value += observations[i].value - observations[i].lower;
      of_upper += gains[i];
    }
    return of_upper != 0.0 && (of_upper > 0.0) == higher_is_better ? of_value / of_upper : core::undefined;
  };
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < observations.size(); ++i) all.push_back(i);
  result.place = place_of(all);
  const core::BootstrapDraws draws(observations.size());
  std::vector<double> resampled;
  for (std::size_t i = 0; i < draws.resamples(); ++i) resampled.push_back(place_of(draws.resample(i)));
  result.interval = core::percentile_interval(std::move(resampled));
  return result;
}

void add_places(const Bounds& bounds, const SummaryLayout& layout, std::span<const TrialRecord> trials,
                std::vector<MetricColumn>& metrics, std::vector<CombinationSummary>& summaries) {
  if (bounds.lower.empty() || bounds.upper.empty()) return;
  const Measures measures(layout, metrics, trials);
  if (measures.criteria().empty() || !measures.criteria().front().share) return;
  struct Column {
    std::string name;
    std::string words;
    bool higher_is_better;
    Find find;
  };
  const std::string share = layout.answer.shares.front();
  std::vector<Column> columns = {{"place_" + share, share, true, share_of(measures)}};
  if (!measures.criteria().back().share)
    columns.push_back({"place_time", "time over the shortest way", false, time_of(measures)});

  for (const Column& column : columns)
    metrics.push_back({column.name, "1", DMRP_DIRECTION_HIGHER, false,
                       fmt::format("from {} (0) to {} (1) in {}", bounds.lower, bounds.upper, column.words), true});
  for (CombinationSummary& summary : summaries) {
    const CombinationLabels& labels = summary.combination;
    const Contest contest =
        make_contest(trials, Contestants::planners_and_controllers, [&](const CombinationLabels& other) {
          return other.scenario == labels.scenario && other.robots == labels.robots &&
                 other.pedestrian_model == labels.pedestrian_model && other.global_planner == labels.global_planner;
        });
    const bool is_bound = labels.local_controller == bounds.lower || labels.local_controller == bounds.upper;
    for (const Column& column : columns) {
      const Place place = is_bound ? Place{}
                                   : place_between(observations(contest, bounds, labels.local_controller, column.find),
                                                   column.higher_is_better);
      summary.metrics.push_back(summary_of(place, summary.trials));
    }
  }
}

}  // namespace dmrp::host
