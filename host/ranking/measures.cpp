// SPDX-License-Identifier: MIT
#include "host/ranking/measures.hpp"

#include <algorithm>
#include <cmath>

#include "core/statistics/descriptive.hpp"

namespace dmrp::host {
namespace {

// Unless it was not measured.
void add_share(std::vector<Criterion>& shares, std::span<const MetricColumn> metrics, std::string name) {
  const auto found =
      std::find_if(metrics.begin(), metrics.end(), [&](const auto& metric) { return metric.name == name; });
  if (found == metrics.end()) return;
  std::replace(name.begin(), name.end(), '_', ' ');
  shares.push_back({name, true, static_cast<std::size_t>(found - metrics.begin())});
}

}  // namespace

Measures::Measures(const SummaryLayout& layout, std::span<const MetricColumn> metrics,
                   std::span<const TrialRecord> trials)
    : trials_(trials), values_(system_values(metrics, trials)) {
  for (const std::string& share : layout.answer.shares) {
    add_share(criteria_, metrics, share);
    if (share != layout.answer.shares.front() || criteria_.empty()) continue;
    for (const std::string& sibling : layout.answer.siblings) add_share(siblings_, metrics, sibling);
  }
  const RobotValues ways = robot_values(trials, layout.answer.way_length);
  times_ = robot_values(trials, layout.answer.time);
  bool any_time = false;
  for (std::size_t trial = 0; trial < times_.size(); ++trial)
    for (std::size_t robot = 0; robot < times_[trial].size(); ++robot) {
      std::optional<double>& time = times_[trial][robot];
      const std::optional<double>& way = ways[trial][robot];
      time = time && way && *way > 0.0 ? std::optional(*time / *way) : std::nullopt;
      any_time = any_time || time;
    }
  if (any_time && !criteria_.empty()) criteria_.push_back({"time", false, 0});
}

Difference Measures::difference(std::size_t criterion) const {
  if (criteria_[criterion].share)
    return difference_of(
        [this, metric = criteria_[criterion].metric](std::size_t trial) { return share(trial, metric); });
  return [this](std::span<const std::size_t> a, std::span<const std::size_t> b) {
    return time_difference(a.front(), b.front());
  };
}

double Measures::mean(std::span<const std::size_t> trials, const Criterion& criterion) const {
  std::vector<double> values;
  for (const std::size_t trial : trials) {
    if (const auto found = value(trial, criterion)) values.push_back(*found);
  }
  return core::mean(values);
}

std::optional<double> Measures::value(std::size_t trial, const Criterion& criterion) const {
  return criterion.share ? share(trial, criterion.metric) : time(trial);
}

// A trial that ended in a fault counts as 0.
std::optional<double> Measures::share(std::size_t trial, std::size_t metric) const {
  if (const auto& value = values_[trial][metric]) return value;
  return trials_[trial].outcome == trial_outcome::fault ? std::optional(0.0) : std::nullopt;
}

// The mean of the robots that arrived.
std::optional<double> Measures::time(std::size_t trial) const {
  std::vector<double> arrived;
  for (const std::optional<double>& value : times_[trial])
    if (value) arrived.push_back(*value);
  if (arrived.empty()) return std::nullopt;
  return core::mean(arrived);
}

// The mean over the robots that arrived in both trials.
std::optional<double> Measures::time_difference(std::size_t a, std::size_t b) const {
  std::vector<double> differences;
  for (std::size_t robot = 0; robot < std::min(times_[a].size(), times_[b].size()); ++robot)
    if (times_[a][robot] && times_[b][robot]) differences.push_back(*times_[b][robot] - *times_[a][robot]);
  if (differences.empty()) return std::nullopt;
  return core::mean(differences);
}

bool is_better(const std::vector<Criterion>& criteria, const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < criteria.size(); ++i) {
    if (std::isnan(a[i]) != std::isnan(b[i])) return std::isnan(b[i]);
    if (std::isnan(a[i]) || std::fabs(a[i] - b[i]) < rounding) continue;
    return criteria[i].share ? a[i] > b[i] : a[i] < b[i];
  }
  return false;
}

}  // namespace dmrp::host
