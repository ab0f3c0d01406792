// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "core/execution/replanning.hpp"
#include "core/scene/settings.hpp"
#include "host/errors/input_error.hpp"
#include "host/errors/mistakes.hpp"
#include "host/experiment/check_regions.hpp"
#include "host/experiment/check_worlds.hpp"
#include "host/experiment/experiment.hpp"
#include "host/experiment/experiment_keys.hpp"
#include "host/experiment/read_libraries.hpp"
#include "host/experiment/read_plugin_uses.hpp"
#include "host/experiment/read_scenario_uses.hpp"
#include "host/experiment/settings_tables.hpp"
#include "host/files/read_file.hpp"
#include "host/process/box.hpp"
#include "host/scenario/robot_tables.hpp"
#include "host/toml/nearest_name.hpp"
#include "host/toml/setting.hpp"
#include "host/toml/swept_value.hpp"
#include "host/toml/toml_document.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

// One combination of the values of `sweep = { ... }` of [simulation], [recovery], [navigation] and [robot].
struct SettingsPoint {
  core::SimulationSettings simulation;
  core::RobotSettings robot;
  std::vector<SweptValue> swept{};
};

constexpr std::size_t max_points = 1000;
constexpr const char* swept_tables[] = {"simulation", "recovery", "navigation", "robot"};
constexpr std::int64_t max_trials = 1'000'000;
constexpr std::uint64_t max_trials_in_all = 10'000'000;
constexpr std::uint64_t most_traced_trials = 100;  // whose traces are kept by default
constexpr std::int64_t max_seed = std::numeric_limits<std::int64_t>::max();
const std::vector<TomlKey> header_keys = {{"name"},
                                          {"seed", range_text(0, max_seed)},
                                          {"trials", range_text(1, max_trials)},
                                          {"plugins"},
                                          {"skip_unloadable", boolean_text}};

Settings settings_of(SettingsPoint& point, const std::string& table) {
  if (table == "simulation") return simulation_settings(point.simulation);
  if (table == "navigation") return navigation_settings(point.simulation.navigation);
  return table == "recovery" ? recovery_settings(point.simulation.recovery) : robot_values(point.robot);
}

// "lidar" of "lidar.beams".
std::string first_part(const std::string& key) {
  return key.substr(0, key.find('.'));
}

// The lists of a sweep, by key; those of subtables, as of `lidar = { beams = [90, 360] }`, by "lidar.beams".
std::vector<std::pair<std::string, TomlValue>> lists_of(const TomlTable& sweep, const Settings& settings) {
  std::vector<std::string> known;
  for (const Setting& setting : settings) known.push_back(first_part(setting.key));
  sweep.allow_only(known);
  std::vector<std::pair<std::string, TomlValue>> lists;
  for (const TomlValue& entry : sweep.entries()) {
    std::vector<std::string> inner;
    for (const Setting& setting : settings)
      if (setting.key.starts_with(entry.key() + ".")) inner.push_back(setting.key.substr(entry.key().size() + 1));
    if (inner.empty()) {
      lists.emplace_back(entry.key(), entry);
      continue;
    }
    const TomlTable subtable = entry.table();
    subtable.allow_only(inner);
    for (const TomlValue& list : subtable.entries()) lists.emplace_back(entry.key() + "." + list.key(), list);
  }
  return lists;
}

// A value as readers see it: without a text's quotes and without the ".0" of a whole number.
std::string plain(const std::string& toml) {
  if (toml.size() >= 2 && toml.front() == '"') return toml.substr(1, toml.size() - 2);
  return toml.ends_with(".0") ? toml.substr(0, toml.size() - 2) : toml;
}

// Each point with each value of a list.
std::vector<SettingsPoint> multiply(const std::vector<SettingsPoint>& points, SettingsSweep& sweep,
                                    const TomlValue& list) {
  const std::vector<TomlValue> values = list.array();
  if (values.empty()) list.fail(fmt::format("'{}' sweeps over no values", list.key()));
  if (points.size() * values.size() > max_points)
    list.fail(fmt::format("the sweep has more than {} combinations", max_points));
  std::vector<SettingsPoint> out;
  for (const SettingsPoint& point : points) {
    sweep.values.clear();
    for (const TomlValue& value : values) {
      SettingsPoint& next = out.emplace_back(point);
      for (const Setting& setting : settings_of(next, sweep.table)) {
        if (setting.key != sweep.key) continue;
        setting.read(value);
        if (next.simulation.grid_resolution_m == cells_to_choose_m)
          value.fail("'grid_resolution_m' = \"auto\" cannot be swept");
        sweep.values.push_back(setting.write());
      }
      const std::string& text = sweep.values.back();
      if (std::count(sweep.values.begin(), sweep.values.end(), text) > 1)
        value.fail(fmt::format("'{} {}' twice in a sweep", sweep.key, plain(text)));
      next.swept.push_back({sweep.table, sweep.key, plain(text)});
    }
  }
  return out;
}

