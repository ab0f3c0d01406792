// SPDX-License-Identifier: MIT
// contest.hpp: who met whom: the trials of planners and controllers in the same situations, for paired comparisons.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/results/summary.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

// [trial][robot]: one metric's values for robots; none if undefined or not measured.
using RobotValues = std::vector<std::vector<std::optional<double>>>;
RobotValues robot_values(std::span<const TrialRecord> trials, const std::string& metric);

// What all contestants meet alike: a crowd and a task (the robots' starts and goals) under one seed.
struct Situation {
  std::size_t cell = 0;  // of Contest::cells
  std::uint64_t seed = 0;
  std::size_t task = 0;
};

// Contestants are told apart by `labels`, in which what they share is empty.
struct Contest {
  std::vector<CombinationLabels> cells;        // scenario, robots and pedestrian model
  std::vector<CombinationLabels> contestants;  // planner and controller, or planner alone
  std::vector<Situation> situations;
  std::vector<std::vector<std::vector<std::size_t>>> trials;  // [contestant][situation]: indices
  std::size_t tasks = 0;
  bool tasks_known = false;  // false: each scenario counts as one task
};

enum class Contestants { planners_and_controllers, planners };

// Of trials with robots that ran, and for which `included` holds. Only contestants that have trials in every cell.
Contest make_contest(std::span<const TrialRecord> trials, Contestants contestants,
                     const std::function<bool(const CombinationLabels&)>& included);

// From five tasks on, a claim about tasks in general is possible: then a task's situations count together, as one
// observation. With fewer, each situation is one, and claims are about these tasks alone.
inline constexpr std::size_t tasks_for_claims_in_general = 5;
bool in_general(const Contest& contest);

// One contestant's trials in a situation, and another's: b - a; none if undefined.
using Difference = std::function<std::optional<double>(std::span<const std::size_t>, std::span<const std::size_t>)>;

// The differences of two contestants (indices), one for each observation in which it is defined.
std::vector<double> paired_differences(const Contest& contest, std::size_t a, std::size_t b,
                                       const Difference& difference);

// The difference of the means of a value of trials.
Difference difference_of(std::function<std::optional<double>(std::size_t trial)> value);

}  // namespace dmrp::host
