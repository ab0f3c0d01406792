// SPDX-License-Identifier: MIT
// measures.hpp: in what combinations of planner and controller are compared: shares of robots, people's delay, time.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/findings/findings.hpp"
#include "host/results/summary_layout.hpp"
#include "host/results/system_values.hpp"

namespace dmrp::host {

// Sums in another order differ by less.
inline constexpr double rounding = 1e-9;

// [trial][robot]: one metric's values for robots; none if undefined or not measured.
using RobotValues = std::vector<std::vector<std::optional<double>>>;

// In each trial the delay of people by the robots, s; none if no trial without robots had the same crowd. Let P(t) be
// the mean progress of a person towards its goals by time t, P0(t) the progress without robots, v the mean desired speed
// and T the last second that both trials have (the end of the mission if people are still present without robots). Then
//   delay = (P0(T) - P(T)) / v
// is the time that a person needs to walk the lost distance. It is negative if people progress faster with robots.
std::vector<std::optional<double>> people_delays(const SummaryLayout& layout, std::span<const TrialRecord> trials);

// Something in which combinations are compared. Of the time of arrival, over the length of the robot's shortest way,
// those robots count that arrive with all that are compared.
struct Criterion {
  enum class Kind { share, delay, time };

  std::string name;  // for readers
  Kind kind = Kind::share;
  std::size_t metric = 0;  // of a share: its column

  bool share() const { return kind == Kind::share; }  // higher is better, else lower
  const char* unit() const { return share() ? "1" : kind == Kind::delay ? "s" : "s/m"; }
};

// How trials are compared in each criterion.
class Measures {
 public:
  // Keeps `trials`.
  Measures(const SummaryLayout& layout, std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials);

  // Shares first, as far as they were measured, time last; none without a share.
  const std::vector<Criterion>& criteria() const { return criteria_; }

  // Of criteria(): whether robots arrived without a fault; none if it was not measured.
  std::optional<std::size_t> safe() const { return safe_; }

  // The siblings of safe(), shares, as far as they and it were measured.
  const std::vector<Criterion>& siblings() const { return siblings_; }

  JointValues joint(const Criterion& criterion) const;

  // Whether two entries have the same plans, times and criteria in every trial. By situation: indices of trials.
  using TrialsOfEntry = std::vector<std::vector<std::size_t>>;
  bool are_same(const TrialsOfEntry& a, const TrialsOfEntry& b) const;
  std::optional<double> value(std::size_t trial, const Criterion& criterion) const;

 private:
  std::span<const TrialRecord> trials_;
  SystemValues values_;
  std::vector<std::optional<double>> delays_;  // by trial
  RobotValues times_;                          // over the lengths of the shortest ways, s/m
  std::vector<Criterion> criteria_;
  std::optional<std::size_t> safe_;
  std::vector<Criterion> siblings_;
};

// Whether means a come before means b, by criterion. An undefined mean comes last.
bool is_better(const std::vector<Criterion>& criteria, const std::vector<double>& a, const std::vector<double>& b);

}  // namespace dmrp::host