// All combinations, the last key changes fastest; the experiment's own settings alone if nothing is swept. Values of a
// sweep replace those of their table. Sets experiment.sweeps. Throws InputError.
std::vector<SettingsPoint> read_settings_sweep(const TomlTable& root, Experiment& experiment) {
  std::vector<SettingsPoint> points = {{experiment.simulation, experiment.robot}};
  for (const std::string table : swept_tables) {
    const auto settings = root.find_table(table);
    const auto sweep = settings ? settings->find_table("sweep") : std::nullopt;
    if (!sweep) continue;
    for (const auto& [key, list] : lists_of(*sweep, settings_of(points.front(), table))) {
      SettingsSweep& swept = experiment.sweeps.emplace_back(SettingsSweep{table, key, {}});
      points = multiply(points, swept, list);
      if (table == "simulation" && key == "time_limit_s") experiment.time_limit_set = true;
    }
    for (SettingsPoint& point : points)
      if (table == "simulation")
        check_simulation(*sweep, point.simulation);
      else if (table == "robot")
        check_robot(*sweep, point.robot);
  }
  return points;
}

// The lists of the experiment by plugin kind.
std::vector<std::pair<std::uint32_t, std::vector<PluginUse>*>> lists_by_kind(Experiment& experiment) {
  return {{DMRP_KIND_GLOBAL_PLANNER, &experiment.global_planners},
          {DMRP_KIND_LOCAL_CONTROLLER, &experiment.local_controllers},
          {DMRP_KIND_PEDESTRIAN_MODEL, &experiment.pedestrian_models},
          {DMRP_KIND_METRIC, &experiment.metrics}};
}

// `trials` > 0 replaces the file's number.
void read_header(const TomlDocument& document, std::uint32_t trials, const PluginSource& source,
                 const PluginSource& tried_by, Experiment& experiment) {
  const TomlTable header = document.root().need("experiment").table("[experiment]");
  const auto read_name = [&experiment](const TomlValue& name) {
    experiment.name = name.line();
    if (experiment.name.find('/') != std::string::npos || experiment.name.front() == '.')
      name.fail("'name' is the name of the run directory: it must not contain '/' or begin with '.'");
  };
  experiment.name = experiment.file.stem().string();
  Mistakes mistakes;
  mistakes.attempt([&] {  // before the libraries, wherever it stands
    if (const auto skips = header.find("skip_unloadable")) experiment.skips_unloadable = skips->boolean();
  });
  mistakes.attempt([&] {
    header.read(
        {{"name", read_name},
         {"seed", [&](const TomlValue& at) { experiment.seed = static_cast<std::uint64_t>(at.integer(0, max_seed)); }},
         {"trials",
          [&](const TomlValue& at) { experiment.trials = static_cast<std::uint32_t>(at.integer(1, max_trials)); }},
         {"plugins", [&](const TomlValue& at) { read_libraries(document, at, source, tried_by, experiment); }},
         {"skip_unloadable", [](const TomlValue&) {}}});
  });
  mistakes.attempt([&] { header.need("plugins"); });
  mistakes.end();
  if (trials > 0) experiment.trials = trials;
}

// `uses`: the [[scenario]] of experiment.scenarios.
void check_complete(const TomlTable& root, const Experiment& experiment, const std::vector<ScenarioUse>& uses) {
  const bool robots = std::any_of(experiment.scenarios.begin(), experiment.scenarios.end(),
                                  [](const ScenarioVariant& variant) { return robot_count(variant) > 0; });
  std::vector<std::string> needed = {"scenario"};
  if (robots) needed.insert(needed.end(), {kind_name(DMRP_KIND_GLOBAL_PLANNER), kind_name(DMRP_KIND_LOCAL_CONTROLLER)});
  Mistakes mistakes;
  for (const std::string& table : needed)
    if (!root.find(table))
      mistakes.attempt([&] { root.fail_missing(table, fmt::format("the experiment needs a [[{}]]", table)); });
  const bool has_model = root.find(kind_name(DMRP_KIND_PEDESTRIAN_MODEL)).has_value();
  for (const ScenarioUse& use : uses)
    if (const auto count = core::walker_count(use.file.scenario); count > 0 && !has_model)
      mistakes.attempt([&] {
        use.use.fail(fmt::format("scenario '{}' has {} {}: the experiment needs a [[pedestrian_model]]",
                                 use.file.scenario.name, count, count == 1 ? "person" : "people"));
      });
  mistakes.end();
}

