// SPDX-License-Identifier: MIT
#include "host/run/run_description.hpp"

#include <algorithm>
#include <chrono>
#include <set>

#include "host/experiment/identity.hpp"
#include "host/plugins/check_descriptor.hpp"
#include "host/plugins/elf_file.hpp"
#include "host/plugins/python_file.hpp"
#include "host/process/box.hpp"
#include "host/process/sanitized.hpp"
#include "host/program/commit.hpp"
#include "host/program/version.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

// The type of each robot; empty if all are of one type.
std::vector<std::string> types_of_robots(const ScenarioVariant& variant) {
  std::vector<std::string> types = core::drawn_types(variant.drawn_types, variant.drawn_robots);
  for (const core::RobotTask& task : variant.scenario.robots) types.push_back(task.type);
  for (std::string& type : types)
    if (type.empty()) type = "default";
  if (std::all_of(types.begin(), types.end(), [&](const std::string& type) { return type == types[0]; })) return {};
  return types;
}

PluginLimits limits_of(const Experiment& experiment) {
  const bool watched = !plugins_watched_for_memory(experiment).empty();
  const bool limited = experiment.limits.memory_mb > 0 && !sanitizer_is_loaded();
  std::set<std::string> with_processes;
  for (const auto* uses : plugin_lists(experiment))
    for (const PluginUse& use : *uses)
      if (use.info.has_flag(DMRP_FLAG_PROCESSES)) with_processes.insert(use.info.id);
  return {box::kind(),
          watched   ? "resident memory, watched"
          : limited ? "RLIMIT_DATA"
                    : "none",
          {with_processes.begin(), with_processes.end()}};
}

}  // namespace

std::vector<MetricColumn> columns_of(const Experiment& experiment) {
  std::vector<MetricColumn> columns;
  for (const PluginUse& use : experiment.metrics)
    for (const MetricValueSpec& value : use.info.values)
      columns.push_back({value.name, value.unit, value.direction, value.wall_clock, value.description,
                         !is_reserved_id(use.info.id) && !value.curve, value.minimum, value.maximum});
  return columns;
}

ExperimentFacts facts_of(const Experiment& experiment, const Shard& shard, std::uint64_t trials_planned) {
  ExperimentFacts facts{experiment.name, experiment.seed, experiment.trials, shard, trials_planned, {}};
  for (const ScenarioVariant& variant : experiment.scenarios) {
    const core::Scenario& scenario = variant.scenario;
    const double time_limit_s = experiment.time_limit_set
                                    ? static_cast<double>(simulation_of(experiment, variant).time_limit_ns) / 1e9
                                    : scenario.time_limit_s;
    const Grade& grade = variant.grade;
    facts.scenarios.push_back(
        {result_name(variant), scenario.title, scenario.description, robot_count(variant), core::person_count(scenario),
         time_limit_s, types_of_robots(variant), grade.series.empty() ? "" : with_swept(grade.series, variant.swept),
         grade.quantity, grade.unit, grade.harder_when_higher, grade.level, scenario.name, variant.drawn_robots > 0});
  }
  return facts;
}

Manifest manifest_of(const Experiment& experiment, const Shard& shard, std::uint64_t trials_planned,
                     const std::vector<std::string>& command_line) {
  Manifest manifest = new_manifest(version, command_line, std::chrono::system_clock::now());
  manifest.experiment = facts_of(experiment, shard, trials_planned);
  manifest.commit = commit;
  manifest.identity = identity_of(experiment);
  manifest.digest = digest_of(manifest.identity);
  manifest.protocol = protocol_of(manifest.identity);
  manifest.plugin_limits = limits_of(experiment);
  manifest.left_out = experiment.left_out;
  std::set<fs::path> objects;  // that libraries need
  for (const LibraryUse& library : experiment.libraries) {
    manifest.files.push_back(hashed_file("plugin library", library.file));
    manifest.files.back().code = code_digest(library.file);
    objects.insert(library.objects.begin(), library.objects.end());
  }
  if (std::any_of(experiment.libraries.begin(), experiment.libraries.end(),
                  [](const LibraryUse& library) { return is_python_file(library.file); }))
    manifest.files.push_back(hashed_file("python interpreter", python_interpreter()));
  for (const fs::path& object : objects) {
    manifest.files.push_back(hashed_file("plugin object", object));
    manifest.files.back().code = code_digest(object);
  }
  std::set<fs::path> scenarios;
  for (const ScenarioVariant& variant : experiment.scenarios) {
    scenarios.insert(variant.file);
    scenarios.insert(variant.files.begin(), variant.files.end());
  }
  for (const fs::path& file : scenarios) manifest.files.push_back(hashed_file("scenario", file));
  std::set<fs::path> parameters;
  for (const auto* uses : plugin_lists(experiment))
    for (const PluginUse& use : *uses) {
      if (!use.parameter_file.empty()) parameters.insert(use.parameter_file);
      for (const ParameterValue& value : use.parameters)
        if (value.type == DMRP_PARAM_PATH && !value.text.empty()) parameters.insert(value.text);
    }
  std::set<fs::path> plans;
  for (const PluginUse& planner : experiment.global_planners)
    if (planner.plans.is_given())
      for (const fs::path& file : planner.plans.all()) plans.insert(file);
  for (const fs::path& file : plans) manifest.files.push_back(hashed_file("plan", file));
  for (const fs::path& file : parameters) manifest.files.push_back(hashed_file("parameter", file));
  return manifest;
}

}  // namespace dmrp::host
