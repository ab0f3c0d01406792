// SPDX-License-Identifier: MIT
#include "host/ranking/measures.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "core/statistics/descriptive.hpp"

namespace dmrp::host {
namespace {

// Unless it was not measured. Whether it was.
bool add_share(std::vector<Criterion>& shares, std::span<const MetricColumn> metrics, const std::string& metric_name,
               const std::map<std::string, std::string>& names) {
  const auto found =
      std::find_if(metrics.begin(), metrics.end(), [&](const auto& metric) { return metric.name == metric_name; });
  if (found == metrics.end()) return false;
  const auto given = names.find(metric_name);
  std::string name = given != names.end() ? given->second : metric_name;
  std::replace(name.begin(), name.end(), '_', ' ');
  shares.push_back({name, Criterion::Kind::share, static_cast<std::size_t>(found - metrics.begin())});
  return true;
}

RobotValues robot_values(std::span<const TrialRecord> trials, const std::string& metric) {
  RobotValues values(trials.size());
  for (std::size_t i = 0; i < trials.size(); ++i) {
    values[i].resize(trials[i].robots);
    for (const MetricValue& value : trials[i].values)
      if (value.subject_kind == DMRP_SUBJECT_ROBOT && !value.coordinate && value.metric == metric && value.subject &&
          *value.subject < values[i].size())
        values[i][*value.subject] = value.value;
  }
  return values;
}

using Curve = std::map<double, double>;  // seconds -> m

Curve progress_of(const TrialRecord& trial, const std::string& metric) {
  Curve curve;
  for (const MetricValue& value : trial.values)
    if (value.subject_kind == DMRP_SUBJECT_SYSTEM && value.coordinate && value.value && value.metric == metric)
      curve[*value.coordinate] = *value.value;
  return curve;
}

// The lost progress at the last second that both curves have, m.
std::optional<double> lost_m(const Curve& without, const Curve& with) {
  for (auto second = with.rbegin(); second != with.rend(); ++second)
    if (const auto same = without.find(second->first); same != without.end()) return same->second - second->second;
  return std::nullopt;
}

bool any_of(const std::vector<std::optional<double>>& values) {
  return std::any_of(values.begin(), values.end(), [](const auto& value) { return value.has_value(); });
}

}  // namespace

std::vector<std::optional<double>> people_delays(const SummaryLayout& layout, std::span<const TrialRecord> trials) {
  using Crowd = std::tuple<std::string, std::string, std::uint64_t>;  // scenario, pedestrian model, seed
  const auto crowd_of = [](const TrialRecord& trial) {
    return Crowd{trial.scenario, trial.pedestrian_model, trial.seed};
  };
  std::map<Crowd, std::pair<Curve, double>> without_robots;  // progress and desired speed
  for (const TrialRecord& trial : trials) {
    if (trial.robots > 0) continue;
    const auto speed = system_value(trial, layout.answer.people_speed);
    if (speed && *speed > 0.0)
      without_robots[crowd_of(trial)] = {progress_of(trial, layout.answer.people_progress), *speed};
  }
  std::vector<std::optional<double>> delays(trials.size());
  if (without_robots.empty()) return delays;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const auto reference = without_robots.find(crowd_of(trials[i]));
    if (trials[i].robots == 0 || reference == without_robots.end()) continue;
    const auto& [progress, speed] = reference->second;
    if (const auto lost = lost_m(progress, progress_of(trials[i], layout.answer.people_progress)))
      delays[i] = *lost / speed;
  }
  return delays;
}