void resolve_types(std::vector<ScenarioUse>& uses, Experiment& experiment) {
  Mistakes mistakes;
  for (std::size_t i = 0; i < uses.size(); ++i) mistakes.attempt([&] { resolve_robot_types(uses[i], i, experiment); });
  mistakes.end();
}

void check_number_of_trials(const TomlTable& root, const Experiment& experiment) {
  const std::uint64_t count = combinations(experiment).size();
  if (count * experiment.trials <= max_trials_in_all) return;
  const TomlTable header = *root.find_table("experiment");
  const std::string text = fmt::format("{} trials of {} combinations are {}, and an experiment has at most {}",
                                       experiment.trials, count, count * experiment.trials, max_trials_in_all);
  const auto trials = header.find("trials");  // unless the command line alone has it
  trials ? trials->fail(text) : header.fail(text);
}

// Unless the experiment says so, a long run does not keep every trace: one of eight robots has some MB.
void choose_traces(const TomlTable& root, Experiment& experiment) {
  const auto record = root.find_table("record");
  experiment.traces_set = record && record->find("traces");
  if (experiment.traces_set) return;
  if (combinations(experiment).size() * experiment.trials > most_traced_trials) experiment.traces = RecordTraces::some;
}

// Something must be left of what the experiment compares.
void check_left(const TomlTable& root, Experiment& experiment) {
  if (experiment.unloadable.empty()) return;
  Mistakes mistakes;
  for (const auto& entry : lists_by_kind(experiment))
    if (const std::string table = kind_name(entry.first); entry.second->empty() && root.find(table))
      mistakes.attempt([&] { root.fail(fmt::format("no [[{}]] is in a library that can be loaded", table)); });
  mistakes.end();
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
  const TomlTable simulation = *root.find_table("simulation");
  const auto sweep = simulation.find_table("sweep");
  const auto swept = sweep ? sweep->find("execution") : std::nullopt;
  const TomlValue execution = swept ? *swept : simulation.need("execution");
  for (const PluginUse& planner : experiment.global_planners) {
    if (planner.info.has_flag(DMRP_FLAG_UNCOORDINATED))
      execution.fail(fmt::format("'execution' = 'ordered' needs plans without conflicts, which {} does not make",
                                 planner.info.id));
    if (planner.info.connectivity == DMRP_CONNECTIVITY_ANY)
      execution.fail(fmt::format("'execution' = 'ordered' needs plans from cell to cell, which {} does not make",
                                 planner.info.id));
  }
}

// Where plans are for a window, every planner must know of it.
void check_windows(const TomlTable& root, const Experiment& experiment) {
  const auto has_window = [&](const ScenarioVariant& variant) {
    return simulation_of(experiment, variant).replan.window_steps > 0;
  };
  if (std::none_of(experiment.scenarios.begin(), experiment.scenarios.end(), has_window)) return;
  for (const PluginUse& planner : experiment.global_planners)
    if (!planner.info.has_flag(DMRP_FLAG_WINDOWED))
      for (const TomlTable& table : root.tables(kind_name(DMRP_KIND_GLOBAL_PLANNER)))
        if (const auto use = naming(table, planner))
          use->fail(fmt::format("{} cannot plan for a window, as 'replan_window_steps' asks (DMRP_FLAG_WINDOWED)",
                                planner.info.id));
}

// Files do not plan again.
void check_replanning(const TomlTable& root, Experiment& experiment) {
  const auto replans = [&](const ScenarioVariant& variant) {
    return core::can_replan(simulation_of(experiment, variant));
  };
  if (std::none_of(experiment.scenarios.begin(), experiment.scenarios.end(), replans)) return;
  for (const PluginUse& planner : experiment.global_planners)
    for (const TomlTable& table : root.tables(kind_name(DMRP_KIND_GLOBAL_PLANNER)))
      if (const auto file = naming(table, planner); file && planner.plans.is_given())
        experiment.warnings.push_back(fmt::format(
            "{}: plans from a file are never made anew: [simulation] and [recovery] ask for that, and robots "
            "with these plans do without",
            file->place()));
}

