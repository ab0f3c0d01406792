// SPDX-License-Identifier: MIT
#include "host/ranking/best_marks.hpp"

#include <dmrp/descriptor.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/statistics/holm.hpp"
#include "host/ranking/paired_test.hpp"

namespace dmrp::host {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

using Value = std::function<std::optional<double>(std::size_t trial)>;

// Of all trials of a contestant; NaN if undefined in all.
double mean_of(const Contest& contest, std::size_t contestant, const Value& value) {
  double sum = 0.0;
  double count = 0.0;
  for (const auto& trials : contest.trials[contestant])
    for (const std::size_t trial : trials)
      if (const auto found = value(trial)) {
        sum += *found;
        count += 1.0;
      }
  return sum / count;
}

bool all_equal(const std::vector<double>& values) {
  return std::adjacent_find(values.begin(), values.end(), std::not_equal_to<>()) == values.end();
}

class Marker {
 public:
  Marker(const SummaryLayout& layout, std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials)
      : layout_(layout), metrics_(metrics), trials_(trials), values_(system_values(metrics, trials)) {}

  // The contestant that is the best in a metric; none if it cannot be told apart from another.
  std::optional<std::size_t> best(const Contest& contest, std::size_t metric) const {
    if (contest.contestants.size() < 2 || metrics_[metric].direction == DMRP_DIRECTION_NONE ||
        metrics_[metric].wall_clock)
      return std::nullopt;
    if (depends_on_failures(metrics_[metric].name) && !same_success(contest)) return std::nullopt;
    const Value value = value_of(metric);
    std::vector<double> means;
    for (std::size_t i = 0; i < contest.contestants.size(); ++i) means.push_back(mean_of(contest, i, value));
    if (std::any_of(means.begin(), means.end(), [](double mean) { return std::isnan(mean); })) return std::nullopt;
    const double sign = metrics_[metric].direction == DMRP_DIRECTION_LOWER ? 1.0 : -1.0;
    std::vector<std::size_t> order(means.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return sign * means[a] < sign * means[b]; });
    return is_apart(contest, order, difference_of(value), sign, metric) ? std::optional(order.front()) : std::nullopt;
  }

 private:
  bool counts_failures(std::size_t metric) const { return contains(layout_.counts_failures, metrics_[metric].name); }

  bool depends_on_failures(const std::string& metric) const {
    return !contains(layout_.counts_failures, metric) && !contains(layout_.of_plans, metric);
  }

  Value value_of(std::size_t metric) const {
    return [this, metric, counts = counts_failures(metric)](std::size_t trial) -> std::optional<double> {
      if (values_[trial][metric]) return values_[trial][metric];
      return counts && trials_[trial].outcome == trial_outcome::fault ? std::optional(0.0) : std::nullopt;
    };
  }

  bool same_success(const Contest& contest) const {
    const auto metric = std::find_if(metrics_.begin(), metrics_.end(),
                                     [&](const MetricColumn& column) { return column.name == layout_.arrived; });
    if (metric == metrics_.end()) return true;
    const Value success = value_of(static_cast<std::size_t>(metric - metrics_.begin()));
    std::vector<double> means;
    for (std::size_t i = 0; i < contest.contestants.size(); ++i) means.push_back(mean_of(contest, i, success));
    return all_equal(means);
  }

  // Whether the first of the order differs from each of the others. The nearest is the likeliest to fail.
  bool is_apart(const Contest& contest, const std::vector<std::size_t>& order, const Difference& difference,
                double sign, std::size_t metric) const {
    const PairedTest test = counts_failures(metric) ? PairedTest::sign_flip : PairedTest::signed_rank;
    std::vector<double> p_values;
    for (std::size_t i = 1; i < order.size(); ++i) {
      const PairedResult result = paired_test(paired_differences(contest, order[0], order[i], difference), test);
      if (!(result.p < significant) || sign * result.direction <= 0.0) return false;
      p_values.push_back(result.p);
    }
    const std::vector<double> adjusted = core::holm_adjusted(p_values);
    return std::all_of(adjusted.begin(), adjusted.end(), [](double p) { return p < significant; });
  }

  const SummaryLayout& layout_;
  std::span<const MetricColumn> metrics_;
  std::span<const TrialRecord> trials_;
  SystemValues values_;
};

// What the rows of a group share.
CombinationLabels group_of(const CombinationLabels& labels, Contestants contestants) {
  return {labels.scenario, labels.robots, "", "",
          contestants == Contestants::planners ? std::string() : labels.pedestrian_model};
}

std::vector<CombinationLabels> groups_of(std::span<const TrialRecord> trials, Contestants contestants) {
  std::vector<CombinationLabels> groups;
  for (const TrialRecord& trial : trials) {
    const CombinationLabels group = group_of(combination_of(trial), contestants);
    if (group.robots > 0 && std::find(groups.begin(), groups.end(), group) == groups.end()) groups.push_back(group);
  }
  return groups;
}

}  // namespace

std::vector<BestMark> best_marks(const SummaryLayout& layout, std::span<const MetricColumn> metrics,
                                 std::span<const TrialRecord> trials, Contestants contestants) {
  const Marker marker(layout, metrics, trials);
  std::vector<BestMark> marks;
  for (const CombinationLabels& group : groups_of(trials, contestants)) {
    const Contest contest = make_contest(
        trials, contestants, [&](const CombinationLabels& labels) { return group_of(labels, contestants) == group; });
    for (std::size_t metric = 0; metric < metrics.size(); ++metric)
      if (const auto best = marker.best(contest, metric)) {
        CombinationLabels labels = group;
        labels.global_planner = contest.contestants[*best].global_planner;
        labels.local_controller = contest.contestants[*best].local_controller;
        marks.push_back({labels, metrics[metric].name});
      }
  }
  return marks;
}

}  // namespace dmrp::host
