// SPDX-License-Identifier: MIT
// answer.hpp: which combination of planner and controller is better: an order, and who can be told apart from the first.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/statistics/bootstrap.hpp"
#include "host/ranking/contest.hpp"
#include "host/ranking/measures.hpp"
#include "host/ranking/pairs_apart.hpp"
#include "host/results/summary_layout.hpp"
#include "host/results/system_values.hpp"

namespace dmrp::host {

// A combination against the first, in one criterion. Differences are the combination's minus the first's.
struct AgainstFirst {
  std::uint32_t observations = 0;
  double mean = 0.0;
  core::Interval interval{};  // 95 %, bootstrap over observations
  double sd = 0.0;            // of the differences
  double p = 1.0;             // NaN: equal in every observation, or none; nothing to test
  double p_holm = 1.0;        // over all combinations and criteria
};

enum class Standing {
  first,
  not_told_apart,  // from the first
  worse            // than the first: the first criterion that tells them apart speaks against it
};

struct RankedCombination {
  std::string global_planner;
  std::string local_controller;
  std::uint32_t trials = 0;
  std::vector<double> means;          // by criterion; NaN: undefined
  std::vector<double> sibling_means;  // by sibling of the first criterion
  std::vector<AgainstFirst> against;  // by criterion; empty for the first
  Standing standing = Standing::first;
  std::optional<std::size_t> decided;  // the first criterion that tells it apart, for it or against it
};

// Two combinations (places in the ranking) whose order in the first criterion one of its siblings turns round.
struct OrderFlip {
  std::size_t sibling = 0;
  std::size_t before = 0;  // has the higher mean in the first criterion
  std::size_t behind = 0;  // has the higher mean in the sibling
};

// Over the trials of one scenario, number of robots and pedestrian model, or of several.
struct Answer {
  std::vector<CombinationLabels> cells;
  std::size_t tasks = 0;
  bool tasks_known = false;
  bool in_general = false;         // observations are tasks, else situations (a crowd seed on one of these tasks)
  std::uint32_t observations = 0;  // of the first
  std::vector<Criterion> criteria;
  std::vector<RankedCombination> ranking;  // the best first
  std::vector<Criterion> siblings;         // of the first criterion: shares that differ in whose fault contacts are
  std::vector<OrderFlip> flips;            // by sibling, then by the places of `before` and `behind`
  PairsApart pairs;                        // of combinations; none of fewer than ten tasks

  // Observations that would show a difference of 5 points in the first criterion, from the largest deviation among
  // combinations that are not told apart. None below ten observations, or where nothing deviates.
  std::optional<std::uint64_t> needed;
};

inline constexpr double wished_difference = 0.05;
inline constexpr std::uint32_t least_for_needed = 10;

// Over everything, then, if there are several, for each scenario, number of robots and pedestrian model. Leaves out
// answers about fewer than two combinations, and is empty if the metrics of the layout were not measured.
std::vector<Answer> answers(const SummaryLayout& layout, std::span<const MetricColumn> metrics,
                            std::span<const TrialRecord> trials);

}  // namespace dmrp::host
