// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "host/errors/input_error.hpp"
#include "host/experiment/check_worlds.hpp"
#include "host/experiment/experiment.hpp"
#include "host/experiment/experiment_keys.hpp"
#include "host/experiment/read_libraries.hpp"
#include "host/experiment/read_plugin_uses.hpp"
#include "host/experiment/read_scenario_uses.hpp"
#include "host/experiment/settings_tables.hpp"
#include "host/files/read_file.hpp"
#include "host/scenario/robot_tables.hpp"
#include "host/toml/nearest_name.hpp"
#include "host/toml/toml_document.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

const std::vector<std::string> header_keys = {"name", "seed", "trials", "plugins"};

// The lists of the experiment by plugin kind.
std::vector<std::pair<std::uint32_t, std::vector<PluginUse>*>> lists_by_kind(Experiment& experiment) {
  return {{DMRP_KIND_GLOBAL_PLANNER, &experiment.global_planners},
          {DMRP_KIND_LOCAL_CONTROLLER, &experiment.local_controllers},
          {DMRP_KIND_PEDESTRIAN_MODEL, &experiment.pedestrian_models},
          {DMRP_KIND_METRIC, &experiment.metrics}};
}

// `trials` > 0 replaces the file's number.
void read_header(const TomlDocument& document, std::uint32_t trials, const PluginSource& source,
                 Experiment& experiment) {
  const TomlTable root = document.root();
  const auto header = root.find_table("experiment");
  if (!header) {
    for (const TomlValue& entry : root.entries())
      if (const std::string meant = did_you_mean(entry.key(), {"experiment"}); !meant.empty())
        entry.fail_at_key(fmt::format("unknown key '{}'{}", entry.key(), meant));
    root.fail("the file needs [experiment]");
  }
  header->allow_only(header_keys);
  experiment.name = experiment.file.stem().string();
  if (const auto name = header->find("name")) {
    experiment.name = name->line();
    if (experiment.name.find('/') != std::string::npos || experiment.name.front() == '.')
      name->fail("'name' is the name of the run directory: it must not contain '/' or begin with '.'");
  }
  if (const auto seed = header->find("seed")) experiment.seed = static_cast<std::uint64_t>(seed->integer(0));
  if (const auto count = header->find("trials"))
    experiment.trials = static_cast<std::uint32_t>(count->integer(1, 1'000'000));
  if (trials > 0) experiment.trials = trials;
  read_libraries(document, header->need("plugins"), source, experiment);
}

// `uses`: the [[scenario]] of experiment.scenarios.
void check_complete(const TomlTable& root, const Experiment& experiment, const std::vector<ScenarioUse>& uses) {
  if (experiment.scenarios.empty()) root.fail("the experiment needs a [[scenario]]");
  const bool robots = std::any_of(experiment.scenarios.begin(), experiment.scenarios.end(),
                                  [](const ScenarioVariant& variant) { return robot_count(variant) > 0; });
  if (robots && experiment.global_planners.empty()) root.fail("the experiment needs a [[global_planner]]");
  if (robots && experiment.local_controllers.empty()) root.fail("the experiment needs a [[local_controller]]");
  if (!experiment.pedestrian_models.empty()) return;
  for (const ScenarioUse& use : uses)
    if (const auto count = core::walker_count(use.file.scenario); count > 0)
      use.use.fail(fmt::format("scenario '{}' has {} {}: the experiment needs a [[pedestrian_model]]",
                               use.file.scenario.name, count, count == 1 ? "person" : "people"));
}

// The controllers must be able to drive the robots of every scenario.
void check_drives(const TomlTable& root, const Experiment& experiment) {
  for (const ScenarioVariant& variant : experiment.scenarios)
    for (const std::string& name : types_in_use(variant))
      for (const PluginUse& controller : experiment.local_controllers) {
        const core::RobotSettings* type = variant.types.find(name);
        if (controller.info.kinematics & 1u << static_cast<std::uint32_t>(type->drive)) continue;
        const std::string whose =
            type->type.empty() ? "" : fmt::format(" (type '{}' in scenario '{}')", type->type, variant.label);
        for (const TomlTable& table : root.tables(kind_name(DMRP_KIND_LOCAL_CONTROLLER)))
          if (const TomlValue use = table.need("use"); use.text() == controller.info.id)
            use.fail(
                fmt::format("{} cannot drive robots with {}{}", controller.info.id, shown_drive(type->drive), whose));
      }
}

