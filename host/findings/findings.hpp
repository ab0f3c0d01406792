// SPDX-License-Identifier: MIT
// findings.hpp: the one table of a run's trials, [entry][task][situation]. Every number that compares trials or carries
// an interval is a function of it.
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

// What some trials have met: tasks, which are robots' starts and goals in a world, and crowds, which are seeds in a world.
struct Met {
  std::uint32_t tasks = 0;
  std::uint32_t drawn = 0;  // of the tasks, at random
  std::uint32_t crowds = 0;
  std::uint32_t meetings = 0;  // of a task and a crowd
  bool has_people = true;      // in the run

  bool operator==(const Met&) const = default;
};

// "one task, 20 crowds", "3 tasks x 20 crowds", "40 drawn tasks"
std::string met_words(const Met& met);
// What an observation is: "task" where tasks are drawn, "crowd" where they are listed ("seed" without people).
std::string observation_name(const Met& met);

// What an observation is. `trial`: what was drawn at random. `plan`: a task, as of values that depend on the plan alone: one
// plan that twenty crowds meet is one observation.
enum class Unit { trial, plan };

// The observation of each trial: its task where tasks are drawn, else its crowd, and what is found holds for the listed
// tasks. In one repetition all numbers of robots and all swept values of the world are parts of one observation.
class Observations {
 public:
  std::vector<std::size_t> of_trial;
  std::vector<std::uint32_t> world_of;                            // of each observation, from 0
  core::Resampling resampling{{}, core::Scope::these_worlds, 0};  // the one of all intervals

  Met met_by(std::span<const std::size_t> trials) const;

 private:
  friend Observations observations_of(std::span<const TrialRecord> trials, Unit unit);
  std::vector<std::size_t> task_of_;   // by trial
  std::vector<std::size_t> crowd_of_;  // likewise
  std::vector<bool> is_drawn_;         // likewise
  bool has_people_ = false;
};
Observations observations_of(std::span<const TrialRecord> trials, Unit unit = Unit::trial);

// What all entries meet alike: a crowd and a task under one seed.
struct Situation {
  CombinationLabels cell;  // labels that are the entry's are empty
  std::uint64_t seed = 0;
  std::size_t observation = 0;
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
Findings make_findings(std::span<const TrialRecord> trials, const Observations& observations, const SplitTrial& split);

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
JointFindings joint_findings(const Findings& findings, const Observations& observations,
                             std::span<const std::size_t> members, const JointValues& values);

// The mean of some trials' values by task; NaN: undefined.
std::vector<double> observation_means(const Observations& observations, std::span<const std::size_t> trials,
                                      const TrialValue& value);

// A metric that counts failures is a share of robots.
inline core::Bounds bounds_of_values(bool share) {
  return share ? core::Bounds(core::share_bounds) : std::nullopt;
}

}  // namespace dmrp::host
