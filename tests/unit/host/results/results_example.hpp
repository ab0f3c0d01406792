// SPDX-License-Identifier: MIT
// Trials as a run would have made them, for the tests of what it leaves behind.
#pragma once

#include <dmrp/descriptor.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "host/results/summary_layout.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::test {

// A folder of one test alone, removed with it.
class ScratchFolder {
 public:
  ScratchFolder() : path_(std::filesystem::temp_directory_path() / ("dmrp_results_" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directory(path_);
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline std::vector<host::MetricColumn> example_metrics() {
  return {{"done", "1", DMRP_DIRECTION_HIGHER, false, "share of robots"},
          {"time", "s", DMRP_DIRECTION_LOWER, false, "until the last one"},
          {"speed", "m/s", DMRP_DIRECTION_HIGHER, false, "mean"},
          {"speed_sd", "m/s", DMRP_DIRECTION_NONE, false, "over time"},
          {"touches", "1", DMRP_DIRECTION_LOWER, false, "contacts"},
          {"cpu", "ms", DMRP_DIRECTION_LOWER, true, "wall time"}};
}

inline host::MetricValue system_number(const std::string& metric, std::optional<double> value) {
  return {metric, DMRP_SUBJECT_SYSTEM, std::nullopt, std::nullopt, value};
}

// Two robots, on a task of the repetition's own; the second arrives only where the trial succeeded.
inline host::TrialRecord example_trial(std::uint64_t id, const std::string& planner, std::uint32_t repetition,
                                       std::optional<double> time, double speed) {
  host::TrialRecord trial;
  trial.id = id;
  trial.scenario = "mall";
  trial.robots = 2;
  trial.global_planner = planner;
  trial.local_controller = "DWA";
  trial.pedestrian_model = "crowd";
  trial.repetition = repetition;
  trial.seed = 1000 + repetition;
  trial.outcome = time ? host::trial_outcome::succeeded : host::trial_outcome::failed;
  trial.sim_time_s = time.value_or(180.0);
  trial.wall_time_s = 0.125;
  trial.task = "task " + std::to_string(repetition);
  trial.task_is_drawn = true;
  trial.values = {system_number("done", time ? 1.0 : 0.5),
                  {"done", DMRP_SUBJECT_ROBOT, 0, std::nullopt, 1.0},
                  {"done", DMRP_SUBJECT_ROBOT, 1, std::nullopt, time ? 1.0 : 0.0},
                  system_number("time", time),
                  system_number("speed", speed),
                  system_number("speed_sd", 0.17),
                  system_number("touches", 0.0)};
  return trial;
}

// Two trials of each of two planners, in one scenario.
inline std::vector<host::TrialRecord> two_planners() {
  return {example_trial(0, "CBS", 0, 40.0, 0.5), example_trial(1, "CBS", 1, 43.5, 0.52),
          example_trial(2, "A*", 0, 50.0, 0.6), example_trial(3, "A*", 1, 52.0, 0.61)};
}

inline host::SummaryLayout example_layout() {
  return host::parse_summary_layout(R"({
    "columns": [
      {"metric": "done", "header": "success", "decimals": 2},
      {"metric": "time", "decimals": 1},
      {"metric": "not measured", "header": "gone"},
      {"metric": "speed", "decimals": 2, "spread": "speed_sd"},
      {"metric": "cpu", "header": "plan", "decimals": 2}
    ],
    "arrived": "done",
    "contacts": "touches"
  })",
                                    "layout");
}

}  // namespace dmrp::test
