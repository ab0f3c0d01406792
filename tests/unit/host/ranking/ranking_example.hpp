// SPDX-License-Identifier: MIT
// Runs whose answer is known.
#pragma once

#include <dmrp/descriptor.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/results/summary_layout.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::test {

inline std::vector<host::MetricColumn> ranking_metrics() {
  return {{"safe", "1", DMRP_DIRECTION_HIGHER, false, ""},   {"untouched_done", "1", DMRP_DIRECTION_HIGHER, false, ""},
          {"done", "1", DMRP_DIRECTION_HIGHER, false, ""},   {"time", "s", DMRP_DIRECTION_LOWER, false, ""},
          {"length", "m", DMRP_DIRECTION_LOWER, false, ""},  {"planned", "m", DMRP_DIRECTION_LOWER, false, ""},
          {"plan_ms", "ms", DMRP_DIRECTION_LOWER, true, ""}, {"excused_done", "1", DMRP_DIRECTION_HIGHER, false, ""}};
}

inline host::SummaryLayout ranking_layout() {
  return host::parse_summary_layout(R"({"arrived": "done", "counts_failures": ["safe", "untouched_done", "done"],
      "of_plans": ["planned", "plan_ms"],
      "answer": {"shares": ["safe"], "siblings": ["untouched_done", "excused_done"],
      "people_progress": "progress", "people_speed": "desired",
      "time": "time", "way_length": "way"}})",
                                    "layout");
}

// What a robot does in a trial.
struct RobotResult {
  std::optional<double> time_s = 20.0;  // none: it does not arrive
  bool safe = true;
  double way_m = 10.0;
  bool touched = false;  // though not at its fault; an unsafe robot is touched, too
  bool excused = false;  // though unsafe
};

// A trial of two robots in the mall, on a task of the repetition's own.
inline host::TrialRecord ranking_trial(const std::string& planner, const std::string& controller,
                                       std::uint32_t repetition, const std::vector<RobotResult>& robots,
                                       double length_m = 30.0, double planned_m = 25.0) {
  host::TrialRecord trial;
  trial.scenario = "mall";
  trial.robots = static_cast<std::uint32_t>(robots.size());
  trial.global_planner = planner;
  trial.local_controller = controller;
  trial.pedestrian_model = "crowd";
  trial.repetition = repetition;
  trial.seed = 1000 + repetition;
  trial.task = "task " + std::to_string(repetition);
  trial.task_is_drawn = true;
  double done = 0.0;
  double safe = 0.0;
  double untouched = 0.0;
  double excused = 0.0;
  for (std::uint64_t i = 0; i < robots.size(); ++i) {
    const RobotResult& robot = robots[i];
    const bool arrived = robot.time_s.has_value();
    done += arrived ? 1.0 : 0.0;
    safe += arrived && robot.safe ? 1.0 : 0.0;
    untouched += arrived && robot.safe && !robot.touched ? 1.0 : 0.0;
    excused += arrived && (robot.safe || robot.excused) ? 1.0 : 0.0;
    trial.values.push_back({"done", DMRP_SUBJECT_ROBOT, i, std::nullopt, arrived ? 1.0 : 0.0});
    trial.values.push_back({"safe", DMRP_SUBJECT_ROBOT, i, std::nullopt, arrived && robot.safe ? 1.0 : 0.0});
    trial.values.push_back({"time", DMRP_SUBJECT_ROBOT, i, std::nullopt, robot.time_s});
    trial.values.push_back({"way", DMRP_SUBJECT_ROBOT, i, std::nullopt, robot.way_m});
    if (!arrived) {
      host::MetricEvent event;
      event.metric = "done";
      event.text = "robot " + std::to_string(i) + " failed: deadlock";
      event.robots = {static_cast<std::uint32_t>(i)};
      trial.events.push_back(event);
    }
  }
  const auto count = static_cast<double>(robots.size());
  trial.outcome = done == count ? host::trial_outcome::succeeded : host::trial_outcome::failed;
  const auto system = [&](const std::string& metric, std::optional<double> value) {
    trial.values.push_back({metric, DMRP_SUBJECT_SYSTEM, std::nullopt, std::nullopt, value});
  };
  system("safe", safe / count);
  system("untouched_done", untouched / count);
  system("excused_done", excused / count);
  system("done", done / count);
  system("time", done == count ? robots.front().time_s : std::nullopt);
  system("length", length_m);
  system("planned", planned_m);
  system("plan_ms", planned_m);
  return trial;
}

using MakeRobots = std::function<std::vector<RobotResult>(std::uint32_t repetition)>;

inline void add_trials(std::vector<host::TrialRecord>& trials, const std::string& controller, std::uint32_t repetitions,
                       const MakeRobots& robots) {
  for (std::uint32_t i = 0; i < repetitions; ++i) {
    trials.push_back(ranking_trial("P", controller, i, robots(i)));
    trials.back().id = trials.size() - 1;
  }
}

}  // namespace dmrp::test
