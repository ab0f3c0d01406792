// SPDX-License-Identifier: MIT
#include "host/ranking/best_marks.hpp"

#include <dmrp/descriptor.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/statistics/best_set.hpp"

namespace dmrp::host {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

class Marker {
 public:
  Marker(const SummaryLayout& layout, std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials)
      : layout_(layout),
        metrics_(metrics),
        trials_(trials),
        values_(system_values(metrics, trials)),
        observations_(observations_of(trials)),
        plans_(observations_of(trials, Unit::plan)) {}

  const Observations& observations() const { return observations_; }
  const Observations& plans() const { return plans_; }
  bool is_of_plans(std::size_t metric) const { return contains(layout_.of_plans, metrics_[metric].name); }

  // The entry that is the best in a metric; none if it cannot be told apart from another.
  std::optional<std::size_t> best(const Findings& findings, std::size_t metric) const {
    const MetricColumn& column = metrics_[metric];
    if (column.direction == DMRP_DIRECTION_NONE || column.wall_clock) return std::nullopt;
    const bool of_driving = !contains(layout_.counts_failures, column.name) && !is_of_plans(metric);
    if (of_driving && !same_success(findings)) return std::nullopt;
    const bool share = contains(layout_.counts_failures, column.name);
    const JointFindings table = joint(findings, metric);
    const std::vector<core::Criterion> criteria{
        {core::differences_of(table.values), column.direction == DMRP_DIRECTION_HIGHER,
         share ? core::PairedScore::mean : core::PairedScore::ranks, 0.0, bounds_of_values(share)}};
    const auto excluded = core::best_set(findings.entries.size(), criteria, of(metric).resampling).excluded;
    if (excluded.size() < 2 || std::count(excluded.begin(), excluded.end(), std::nullopt) != 1) return std::nullopt;
    return static_cast<std::size_t>(std::find(excluded.begin(), excluded.end(), std::nullopt) - excluded.begin());
  }

 private:
  JointFindings joint(const Findings& findings, std::size_t metric) const {
    std::vector<std::size_t> all(findings.entries.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    const bool counts = contains(layout_.counts_failures, metrics_[metric].name);
    return joint_findings(findings, of(metric), all, means_of([&](std::size_t trial) {
                            if (values_[trial][metric]) return values_[trial][metric];
                            return counts && trials_[trial].outcome == trial_outcome::fault ? std::optional(0.0)
                                                                                            : std::nullopt;
                          }));
  }

  const Observations& of(std::size_t metric) const { return is_of_plans(metric) ? plans_ : observations_; }

  // A robot that fails drives less.
  bool same_success(const Findings& findings) const {
    const auto metric = std::find_if(metrics_.begin(), metrics_.end(),
                                     [&](const MetricColumn& column) { return column.name == layout_.arrived; });
    if (metric == metrics_.end()) return true;
    const auto values = joint(findings, static_cast<std::size_t>(metric - metrics_.begin())).values;
    std::vector<double> sums;
    for (const std::vector<double>& of_entry : values)
      sums.push_back(std::accumulate(of_entry.begin(), of_entry.end(), 0.0,
                                     [](double sum, double one) { return std::isnan(one) ? sum : sum + one; }));
    return std::adjacent_find(sums.begin(), sums.end(), std::not_equal_to<>()) == sums.end();
  }

  const SummaryLayout& layout_;
  std::span<const MetricColumn> metrics_;
  std::span<const TrialRecord> trials_;
  SystemValues values_;
  Observations observations_;
  Observations plans_;
};

}  // namespace

std::vector<BestMark> best_marks(const SummaryLayout& layout, std::span<const MetricColumn> metrics,
                                 std::span<const TrialRecord> trials, Contestants contestants) {
  const Marker marker(layout, metrics, trials);
  const auto split_of = contestants == Contestants::planners ? by_planner : by_planner_and_controller;
  std::vector<CombinationLabels> cells;
  for (const TrialRecord& trial : trials)
    if (const auto split = split_of(trial); split && std::find(cells.begin(), cells.end(), split->cell) == cells.end())
      cells.push_back(split->cell);
  std::vector<BestMark> marks;
  for (const CombinationLabels& cell : cells) {
    const auto split = [&](std::size_t i) {
      const auto split = split_of(trials[i]);
      return split && split->cell == cell ? split : std::nullopt;
    };
    const Findings of_trials = make_findings(trials, marker.observations(), split);
    const Findings of_plans = make_findings(trials, marker.plans(), split);
    for (std::size_t metric = 0; metric < metrics.size(); ++metric) {
      const Findings& findings = marker.is_of_plans(metric) ? of_plans : of_trials;
      if (const auto best = marker.best(findings, metric)) {
        CombinationLabels labels = cell;
        labels.global_planner = findings.entries[*best].global_planner;
        labels.local_controller = findings.entries[*best].local_controller;
        marks.push_back({labels, metrics[metric].name});
      }
    }
  }
  return marks;
}

}  // namespace dmrp::host
