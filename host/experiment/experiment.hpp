// SPDX-License-Identifier: MIT
// experiment.hpp: an experiment file, checked and complete. Everything that a trial needs to know follows from it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/scenario.hpp"
#include "core/settings.hpp"
#include "host/plugins/library.hpp"
#include "host/plugins/plugin_info.hpp"

namespace dmrp::host {

// A library that the experiment names.
struct LibraryUse {
  std::string written;         // as in the file
  std::filesystem::path file;  // absolute
  std::vector<PluginInfo> plugins;
};

// A plugin as the experiment uses it.
struct PluginUse {
  std::uint32_t library = 0;  // index into Experiment::libraries
  PluginInfo info;
  std::string label;                       // for people; unique among the uses of its kind
  std::vector<ParameterValue> parameters;  // complete, in the declared order; paths absolute
  std::filesystem::path parameter_file{};  // that some of them come from; absolute, empty if there is none
};

// A scenario with a number of robots: the first of those that it lists, or as many drawn for each trial.
struct ScenarioVariant {
  core::Scenario scenario;     // holds exactly the listed robots that take part
  std::string label;           // the scenario's name; "mall/2" where it runs with another number than it lists
  std::filesystem::path file;  // of scenario.toml
  std::vector<std::filesystem::path> files{};  // that it names: a map, tasks
  std::uint32_t drawn_robots = 0;              // none of the listed ones takes part then
  std::uint32_t most_drawn = 0;  // by the variants of one [[scenario]]: people keep clear of all their starts
  std::uint32_t entry = 0;       // the [[scenario]] that it comes from
  bool all_drawn = false;        // tasks = "drawn"
};

inline std::uint32_t robot_count(const ScenarioVariant& variant) {
  return variant.drawn_robots + static_cast<std::uint32_t>(variant.scenario.robots.size());
}

enum class RecordTraces { all, failed, none };

struct RunLimits {
  double planner_time_s = 60.0;  // wall time for one call of plan()
  double step_time_s = 1.0;      // for every other call
  double trial_wall_time_s = 600.0;
  std::int64_t memory_mb = 4096;  // of a worker; 0: none
};

struct Experiment {
  std::filesystem::path file;  // of experiment.toml, absolute
  std::string text;            // its content
  std::string name;
  std::uint64_t seed = 1;
  std::uint32_t trials = 1;  // repetitions a combination
  std::vector<LibraryUse> libraries;
  std::vector<ScenarioVariant> scenarios;
  std::vector<PluginUse> global_planners;    // these two: may be empty when no scenario has robots
  std::vector<PluginUse> local_controllers;  //
  std::vector<PluginUse> pedestrian_models;  // empty when no scenario has people and none is named
  std::vector<PluginUse> metrics;
  bool time_limit_set = false;  // by [simulation]; else every scenario has its own
  core::SimulationSettings simulation;
  core::RobotSettings robot;
  RecordTraces traces = RecordTraces::all;
  bool scans = false;        // traces keep what the robots' lidars see at every control tick
  bool annotations = false;  // traces keep what plugins say through dmrp.annotate/1
  RunLimits limits;
  std::vector<std::string> warnings;  // one line each
};

// What is tried out against each other: indices into the experiment's lists.
struct Combination {
  std::uint32_t scenario = 0;
  std::int32_t global_planner = 0;     // -1: a scenario without robots
  std::int32_t local_controller = 0;   // likewise
  std::int32_t pedestrian_model = -1;  // -1: a scenario without people
};

std::vector<Combination> combinations(const Experiment& experiment);

// Trial k is repetition k / C of combination k % C for C combinations: the same trial whatever number is asked for.
struct TrialId {
  std::uint64_t number = 0;
  std::uint32_t combination = 0;
  std::uint32_t repetition = 0;
};
TrialId trial_id(std::uint64_t number, std::size_t combination_count);

// The seed that all streams of a world come from: equal for every combination of a scenario and repetition, whatever the
// number of robots, so that all meet the same crowd.
std::uint64_t world_seed(const Experiment& experiment, const std::string& scenario, std::uint32_t repetition);

// What a library's plugins are found out by: a probe in a child process, or the library itself.
using PluginSource = std::function<Probe(const std::filesystem::path&)>;

// Reads and checks an experiment: every mistake is an InputError in one line. `trials` > 0 replaces the file's number.
Experiment load_experiment(const std::filesystem::path& file, std::uint32_t trials,
                           const PluginSource& source = &probe_library);

// The scenario.toml behind a name (shipped, or in DMRP_SCENARIO_PATH) or a path relative to `base`; empty if there is
// none.
std::filesystem::path find_scenario(const std::string& name_or_path, const std::filesystem::path& base);
std::vector<std::string> shipped_scenarios();
std::vector<std::string> known_scenarios();  // these and those of DMRP_SCENARIO_PATH

// The experiment with every default written out; reads back as the same experiment.
std::string effective_toml(const Experiment& experiment);

}  // namespace dmrp::host