// Plugins start processes in a namespace of their own.
void check_processes(const TomlTable& root, Experiment& experiment) {
  if (box::kind() != "calls") return;
  for (const auto& [kind, uses] : lists_by_kind(experiment))
    for (const PluginUse& use : *uses)
      if (use.info.has_flag(DMRP_FLAG_PROCESSES))
        root.find_table("experiment")
            ->need("plugins")
            .fail(
                fmt::format("{} starts processes, which need namespaces ({}): see --no-box", use.info.id, view::gap()));
}

// Plugins see the files that their parameters name.
void show_parameters(Experiment& experiment) {
  for (const auto& [kind, uses] : lists_by_kind(experiment))
    for (const PluginUse& use : *uses)
      for (const ParameterValue& value : use.parameters)
        if (value.type == DMRP_PARAM_PATH && fs::path(value.text).is_absolute())
          experiment.libraries[use.library].visible.push_back(value.text);
}

TomlKeys root_keys() {
  TomlKeys root = {"",
                   {{"experiment"},
                    {"scenario"},
                    {"simulation"},
                    {"recovery"},
                    {"navigation"},
                    {"ending"},
                    {"robot"},
                    {"robot_type"},
                    {"record"},
                    {"benchmark"},
                    {"limits"}}};
  Experiment unused;
  for (const auto& [kind, uses] : lists_by_kind(unused)) root.keys.push_back({kind_name(kind)});
  return root;
}

void keep_first_of_equals(std::vector<std::string>& lines) {
  std::vector<std::string> kept;
  for (std::string& line : lines)
    if (std::find(kept.begin(), kept.end(), line) == kept.end()) kept.push_back(std::move(line));
  lines = std::move(kept);
}

std::vector<WorldUse> worlds_of(const std::vector<ScenarioUse>& uses) {
  std::vector<WorldUse> worlds;
  for (const ScenarioUse& use : uses) worlds.push_back({use.file, use.robot_types, use.random});
  return worlds;
}

// grid_resolution_m = "auto" takes the largest cells that suit all scenarios, or else 1 m.
void choose_cells(const TomlTable& root, std::vector<ScenarioUse>& uses, Experiment& experiment) {
  core::SimulationSettings& simulation = experiment.simulation;
  if (simulation.grid_resolution_m != cells_to_choose_m) return;
  simulation.grid_resolution_m = core::SimulationSettings().grid_resolution_m;
  resolve_types(uses, experiment);
  const double found_m = cells_for_all(worlds_of(uses), simulation);
  if (found_m > 0.0) simulation.grid_resolution_m = found_m;
  experiment.chosen_cells = fmt::format(
      "{}: grid_resolution_m = \"auto\" takes {} m{}", root.find_table("simulation")->need("grid_resolution_m").place(),
      simulation.grid_resolution_m, found_m > 0.0 ? "" : ": no cells suit all scenarios");
}

// Checks the scenarios with the experiment's settings, and with each combination of swept ones: then each variant
// becomes one for each combination. `has_scenarios`: all could be read.
void apply_settings(const TomlTable& root, std::vector<ScenarioUse>& uses, bool has_scenarios, bool worlds_are_checked,
                    Experiment& experiment) {
  choose_cells(root, uses, experiment);
  const core::SimulationSettings simulation = experiment.simulation;
  const core::RobotSettings robot = experiment.robot;
  const std::vector<SettingsPoint> points = read_settings_sweep(root, experiment);
  const std::size_t variants = experiment.scenarios.size();
  std::vector<ScenarioVariant> all(variants * points.size());
  std::map<std::size_t, std::shared_ptr<const core::FlowRoutes>> routes;  // by use
  Mistakes mistakes;
  for (std::size_t p = 0; p < points.size(); ++p) {
    experiment.simulation = points[p].simulation;
    experiment.robot = points[p].robot;
    mistakes.attempt([&] { check_ordered_execution(root, experiment); });
    const bool has_types = mistakes.attempt([&] {
      experiment.robot_types = read_robot_types(root, experiment.robot);
      resolve_types(uses, experiment);
    });
    if (!has_types) continue;
    if (has_scenarios) mistakes.attempt([&] { check_drives(root, experiment); });
    for (std::size_t u = 0; u < uses.size() && !worlds_are_checked; ++u)
      mistakes.attempt([&] {
        routes[u] = check_world(uses[u].file, uses[u].robot_types, experiment, uses[u].random, &root, routes[u]);
      });
    if (std::any_of(uses.begin(), uses.end(), [](const ScenarioUse& use) { return use.random.most > 0; }))
      experiment.cut_off.push_back(
          [worlds = worlds_of(uses), settings = experiment.simulation] { return find_cut_off(worlds, settings); });
    for (std::size_t i = 0; i < variants; ++i) {
      ScenarioVariant& variant = all[i * points.size() + p] = experiment.scenarios[i];
      variant.routes = routes[variant.entry];
      if (!experiment.sweeps.empty()) variant.simulation = points[p].simulation;
      variant.swept.insert(variant.swept.end(), points[p].swept.begin(), points[p].swept.end());
    }
  }
  mistakes.end();
  experiment.scenarios = std::move(all);
  experiment.simulation = simulation;
  experiment.robot = robot;
  experiment.robot_types = read_robot_types(root, robot);
  keep_first_of_equals(experiment.warnings);
}

