// SPDX-License-Identifier: MIT
#include "host/ranking/best_marks.hpp"

#include <dmrp/descriptor.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/statistics/best_set.hpp"

namespace dmrp::host {
namespace {

class Marker {
 public:
  Marker(const SummaryLayout& layout, std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials)
      : arrived_(layout.arrived), metrics_(metrics), values_(kinds_of(layout), metrics, trials) {}

  const MetricValues& values() const { return values_; }

  // The entry that is the best in a metric; none if it cannot be told apart from another.
  std::optional<std::size_t> best(const Findings& findings, std::size_t metric) const {
    const MetricColumn& column = metrics_[metric];
    if (column.direction == DMRP_DIRECTION_NONE || column.wall_clock) return std::nullopt;
    const bool share = values_.is_share(metric);
    if (!share && !values_.is_of_plans(metric) && !same_success(findings)) return std::nullopt;
    const JointFindings table = joint(findings, metric);
    const std::vector<core::Criterion> criteria{
        {core::differences_of(table.values), column.direction == DMRP_DIRECTION_HIGHER,
         share ? core::PairedScore::mean : core::PairedScore::ranks, 0.0, bounds_of_values(share)}};
    const auto excluded =
        core::best_set(findings.entries.size(), criteria, values_.observations(metric).resampling).excluded;
    if (excluded.size() < 2 || std::count(excluded.begin(), excluded.end(), std::nullopt) != 1) return std::nullopt;
    return static_cast<std::size_t>(std::find(excluded.begin(), excluded.end(), std::nullopt) - excluded.begin());
  }

 private:
  JointFindings joint(const Findings& findings, std::size_t metric) const {
    std::vector<std::size_t> all(findings.entries.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return joint_findings(findings, values_.observations(metric), all,
                          means_of([&](std::size_t trial) { return values_.of(trial, metric); }));
  }

  // A robot that fails drives less.
  bool same_success(const Findings& findings) const {
    const auto metric = std::find_if(metrics_.begin(), metrics_.end(),
                                     [&](const MetricColumn& column) { return column.name == arrived_; });
    if (metric == metrics_.end()) return true;
    const auto values = joint(findings, static_cast<std::size_t>(metric - metrics_.begin())).values;
    std::vector<double> sums;
    for (const std::vector<double>& of_entry : values)
      sums.push_back(std::accumulate(of_entry.begin(), of_entry.end(), 0.0,
                                     [](double sum, double one) { return std::isnan(one) ? sum : sum + one; }));
    return std::adjacent_find(sums.begin(), sums.end(), std::not_equal_to<>()) == sums.end();
  }

  const std::string& arrived_;
  std::span<const MetricColumn> metrics_;
  MetricValues values_;
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
    for (std::size_t metric = 0; metric < metrics.size(); ++metric) {
      const Findings findings = make_findings(trials, marker.values().observations(metric), split);
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
