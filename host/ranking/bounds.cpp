// SPDX-License-Identifier: MIT
#include "host/ranking/bounds.hpp"

#include <dmrp/descriptor.h>
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/statistics/descriptive.hpp"
#include "host/ranking/measures.hpp"
#include "host/ranking/paired_difference.hpp"

namespace dmrp::host {
namespace {

// Of the bounds and a controller, by task.
std::vector<BoundedValue> bounded_values(const Findings& findings, const Observations& observations,
                                         const Bounds& bounds, const std::string& controller,
                                         const JointValues& values) {
  std::vector<std::size_t> members;
  for (const std::string& name : {bounds.lower, bounds.upper, controller})
    for (std::size_t i = 0; i < findings.entries.size(); ++i)
      if (findings.entries[i].local_controller == name) members.push_back(i);
  if (members.size() < 3) return {};
  const JointFindings joint = joint_findings(findings, observations, members, values);
  std::vector<BoundedValue> found;
  for (std::size_t task = 0; task < observations.world_of.size(); ++task)
    if (!std::isnan(joint.values[0][task]))
      found.push_back({joint.values[0][task], joint.values[1][task], joint.values[2][task]});
  return found;
}

MetricSummary summary_of(const Place& place, std::uint32_t trials) {
  MetricSummary summary;
  summary.n = place.observations;
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
  const core::Resampling resampling(std::vector<std::uint32_t>(gains.size()), core::Scope::these_worlds);
  const PairedDifference gain = paired_difference(gains, higher_is_better ? PairedTest::mean : PairedTest::signed_rank,
                                                  bounds_of_values(higher_is_better), resampling);
  if (!(gain.p < significant) || (gain.over_tasks.mean > 0.0) != higher_is_better) return result;

  const auto place_of = [&](auto&& count) {
    double of_value = 0.0;
    double of_upper = 0.0;
    for (std::size_t i = 0; i < observations.size(); ++i) {
      of_value += count(i) * (observations[i].value - observations[i].lower);
      of_upper += count(i) * gains[i];
    }
    return of_upper != 0.0 && (of_upper > 0.0) == higher_is_better ? of_value / of_upper : core::undefined;
  };
  result.place = place_of([](std::size_t) { return 1.0; });
  std::vector<double> resampled;
  for (std::size_t k = 0; k < resampling.resamples(); ++k)
    resampled.push_back(place_of([&](std::size_t i) { return static_cast<double>(resampling.counts(k)[i]); }));
  result.interval = core::percentile_interval(std::move(resampled));
  return result;
}

void add_places(const Bounds& bounds, const SummaryLayout& layout, std::span<const TrialRecord> trials,
                std::vector<MetricColumn>& metrics, std::vector<CombinationSummary>& summaries) {
  if (bounds.lower.empty() || bounds.upper.empty()) return;
  const Measures measures(layout, metrics, trials);
  if (!measures.safe()) return;
  struct Column {
    std::string name;
    std::string words;
    Criterion criterion;
  };
  const std::string share = layout.answer.safe;
  std::vector<Column> columns = {{"place_" + share, share, measures.criteria()[*measures.safe()]}};
  if (measures.criteria().back().kind == Criterion::Kind::time)
    columns.push_back({"place_time", "time over the shortest way", measures.criteria().back()});

  for (const Column& column : columns)
    metrics.push_back({column.name, "1", DMRP_DIRECTION_HIGHER, false,
                       fmt::format("from {} (0) to {} (1) in {}", bounds.lower, bounds.upper, column.words), true});
  const Observations observations = observations_of(trials);
  for (CombinationSummary& summary : summaries) {
    const CombinationLabels& labels = summary.combination;
    const Findings findings = make_findings(trials, observations, [&](std::size_t i) -> std::optional<Split> {
      CombinationLabels other = combination_of(trials[i]);
      other.local_controller = labels.local_controller;
      return other == labels ? by_planner_and_controller(trials[i]) : std::nullopt;
    });
    const bool is_bound = labels.local_controller == bounds.lower || labels.local_controller == bounds.upper;
    for (const Column& column : columns) {
      const Place place = is_bound
                              ? Place{}
                              : place_between(bounded_values(findings, observations, bounds, labels.local_controller,
                                                             measures.joint(column.criterion)),
                                              column.criterion.share());
      summary.metrics.push_back(summary_of(place, summary.trials));
    }
  }
}

}  // namespace dmrp::host
