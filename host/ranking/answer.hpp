// SPDX-License-Identifier: MIT
// answer.hpp: which combination of planner and controller is the best: an order, and the set that has the best in it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/statistics/level_effects.hpp"
#include "host/ranking/measures.hpp"
#include "host/ranking/paired_difference.hpp"
#include "host/results/summary_layout.hpp"
#include "host/results/system_values.hpp"

namespace dmrp::host {

enum class Standing {
  first,  // of those that may be the best, by the means
  may_be_best,
  worse  // not among those of which one is the best, with 95 % confidence
};

struct RankedCombination {
  std::string global_planner;
  std::string local_controller;
  std::uint32_t trials = 0;
  std::vector<double> means;              // by criterion; NaN: undefined
  std::vector<core::Interval> intervals;  // of the means
  std::vector<double> sibling_means;      // by sibling of Answer::safe
  std::vector<std::string> same_as{};     // planners whose trials with this controller are the same, to the bit
  std::vector<PairedDifference> against;  // by criterion: its values minus the first's; empty for the first
  Standing standing = Standing::first;
  std::optional<std::size_t> decided;  // of a worse one: the criterion that tells
  bool best_in_general = true;         // may be so over worlds: Answer::in_general
  bool pareto = true;                  // no other is as good in all criteria, and better in one
};

// Two combinations (places in the ranking) whose order in Answer::safe one of its siblings turns round.
struct OrderFlip {
  std::size_t sibling = 0;
  std::size_t before = 0;  // has the higher mean in Answer::safe
  std::size_t behind = 0;  // has the higher mean in the sibling
};

// A factor of a product of planners and controllers, over all of the other.
struct FactorEffects {
  const char* factor;  // "controller"
  const char* other;   // "planner"
  std::size_t others = 0;
  std::vector<std::string> levels;
  std::vector<core::LevelEffect> effects;  // by level, in the first criterion
};

// Over the trials of one scenario, number of robots and pedestrian model, or of several.
struct Answer {
  std::vector<CombinationLabels> cells;
  Met met{};                 // what the trials have met
  std::uint32_t n = 0;       // observations
  std::uint32_t worlds = 0;  // their blocks
  bool in_general = false;   // worlds are observations, too: there are enough of them
  std::vector<Criterion> criteria;
  std::vector<RankedCombination> ranking;  // those that may be the best first, then by the criteria
  std::size_t safe = 0;             // the criterion of robots that arrived without a fault, where it has siblings
  std::vector<Criterion> siblings;  // of it: shares that differ in whose fault contacts are
  std::vector<OrderFlip> flips;     // by sibling, then by the places of `before` and `behind`

  std::vector<FactorEffects> factors;  // of planners and of controllers, if each planner has each controller

  // With several pedestrian models, by model: names of those that may be the best (combination_name()).
  struct WithPeople {
    std::string pedestrian_model;
    std::vector<std::string> best;
  };
  std::vector<WithPeople> with_people;

  // Of paired differences in the first criterion, the largest among those that may be the best; 0 below ten tasks.
  double deviation = 0.0;
};

inline constexpr std::uint32_t least_for_deviation = 10;

// "CBS + DWA"
std::string combination_name(const RankedCombination& one);

// Observations that would show this difference in the first criterion with a probability of 80 %; none where nothing
// deviates.
std::optional<std::uint64_t> observations_needed(const Answer& answer, double difference);

// Mean differences that decide nothing: then the next criterion may tell.
inline constexpr double tolerated_share = 0.05;
inline constexpr double tolerated_delay_s = 0.5;
inline constexpr double tolerated_time_share = 0.05;  // of the mean time of all

// Over everything, then, if there are several, for each scenario, number of robots and pedestrian model. Leaves out
// answers about fewer than two combinations, and is empty if the metrics of the layout were not measured.
std::vector<Answer> answers(const SummaryLayout& layout, std::span<const MetricColumn> metrics,
                            std::span<const TrialRecord> trials);

}  // namespace dmrp::host
