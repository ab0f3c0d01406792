// SPDX-License-Identifier: MIT
// findings.hpp: the one table of a run's trials, [entry][task][situation]. Every number that compares trials or carries
// an interval is a function of it, and its observations are tasks.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/statistics/mean_of_tasks.hpp"
#include "core/statistics/resampling.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

// A combination: its trials differ in repetition and seed only.
struct CombinationLabels {
  std::string scenario;
  std::uint32_t robots = 0;
  std::string global_planner;
  std::string local_controller;
  std::string pedestrian_model;

  auto operator<=>(const CombinationLabels&) const = default;
};
CombinationLabels combination_of(const TrialRecord& trial);

// The task of each trial: the robots' starts and goals in a world. All crowds that meet it, and in one repetition all
// numbers of robots and all swept values of the world, are parts of it. Where no trial knows its task, a world is one.
// In a world with a single task each crowd that meets it is an observation of its own: what is found holds for this task.
struct Tasks {
  std::vector<std::size_t> of_trial;
  std::vector<std::uint32_t> world_of;  // of each task, from 0
  core::Resampling resampling;          // the one of all intervals; it is about these worlds
};
Tasks tasks_of(std::span<const TrialRecord> trials);

// What all entries meet alike: a crowd and a task under one seed.
struct Situation {
  CombinationLabels cell;  // labels that are the entry's are empty
  std::uint64_t seed = 0;
  std::size_t task = 0;
};

struct Findings {
  std::vector<CombinationLabels> entries;  // in order of first appearance; labels that are the cell's are empty
  std::vector<Situation> situations;
  std::vector<std::vector<std::vector<std::size_t>>> trials;  // [entry][situation]: indices
};

// How the labels of a trial fall into those of its entry and those of its cell; none: the trial is left out.
struct Split {
  CombinationLabels entry;
  CombinationLabels cell;
};
// Of trials with robots. By planner alone, what its controllers do counts together, and so do all pedestrian models.
std::optional<Split> by_planner_and_controller(const TrialRecord& trial);
std::optional<Split> by_planner(const TrialRecord& trial);

using SplitTrial = std::function<std::optional<Split>(std::size_t trial)>;
Findings make_findings(std::span<const TrialRecord> trials, const Tasks& tasks, const SplitTrial& split);

// The values of some entries in one situation, from the trials of each; none if one of them has none.
using JointValues = std::function<std::optional<std::vector<double>>(std::span<const std::span<const std::size_t>>)>;
using TrialValue = std::function<std::optional<double>(std::size_t trial)>;

// Each entry's mean over its trials.
JointValues means_of(TrialValue value);

// Values of entries in the situations that all of them met, averaged by task: the one pairing of trials.
struct JointFindings {
  std::vector<std::vector<double>> values;  // [member][task]; NaN: undefined, with all members alike
  std::uint32_t situations = 0;

  std::vector<double> differences(std::size_t a, std::size_t b) const;  // b - a, by task
};
JointFindings joint_findings(const Findings& findings, const Tasks& tasks, std::span<const std::size_t> members,
                             const JointValues& values);

// The mean of some trials' values by task; NaN: undefined.
std::vector<double> task_means(const Tasks& tasks, std::span<const std::size_t> trials, const TrialValue& value);

// A metric that counts failures is a share of robots.
inline core::Bounds bounds_of_values(bool share) {
  return share ? core::Bounds(core::share_bounds) : std::nullopt;
}

}  // namespace dmrp::host