// Ordered execution needs plans that keep robots apart, cell by cell.
void check_ordered_execution(const TomlTable& root, const Experiment& experiment) {
  if (experiment.simulation.execution != core::Execution::ordered) return;
  const TomlValue execution = root.find_table("simulation")->need("execution");
  for (const PluginUse& planner : experiment.global_planners) {
    if (planner.info.has_flag(DMRP_FLAG_UNCOORDINATED))
      execution.fail(fmt::format("'execution' = 'ordered' needs plans without conflicts, which {} does not make",
                                 planner.info.id));
    if (planner.info.connectivity == DMRP_CONNECTIVITY_ANY)
      execution.fail(fmt::format("'execution' = 'ordered' needs plans from cell to cell, which {} does not make",
                                 planner.info.id));
  }
}

// The box keeps plugins from starting processes.
void check_processes(const TomlTable& root, Experiment& experiment) {
  if (experiment.limits.processes) return;
  for (const auto& [kind, uses] : lists_by_kind(experiment))
    for (const PluginUse& use : *uses)
      if (use.info.has_flag(DMRP_FLAG_PROCESSES))
        root.find_table("experiment")
            ->need("plugins")
            .fail(fmt::format("{} starts processes: '[limits] processes = true' allows that", use.info.id));
}

}  // namespace

std::vector<TomlKeys> experiment_keys() {
  std::vector<TomlKeys> tables = {{"[experiment]", header_keys}, {"[[scenario]]", scenario_use_keys}};
  Experiment unused;
  for (const auto& [kind, uses] : lists_by_kind(unused))
    tables.push_back({fmt::format("[[{}]]", kind_name(kind)), plugin_use_keys(kind)});
  for (TomlKeys& table : settings_keys()) tables.push_back(std::move(table));
  return tables;
}

Experiment load_experiment(const fs::path& file, std::uint32_t trials, const PluginSource& source) {
  if (std::error_code ignored; !fs::is_regular_file(file, ignored))
    throw InputError(file.string() + ": there is no such experiment file");
  Experiment experiment;
  experiment.file = fs::canonical(file);
  experiment.text = read_file(file, file.string());
  TomlDocument document(file.string(), experiment.text);
  const TomlTable root = document.root();
  document.know(experiment_keys());

  read_header(document, trials, source, experiment);
  std::vector<ScenarioUse> scenario_uses;
  std::vector<TomlTable::KeyReader> readers = settings_readers(root, experiment);
  readers.emplace_back("experiment", [](const TomlValue&) {});
  readers.emplace_back("scenario", [&](const TomlValue&) { scenario_uses = read_scenario_uses(root, experiment); });
  for (const auto& [kind, uses] : lists_by_kind(experiment))
    readers.emplace_back(kind_name(kind), [&experiment, &root, kind = kind, uses = uses](const TomlValue&) {
      read_plugin_uses(root, kind, experiment, *uses);
    });
  root.read(readers);
  experiment.robot_types = read_robot_types(root, experiment.robot);
  for (std::size_t i = 0; i < scenario_uses.size(); ++i) resolve_robot_types(scenario_uses[i], i, experiment);

  check_complete(root, experiment, scenario_uses);
  check_drives(root, experiment);
  check_ordered_execution(root, experiment);
  check_processes(root, experiment);
  if (experiment.metrics.empty()) use_every_metric(root.find_table("experiment")->need("plugins"), experiment);
  for (const ScenarioUse& use : scenario_uses) check_world(use.file, use.robot_types, experiment, use.random);
  return experiment;
}

}  // namespace dmrp::host
