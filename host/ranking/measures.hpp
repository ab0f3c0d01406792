// SPDX-License-Identifier: MIT
// measures.hpp: in what combinations of planner and controller are compared: shares of robots, and time.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/ranking/contest.hpp"
#include "host/results/summary_layout.hpp"
#include "host/results/system_values.hpp"

namespace dmrp::host {

// Sums in another order differ by less.
inline constexpr double rounding = 1e-9;

// Something in which combinations are compared: a share of robots (higher is better), or the time of arrival over the
// length of the robot's shortest way (lower is better), of robots that arrive with both.
struct Criterion {
  std::string name;        // for readers
  bool share = true;       // false: the time, in s/m
  std::size_t metric = 0;  // of a share: its column
};

// How trials are compared in each criterion.
class Measures {
 public:
  // Keeps `trials`.
  Measures(const SummaryLayout& layout, std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials);

  const std::vector<Criterion>& criteria() const { return criteria_; }

  // The siblings of the first criterion, shares, as far as they and it were measured.
  const std::vector<Criterion>& siblings() const { return siblings_; }
  const RobotValues& times() const { return times_; }  // over the lengths of the shortest ways, s/m

  Difference difference(std::size_t criterion) const;
  double mean(std::span<const std::size_t> trials, const Criterion& criterion) const;  // NaN: undefined
  std::optional<double> value(std::size_t trial, const Criterion& criterion) const;

 private:
  std::optional<double> share(std::size_t trial, std::size_t metric) const;
  std::optional<double> time(std::size_t trial) const;
  std::optional<double> time_difference(std::size_t a, std::size_t b) const;

  std::span<const TrialRecord> trials_;
  SystemValues values_;
  RobotValues times_;  // over the lengths of the shortest ways
  std::vector<Criterion> criteria_;
  std::vector<Criterion> siblings_;
};

// Whether means a come before means b, by criterion. An undefined time comes last.
bool is_better(const std::vector<Criterion>& criteria, const std::vector<double>& a, const std::vector<double>& b);

}  // namespace dmrp::host