Experiment load(const fs::path& file, std::uint32_t trials, const PluginSource& source, const PluginSource& tried_by,
                bool worlds_are_checked) {
  if (std::error_code ignored; !fs::is_regular_file(file, ignored))
    throw InputError(file.string() + ": there is no such experiment file");
  Experiment experiment;
  experiment.file = fs::canonical(file);
  experiment.text = read_file(file, file.string());
  TomlDocument document(file.string(), experiment.text);
  const TomlTable root = document.root();
  std::vector<TomlKeys> tables = experiment_keys();
  tables.push_back(root_keys());
  document.know(std::move(tables));

  if (const auto scenario = root.find("scenario"); scenario && scenario->is_table() && !root.find("experiment"))
    scenario->fail("this is a scenario, not an experiment: [[scenario]] use = \"FILE\" of an experiment names it");

  Mistakes mistakes;
  mistakes.attempt([&] { root.allow_only_keys(document.keys_of("")->keys); });
  mistakes.attempt([&] { read_run_settings(root, experiment); });  // libraries are loaded within the limits
  mistakes.attempt([&] { read_header(document, trials, source, tried_by, experiment); });
  const bool has_settings = mistakes.attempt([&] { read_world_settings(root, experiment); });
  std::vector<ScenarioUse> scenario_uses;
  const bool has_scenarios = mistakes.attempt([&] { read_scenario_uses(root, experiment, scenario_uses); });
  const bool all_libraries = has_all_libraries(root, experiment);
  for (const auto& entry : lists_by_kind(experiment))
    mistakes.attempt([&] { read_plugin_uses(root, entry.first, all_libraries, experiment, *entry.second); });
  mistakes.attempt([&] { check_complete(root, experiment, scenario_uses); });
  if (all_libraries) mistakes.attempt([&] { check_left(root, experiment); });

  // Checks of what belongs together, as far as it has been read.
  mistakes.attempt([&] { check_processes(root, experiment); });
  const bool has_worlds = has_settings && mistakes.attempt([&] {
    apply_settings(root, scenario_uses, has_scenarios, worlds_are_checked, experiment);
  });
  if (has_worlds) mistakes.attempt([&] { check_number_of_trials(root, experiment); });
  if (has_worlds) choose_traces(root, experiment);
  if (has_worlds) mistakes.attempt([&] { check_windows(root, experiment); });
  if (has_worlds) mistakes.attempt([&] { check_replanning(root, experiment); });
  if (has_worlds) mistakes.attempt([&] { read_fallback_planners(root, all_libraries, experiment); });
  if (experiment.metrics.empty() && all_libraries)
    mistakes.attempt([&] { use_every_metric(root.find_table("experiment")->need("plugins"), experiment); });
  mistakes.end();
  show_parameters(experiment);
  return experiment;
}

}  // namespace

std::vector<TomlKeys> experiment_keys() {
  std::vector<TomlKeys> tables = {{"[experiment]", header_keys}, {"[[scenario]]", scenario_use_keys()}};
  Experiment unused;
  for (const auto& [kind, uses] : lists_by_kind(unused))
    tables.push_back({fmt::format("[[{}]]", kind_name(kind)), plugin_use_keys(kind)});
  for (TomlKeys& table : settings_keys()) tables.push_back(std::move(table));
  return tables;
}

Experiment load_experiment(const fs::path& file, std::uint32_t trials, const PluginSource& source,
                           const PluginSource& tried_by) {
  return load(file, trials, source, tried_by, false);
}

Experiment load_checked_experiment(const fs::path& file, std::uint32_t trials, const PluginSource& source) {
  return load(file, trials, source, {}, true);
}

}  // namespace dmrp::host