Measures::Measures(const SummaryLayout& layout, std::span<const MetricColumn> metrics,
                   std::span<const TrialRecord> trials)
    : trials_(trials), values_(system_values(metrics, trials)), delays_(people_delays(layout, trials)) {
  for (const std::string& share : layout.answer.shares)
    if (add_share(criteria_, metrics, share, layout.answer.names) && share == layout.answer.safe)
      safe_ = criteria_.size() - 1;
  if (criteria_.empty()) return;
  for (const std::string& sibling : layout.answer.siblings)
    if (safe_) add_share(siblings_, metrics, sibling, layout.answer.names);
  if (any_of(delays_)) criteria_.push_back({"people's delay", Criterion::Kind::delay, 0});
  const RobotValues ways = robot_values(trials, layout.answer.way_length);
  times_ = robot_values(trials, layout.answer.time);
  bool any_time = false;
  for (std::size_t trial = 0; trial < times_.size(); ++trial) {
    for (std::size_t robot = 0; robot < times_[trial].size(); ++robot) {
      std::optional<double>& time = times_[trial][robot];
      const std::optional<double>& way = ways[trial][robot];
      time = time && way && *way > 0.0 ? std::optional(*time / *way) : std::nullopt;
    }
    any_time = any_time || any_of(times_[trial]);
  }
  if (any_time) criteria_.push_back({"time", Criterion::Kind::time, 0});
}

JointValues Measures::joint(const Criterion& criterion) const {
  if (criterion.kind != Criterion::Kind::time)
    return means_of([this, criterion](std::size_t trial) { return value(trial, criterion); });
  return [this](auto trials) -> std::optional<std::vector<double>> {
    std::vector<std::vector<double>> arrived(trials.size());  // with all of them
    for (std::size_t robot = 0; robot < times_[trials.front().front()].size(); ++robot) {
      const bool with_all = std::all_of(trials.begin(), trials.end(), [&](const auto& of_member) {
        const auto& times = times_[of_member.front()];
        return robot < times.size() && times[robot];
      });
      for (std::size_t i = 0; with_all && i < trials.size(); ++i)
        arrived[i].push_back(*times_[trials[i].front()][robot]);
    }
    if (arrived.front().empty()) return std::nullopt;
    std::vector<double> means;
    for (const auto& times : arrived) means.push_back(core::mean(times));
    return means;
  };
}

// In shares a trial that ended in a fault counts as 0; the time is the mean of the robots that arrived.
std::optional<double> Measures::value(std::size_t trial, const Criterion& criterion) const {
  if (criterion.kind == Criterion::Kind::delay) return delays_[trial];
  if (criterion.share()) {
    if (const auto& value = values_[trial][criterion.metric]) return value;
    return trials_[trial].outcome == trial_outcome::fault ? std::optional(0.0) : std::nullopt;
  }
  std::vector<double> arrived;
  for (const std::optional<double>& value : times_[trial])
    if (value) arrived.push_back(*value);
  return arrived.empty() ? std::nullopt : std::optional(core::mean(arrived));
}

bool Measures::are_same(const TrialsOfEntry& a, const TrialsOfEntry& b) const {
  if (a.size() != b.size()) return false;
  const auto same = [&](std::size_t one, std::size_t other) {
    const TrialRecord& x = trials_[one];
    const TrialRecord& y = trials_[other];
    return x.repeatable && y.repeatable && !x.plan_sha256.empty() && x.plan_sha256 == y.plan_sha256 &&
           x.outcome == y.outcome && x.sim_time_s == y.sim_time_s && times_[one] == times_[other] &&
           std::all_of(criteria_.begin(), criteria_.end(),
                       [&](const Criterion& by) { return value(one, by) == value(other, by); });
  };
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!std::equal(a[i].begin(), a[i].end(), b[i].begin(), b[i].end(), same)) return false;
  return true;
}

bool is_better(const std::vector<Criterion>& criteria, const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < criteria.size(); ++i) {
    if (std::isnan(a[i]) != std::isnan(b[i])) return std::isnan(b[i]);
    if (std::isnan(a[i]) || std::fabs(a[i] - b[i]) < rounding) continue;
    return criteria[i].share() ? a[i] > b[i] : a[i] < b[i];
  }
  return false;
}

}  // namespace dmrp::host
