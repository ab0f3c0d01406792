// SPDX-License-Identifier: MIT
#include "host/experiment/adhoc_use.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string_view>

#include "core/scene/planning_grid.hpp"
#include "core/scene/planning_grids.hpp"
#include "core/scene/static_geometry.hpp"
#include "host/errors/input_error.hpp"
#include "host/experiment/check_regions.hpp"
#include "host/experiment/check_worlds.hpp"
#include "host/experiment/read_parameters.hpp"
#include "host/plugins/offered_extensions.hpp"
#include "host/scenario/find_scenario.hpp"
#include "host/scenario/read_scenario.hpp"
#include "host/scenario/robot_tables.hpp"
#include "host/toml/nearest_name.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

bool contains(const fs::path& file, const std::string& text) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  return bytes.view().find(text) != std::string_view::npos;
}

// The libraries to search for the planner: first the named ones, then those of the plugin path. Of these the ones in
// which its id is written come first: a probe costs more than the plan of a few robots.
std::vector<fs::path> candidate_libraries(const std::vector<std::string>& named, const std::string& id) {
  std::vector<fs::path> files;
  for (const std::string& name : named) {
    files.push_back(find_library(name, fs::current_path()));
    if (files.back().empty()) throw InputError(name + ": there is no such library");
  }
  std::vector<fs::path> of_path = libraries_of_plugin_path();
  std::stable_partition(of_path.begin(), of_path.end(), [&id](const fs::path& file) { return contains(file, id); });
  files.insert(files.end(), of_path.begin(), of_path.end());
  return files;
}

PluginUse find_planner(const std::string& id, const std::vector<std::string>& libraries, const PluginSource& source,
                       Experiment& experiment) {
  std::vector<std::string> known;
  for (const fs::path& file : candidate_libraries(libraries, id)) {
    Probe probe;
    try {
      probe = source(file, {});
    } catch (const std::runtime_error& error) {
      throw InputError(file.string() + ": " + error.what());
    }
    for (const PluginInfo& info : probe.plugins) {
      if (info.kind != DMRP_KIND_GLOBAL_PLANNER) continue;
      known.push_back(info.id);
      if (info.id != id) continue;
      if (const std::string missing = missing_extension(info); !missing.empty())
        throw InputError(fmt::format("--planner {}: {}", id, missing));
      if (!probe.init_error.empty()) throw InputError(file.string() + ": " + probe.init_error);
      for (const std::string& warning : probe.warnings) experiment.warnings.push_back(file.string() + ": " + warning);
      experiment.libraries = {{file.string(), file, probe.plugins}};
      PluginUse use;
      use.info = info;
      use.label = info.name;
      return use;
    }
  }
  throw InputError(fmt::format("--planner {}: no such planner{}", id, among(id, known)));
}

// Converts "key=value" to a line of TOML. A value that is neither a number, a boolean, an array nor quoted is a string.
std::string toml_line(const std::string& setting) {
  const auto equals = setting.find('=');
  if (equals == std::string::npos || equals == 0) throw InputError("--set " + setting + ": needs KEY=VALUE");
  std::string value = setting.substr(equals + 1);
  const bool plain = value == "true" || value == "false" || value.find_first_of("\"[") == 0 ||
                     (!value.empty() && value.find_first_not_of("0123456789+-.eE_") == std::string::npos);
  if (!plain) value = '"' + value + '"';
  return setting.substr(0, equals) + " = " + value + "\n";
}

}  // namespace

Experiment adhoc_experiment(const std::string& scenario, bool to_plan) {
  const fs::path file = find_scenario(scenario, fs::current_path());
  if (file.empty() && (scenario.find('/') != std::string::npos || scenario.ends_with(".toml") || is_map_file(scenario)))
    throw InputError(fmt::format("no scenario '{}': there is no such file", scenario));
  if (file.empty()) {
    throw InputError(fmt::format("no scenario '{}'{} (shipped: {})", scenario,
                                 did_you_mean(scenario, known_scenarios()), join_names(shipped_scenarios())));
  }
  Experiment experiment;
  const ScenarioFile read =
      read_scenario_file(file, scenario.ends_with(".toml") || is_map_file(scenario) ? scenario : file.string());
  experiment.scenarios.push_back({read.scenario, read.scenario.name, file, read.files});
  ScenarioVariant& variant = experiment.scenarios.back();
  variant.types = robot_types_of(read, experiment.robot, {});
  variant.census = read.census;
  experiment.warnings = read.warnings;
  if (to_plan) check_world(read, variant.types, experiment);
  experiment.cut_off.push_back([world = WorldUse{read, variant.types, {1}}, settings = experiment.simulation] {
    return find_cut_off({world}, settings);
  });
  return experiment;
}

void use_random_tasks(Experiment& experiment, std::uint32_t robots, std::uint64_t seed,
                      const core::TaskWishes& wishes) {
  core::Scenario& scenario = experiment.scenarios[0].scenario;
  const core::StaticGeometry geometry(scenario);
  const core::SimulationSettings& simulation = experiment.simulation;
  const core::PlanningGrids grids(geometry, core::RobotTypes(experiment.robot), simulation);
  core::DrawnTasks drawn = core::draw_tasks(grids, {robots, {}, scenario.inside, wishes}, seed);
  if (drawn.tasks.size() < robots)
    throw InputError(fmt::format("--agents {}: scenario '{}' has room for {} robots with random tasks: {}", robots,
                                 scenario.name, drawn.tasks.size(), lacking_rule(drawn)));
  scenario.robots = std::move(drawn.tasks);
  if (!drawn.as_wished)
    throw InputError(
        fmt::format("--conflicts-min, --conflicts-max: none of {} draws of tasks for {} robots in '{}' has as many",
                    core::task_attempts, robots, scenario.name));
}

void add_planner(Experiment& experiment, const std::string& id, const std::vector<std::string>& libraries,
                 const std::vector<std::string>& settings, const PluginSource& source) {
  PluginUse use = find_planner(id, libraries, source, experiment);
  std::vector<ParameterValue> defaults;
  for (const ParameterSpec& spec : use.info.parameters) defaults.push_back(spec.fallback);
  use.parameters = adhoc_parameters(settings, "", use.info, std::move(defaults));
  experiment.global_planners.push_back(std::move(use));
}

// Errors name the setting instead of a position in the text made of all settings.
std::vector<ParameterValue> adhoc_parameters(const std::vector<std::string>& settings,
                                             const std::string& parameter_file, const PluginInfo& info,
                                             std::vector<ParameterValue> values) {
  fs::path file;
  if (!parameter_file.empty()) {
    file = parameter_set(parameter_file, fs::current_path());
    if (file.empty())
      throw InputError(fmt::format("--params-file {}: there is no such file (shipped: {}){}", parameter_file,
                                   join_names(shipped_parameter_sets()),
                                   did_you_mean(parameter_file, shipped_parameter_sets())));
  }
  PluginInfo preset = info;
  for (std::size_t i = 0; i < values.size(); ++i) preset.parameters[i].fallback = std::move(values[i]);

  std::string text = "[params]\n";
  for (const std::string& setting : settings) text += toml_line(setting);
  try {
    const TomlDocument document("--set", text);
    return read_parameters(document.root(), preset, fs::current_path(), file).front().values;
  } catch (const InputError& error) {
    std::size_t line = 0;
    int read = 0;
    if (std::sscanf(error.what(), "--set:%zu:%*u: %n", &line, &read) != 1 || line < 2 || line > settings.size() + 1)
      throw;
    throw InputError("--set " + settings[line - 2] + ": " + (error.what() + read));
  }
}

}  // namespace dmrp::host
