// SPDX-License-Identifier: MIT
// experiment.hpp: an experiment file, checked and complete. It determines every trial.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "core/scene/settings.hpp"
#include "host/plugins/library.hpp"
#include "host/plugins/plugin_info.hpp"
#include "host/plugins/plugin_use.hpp"
#include "host/scenario/scenario_variant.hpp"

namespace dmrp::host {

enum class RecordTraces { all, some, failed, none };  // some: of failed trials, and of each combination's first
inline constexpr std::array trace_choices = {"all", "some", "failed", "none"};

struct RunLimits {
  double planner_time_s = 60.0;  // wall time for one call of plan()
  double step_time_s = 1.0;      // for every other call
  double trial_wall_time_s = 600.0;
  std::int64_t memory_mb = 4096;  // of a guest; 0: none
  VisiblePaths visible{};         // to all plugins; absolute
};

// A key of [simulation], [recovery] or [robot] that has a list of values; the scenario variants have them.
struct SettingsSweep {
  std::string table;
  std::string key;                  // "tracking", "lidar.beams"
  std::vector<std::string> values;  // as TOML
};

// What planning cells cut off.
struct CutOff {
  std::vector<std::string> lines{};  // of each scenario with regions that its cells cut off
  double advised_cells_m = 0.0;      // with which none is; 0: no such cells are known
};

struct Experiment {
  std::filesystem::path file;  // of experiment.toml, absolute
  std::string text;            // its content
  std::string name;
  std::uint64_t seed = 1;
  std::uint32_t trials = 1;  // repetitions of each combination
  std::vector<LibraryUse> libraries;
  bool skips_unloadable = false;                  // libraries that cannot be loaded are left out
  std::vector<std::filesystem::path> unloadable;  // those that were
  std::vector<std::string> left_out;              // they, and the uses of plugins that may be in them; one line each
  std::vector<ScenarioVariant> scenarios;
  std::vector<PluginUse> global_planners;    // may be empty if no scenario has robots
  std::vector<PluginUse> local_controllers;  // may be empty if no scenario has robots
  std::vector<PluginUse> pedestrian_models;  // may be empty if no scenario has people
  std::vector<PluginUse> metrics;
  std::vector<PluginUse> fallback_planners;  // of [simulation] replan_fallback, with their defaults
  bool time_limit_set = false;               // by [simulation]; otherwise each scenario has its own limit
  core::SimulationSettings simulation;
  core::RobotSettings robot;                     // the default type
  std::vector<core::RobotSettings> robot_types;  // [robot_type.NAME] of this file
  std::vector<SettingsSweep> sweeps{};
  RecordTraces traces = RecordTraces::all;
  bool traces_set = false;   // by [record]; otherwise a run keeps what it chose when it began
  bool scans = false;        // traces record the lidar scans of every control tick
  bool annotations = false;  // traces record the annotations of plugins (dmrp.annotate/1)
  RunLimits limits;
  double smallest_effect = 0.05;      // that is of interest, in the first criterion of the answer: changes no result
  std::vector<std::string> warnings;  // one line each
  std::vector<std::function<CutOff()>> cut_off{};  // looks for them; workers need not
  std::string chosen_cells{};                      // grid_resolution_m = "auto" became, in a line
};

inline const core::SimulationSettings& simulation_of(const Experiment& experiment, const ScenarioVariant& variant) {
  return variant.simulation ? *variant.simulation : experiment.simulation;
}

// All lists of plugins in use.
inline std::array<const std::vector<PluginUse>*, 5> plugin_lists(const Experiment& experiment) {
  return {&experiment.global_planners, &experiment.local_controllers, &experiment.pedestrian_models,
          &experiment.metrics, &experiment.fallback_planners};
}

// One combination of scenario and plugins: indices into the experiment's lists.
struct Combination {
  std::uint32_t scenario = 0;
  std::int32_t global_planner = 0;     // -1: a scenario without robots
  std::int32_t local_controller = 0;   // -1: a scenario without robots
  std::int32_t pedestrian_model = -1;  // -1: a scenario without people
};

std::vector<Combination> combinations(const Experiment& experiment);

// The ids of its plugins whose memory is watched, as the kernel's limit on the data of a process does not fit them
// (DMRP_FLAG_RESIDENT_MEMORY) or holds for each process that they start (DMRP_FLAG_PROCESSES).
std::set<std::string> plugins_watched_for_memory(const Experiment& experiment);

// Trial k is repetition k / C of combination k % C for C combinations. It does not depend on the number of trials.
struct TrialId {
  std::uint64_t number = 0;
  std::uint32_t combination = 0;
  std::uint32_t repetition = 0;
};
TrialId trial_id(std::uint64_t number, std::size_t combination_count);

// The seed of all random streams of a world. It is equal for all combinations of a scenario in a repetition, for any
// number of robots, so that all meet the same crowd.
std::uint64_t world_seed(const Experiment& experiment, const std::string& scenario, std::uint32_t repetition);
// The seed of the drawn tasks of a scenario in a repetition: the world's, until the tasks begin again.
std::uint64_t task_seed(const Experiment& experiment, const std::string& scenario, const core::TaskWishes& wishes,
                        std::uint32_t repetition);
std::uint64_t trial_seed(const Experiment& experiment, std::uint64_t trial);  // the world_seed() of a trial

// Describes the plugins of a library: by a probe in a guest, or by loading the library.
using PluginSource = std::function<Probe(const std::filesystem::path& file, const VisiblePaths& visible)>;

// Reads and checks an experiment. Every mistake is an InputError in one line. `trials` > 0 replaces the file's number.
// `tried_by`: for a source that loads libraries into this process. If the experiment leaves out what cannot be loaded, it
// is called before the source, and fails in its place.
Experiment load_experiment(const std::filesystem::path& file, std::uint32_t trials, const PluginSource& source,
                           const PluginSource& tried_by = {});

// Reads an experiment that somebody else has loaded, and does not check its worlds again: that may draw the tasks of all
// repetitions. loaded_digest() tells whether both have read the same.
Experiment load_checked_experiment(const std::filesystem::path& file, std::uint32_t trials, const PluginSource& source);

// How effective_toml() writes the path of a library, of a scenario.toml or of a file that a parameter names.
using FileName = std::function<std::string(const std::filesystem::path&)>;
std::string absolute_name(const std::filesystem::path& file);

// The experiment as TOML with all defaults; reading it gives the same experiment.
std::string effective_toml(const Experiment& experiment, const FileName& name = &absolute_name);

}  // namespace dmrp::host
