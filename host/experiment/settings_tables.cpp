// SPDX-License-Identifier: MIT
#include "host/experiment/settings_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <numbers>
#include <span>
#include <utility>

#include "host/errors/mistakes.hpp"
#include "host/process/view.hpp"
#include "host/scenario/robot_tables.hpp"

namespace dmrp::host {

namespace {

// At the first of these keys that the table has, or at the table.
[[noreturn]] void fail_at_one(const TomlTable& table, std::initializer_list<const char*> keys,
                              const std::string& text) {
  for (const char* key : keys)
    if (const auto value = table.find(key)) value->fail(text);
  table.fail(text);
}

void check_control_period(const TomlTable& table, const core::SimulationSettings& simulation) {
  if (simulation.control_period_ns % simulation.step_ns == 0) return;
  fail_at_one(table, {"control_period_s", "step_s"},
              fmt::format("'control_period_s' must be a multiple of 'step_s': {} s is none of {} s",
                          static_cast<double>(simulation.control_period_ns) / 1e9,
                          static_cast<double>(simulation.step_ns) / 1e9));
}

// Robots change to a new plan at control ticks.
void check_replanning(const TomlTable& table, const core::SimulationSettings& simulation) {
  for (const auto& [key, ns] : {std::pair("replan_period_s", simulation.replan.period_ns),
                                std::pair("replan_stall_s", simulation.replan.stall_ns)})
    if (ns > 0 && ns < simulation.control_period_ns)
      fail_at_one(table, {key, "control_period_s"},
                  fmt::format("'{}' must be 0 (never) or at least 'control_period_s', {} s", key,
                              static_cast<double>(simulation.control_period_ns) / 1e9));
}

// A robot reaches the end of its window, and stands there until the next plan.
void check_window(const TomlTable& table, const core::ReplanSettings& replan) {
  if (replan.period_ns > 0 && replan.period_steps > 0)
    fail_at_one(table, {"replan_period_steps", "replan_period_s"},
                "'replan_period_steps' and 'replan_period_s' are one period: give one of them");
  if (replan.window_steps == 0 || (replan.period_steps > 0 && replan.period_steps <= replan.window_steps)) return;
  fail_at_one(table, {"replan_window_steps", "replan_period_steps"},
              fmt::format("'replan_window_steps' = {} needs 'replan_period_steps' from 1 to as many, not {}",
                          replan.window_steps, replan.period_steps));
}

Setting plugin_id(const std::string& key, std::string& to) {
  return {key, [&to](const TomlValue& value) { to = value.text(); }, [&to] { return toml_text(to); },
          "the id of a plugin"};
}

// "auto": to_choose, until load_experiment() has chosen.
Setting cell_size(const std::string& key, double& to) {
  Setting setting = number(key, to, 0.05, 100.0);
  const auto read_number = setting.read;
  setting.read = [&to, read_number](const TomlValue& value) {
    if (!value.is_text()) return read_number(value);
    if (value.text() != "auto") value.fail(fmt::format("'{}' must be a number or \"auto\"", value.key()));
    to = cells_to_choose_m;
  };
  setting.range += ", or \"auto\"";
  return setting;
}

}  // namespace

void check_simulation(const TomlTable& table, const core::SimulationSettings& simulation) {
  check_control_period(table, simulation);
  check_replanning(table, simulation);
  check_window(table, simulation.replan);
}

Settings simulation_settings(core::SimulationSettings& to) {
  return {seconds("step_s", to.step_ns),
          seconds("control_period_s", to.control_period_ns),
          seconds("time_limit_s", to.time_limit_ns),
          cell_size("grid_resolution_m", to.grid_resolution_m),
          seconds("step_duration_s", to.step_duration_ns),
          latency("control_latency_s", to.control_latency_ns),
          latency("planning_latency_s", to.planning_latency_ns),
          number("planning_margin_m", to.planning_margin_m, 0.0, 10.0),
          choice("planning_body", to.planning_body, {"footprint", "point"}),
          choice("tracking", to.tracking, {"none", "visible", "all"}),
          positive("tracking_range_m", to.tracking_range_m, max_length_m),
          number("tracking_velocity_noise_sd", to.tracking_velocity_noise_sd, 0.0, 10.0),
          positive("goal_tolerance_m", to.goal.tolerance_m, max_length_m),
          positive("goal_tolerance_rad", to.goal.tolerance_rad, std::numbers::pi),
          positive("goal_tolerance_speed", to.goal.tolerance_speed, 100.0),
          number("goal_settle_s", to.goal.settle_s, 0.0, max_time_s),
          choice("dispatch", to.dispatch, {"full_path", "waypoint", "lockstep"}),
          choice("execution", to.execution, {"free", "ordered"}),
          seconds_or_never("replan_period_s", to.replan.period_ns),
          number("replan_stray_m", to.replan.stray_m, 0.0, max_length_m),
          seconds_or_never("replan_stall_s", to.replan.stall_ns),
          seconds_or_never("replan_min_interval_s", to.replan.min_interval_ns),
          integer("replan_period_steps", to.replan.period_steps, 0, 100'000),
          integer("replan_window_steps", to.replan.window_steps, 0, 100'000),
          plugin_id("replan_fallback", to.replan.fallback)};
}

namespace {

const std::vector<std::string> recovery_steps = {"clear_costmap", "spin", "wait", "backup", "replan"};

Setting steps_setting(std::vector<core::RecoveryStep>& to) {
  const auto read = [&to](const TomlValue& value) {
    std::vector<core::RecoveryStep> steps;
    for (const TomlValue& step : value.array()) {
      const auto found = std::find(recovery_steps.begin(), recovery_steps.end(), step.choice(recovery_steps));
      steps.push_back(static_cast<core::RecoveryStep>(found - recovery_steps.begin() + DMRP_RECOVERY_CLEAR_COSTMAP));
    }
    if (steps.empty()) value.fail("'steps' needs one step at least (no recoveries: retries = 0)");
    to = std::move(steps);
  };
  const auto write = [&to] {
    std::vector<std::string> names;
    for (const core::RecoveryStep step : to)
      names.push_back(recovery_steps[static_cast<std::size_t>(step) - DMRP_RECOVERY_CLEAR_COSTMAP]);
    return toml_text(names);
  };
  return {"steps", read, write, "each " + choices_text(recovery_steps)};
}

}  // namespace

Settings recovery_settings(core::RecoverySettings& to) {
  return {integer("retries", to.retries, 0, 1000),
          steps_setting(to.steps),
          positive("required_movement_radius_m", to.required_movement_radius_m, max_length_m),
          seconds("movement_time_allowance_s", to.movement_time_allowance_ns),
          latency("failure_tolerance_s", to.failure_tolerance_ns),
          positive("spin_dist_rad", to.spin_dist_rad, 10.0),
          seconds("wait_duration_s", to.wait_duration_ns),
          positive("backup_dist_m", to.backup_dist_m, max_length_m),
          positive("backup_speed", to.backup_speed, 100.0)};
}

Settings navigation_settings(core::NavigationSettings& to) {
  return {choice("route", to.route, {"path", "around"}), boolean("monitor", to.monitor),
          boolean("compensate_latency", to.compensate_latency)};
}

namespace {

void read_simulation(const TomlTable& table, Experiment& experiment) {
  core::SimulationSettings& simulation = experiment.simulation;
  std::vector<TomlTable::KeyReader> readers = readers_of(simulation_settings(simulation));
  readers.emplace_back("sweep", [](const TomlValue& sweep) { sweep.table(); });  // read_settings_sweep() reads it
  table.read(readers);
  experiment.time_limit_set = table.find("time_limit_s").has_value();
  check_simulation(table, simulation);
}

// A table whose keys may be swept.
void read_swept(const TomlTable& table, const Settings& settings) {
  std::vector<TomlTable::KeyReader> readers = readers_of(settings);
  readers.emplace_back("sweep", [](const TomlValue& sweep) { sweep.table(); });
  table.read(readers);
}

Settings ending_settings(core::SimulationSettings& to) {
  return {choice("oscillation", to.oscillation_fails, {"metric", "fails"})};
}

Settings record_settings(Experiment& experiment) {
  return {choice("traces", experiment.traces, {trace_choices.begin(), trace_choices.end()}),
          boolean("scans", experiment.scans), boolean("annotations", experiment.annotations)};
}

Settings benchmark_settings(Experiment& experiment) {
  return {positive("smallest_effect", experiment.smallest_effect, 1.0)};
}

// Relative to the folder of the experiment.
Setting visible_setting(VisiblePaths& to, const std::filesystem::path& base) {
  const auto read = [&to, base](const TomlValue& value) {
    to.clear();
    for (const TomlValue& written : value.array()) {
      const std::filesystem::path path = (base / written.text()).lexically_normal();
      if (std::error_code ignored; !std::filesystem::exists(path, ignored))
        written.fail(fmt::format("'visible' names no file or folder: '{}'", written.text()));
      if (path == "/") written.fail("'visible' must not be '/' (plugins that see everything: --no-box)");
      if (path == view::scratch)
        written.fail(fmt::format("'visible' must not be '{}': plugins have their own", path.string()));
      to.push_back(path);
    }
  };
  return {"visible", read, [&to] { return toml_text(std::vector<std::string>(to.begin(), to.end())); }, "paths"};
}

Settings limits_settings(RunLimits& to, const std::filesystem::path& base = {}) {
  return {number("planner_time_s", to.planner_time_s, min_time_s, max_time_s),
          number("step_time_s", to.step_time_s, min_time_s, max_time_s),
          number("trial_wall_time_s", to.trial_wall_time_s, min_time_s, max_time_s),
          integer("memory_mb", to.memory_mb, 0, 1 << 30), visible_setting(to.visible, base)};
}

// A value that can be simulated, but is rarely meant.
struct Implausible {
  const char* key;
  double above;
  const char* unit;
  const char* hint;
};

constexpr std::array implausible_simulation = {
    Implausible{"control_period_s", 2.0, "s",
                "a robot drives on blindly until its next command; usual are 0.05 to 0.2 s"},
    Implausible{"step_s", 0.2, "s", "robots and people move so far between two looks at contacts; usual is 0.02 s"},
    Implausible{"grid_resolution_m", 5.0, "m", "robots plan on cells of this size; usual are 0.5 to 1 m"}};
constexpr std::array implausible_robot = {
    Implausible{"v_max", 10.0, "m/s", "usual are 0.5 to 2 m/s"},
    Implausible{"omega_max", 4.0 * std::numbers::pi, "rad/s", "are these degrees? 57.3 degrees are 1 rad"},
    Implausible{"a_max", 20.0, "m/s2", "twice the acceleration of a fall; usual are 0.3 to 3 m/s2"},
    Implausible{"alpha_max", 40.0 * std::numbers::pi, "rad/s2", "are these degrees? 57.3 degrees are 1 rad"}};

void warn_of_implausible(const TomlTable& table, std::span<const Implausible> limits, Experiment& experiment) {
  for (const Implausible& limit : limits)
    if (const auto value = table.find(limit.key); value && !value->is_text() && value->number() > limit.above)
      experiment.warnings.push_back(
          fmt::format("{}: '{}' is {} {}: {}", value->place(), limit.key, value->number(), limit.unit, limit.hint));
}

void warn_of_implausible(const TomlTable& root, Experiment& experiment) {
  if (const auto table = root.find_table("simulation")) warn_of_implausible(*table, implausible_simulation, experiment);
  if (const auto table = root.find_table("robot")) warn_of_implausible(*table, implausible_robot, experiment);
  if (const auto types = root.find_table("robot_type"))
    for (const TomlValue& type : types->entries()) warn_of_implausible(type.table(), implausible_robot, experiment);
}

}  // namespace

void read_world_settings(const TomlTable& root, Experiment& experiment) {
  Mistakes mistakes;
  mistakes.attempt([&] {
    if (const auto table = root.find_table("simulation")) read_simulation(*table, experiment);
  });
  mistakes.attempt([&] {
    if (const auto table = root.find_table("recovery"))
      read_swept(*table, recovery_settings(experiment.simulation.recovery));
  });
  mistakes.attempt([&] {
    if (const auto table = root.find_table("navigation"))
      read_swept(*table, navigation_settings(experiment.simulation.navigation));
  });
  mistakes.attempt([&] {
    if (const auto table = root.find_table("ending")) table->read(readers_of(ending_settings(experiment.simulation)));
  });
  mistakes.attempt([&] {
    if (const auto table = root.find_table("robot")) read_robot_table(*table, experiment.robot, {"sweep"});
  });
  mistakes.attempt([&] { experiment.robot_types = read_robot_types(root, experiment.robot); });
  mistakes.end();
  warn_of_implausible(root, experiment);
}

void read_run_settings(const TomlTable& root, Experiment& experiment) {
  Mistakes mistakes;
  mistakes.attempt([&] {
    if (const auto table = root.find_table("record")) table->read(readers_of(record_settings(experiment)));
  });
  mistakes.attempt([&] {
    if (const auto table = root.find_table("benchmark")) table->read(readers_of(benchmark_settings(experiment)));
  });
  mistakes.attempt([&] {
    if (const auto table = root.find_table("limits"))
      table->read(readers_of(limits_settings(experiment.limits, experiment.file.parent_path())));
  });
  mistakes.end();
}

std::vector<TomlKeys> settings_keys() {
  Experiment unused;
  std::vector<TomlKeys> keys = {keys_of("[simulation]", simulation_settings(unused.simulation)),
                                keys_of("[recovery]", recovery_settings(unused.simulation.recovery)),
                                keys_of("[navigation]", navigation_settings(unused.simulation.navigation)),
                                keys_of("[ending]", ending_settings(unused.simulation)),
                                keys_of("[record]", record_settings(unused)),
                                keys_of("[benchmark]", benchmark_settings(unused)),
                                keys_of("[limits]", limits_settings(unused.limits))};
  for (TomlKeys& table : robot_table_keys("[robot")) keys.push_back(std::move(table));
  for (TomlKeys& table : keys)
    if (table.title == "[simulation]" || table.title == "[recovery]" || table.title == "[navigation]" ||
        table.title == "[robot]")
      table.keys.push_back({"sweep", "", "{}"});
  return keys;
}

// The line `sweep = { ... }` of a table; none if it has no sweep.
static std::string sweep_text(const Experiment& experiment, const std::string& table) {
  std::string lists;
  for (const SettingsSweep& sweep : experiment.sweeps)
    if (sweep.table == table)
      lists += fmt::format("{}{} = [{}]", lists.empty() ? "" : ", ", sweep.key, fmt::join(sweep.values, ", "));
  return lists.empty() ? "" : fmt::format("sweep = {{ {} }}\n", lists);
}

std::string settings_text(const Experiment& experiment) {
  Experiment copy;  // Setting::read needs variables; the text does not change them
  copy.simulation = experiment.simulation;
  copy.traces = experiment.traces;
  copy.scans = experiment.scans;
  copy.annotations = experiment.annotations;
  copy.limits = experiment.limits;
  copy.smallest_effect = experiment.smallest_effect;
  Settings simulation = simulation_settings(copy.simulation);
  if (!experiment.time_limit_set)
    std::erase_if(simulation, [](const Setting& setting) { return setting.key == "time_limit_s"; });
  const std::string recovery =
      "\n[recovery]\n" + lines_of(recovery_settings(copy.simulation.recovery), 26) + sweep_text(experiment, "recovery");
  const std::string navigation = "\n[navigation]\n" + lines_of(navigation_settings(copy.simulation.navigation), 9) +
                                 sweep_text(experiment, "navigation");
  std::string robots = "\n[robot]\n" + robot_text(experiment.robot) + sweep_text(experiment, "robot");
  for (const core::RobotSettings& type : experiment.robot_types)
    robots += "\n[robot_type." + toml_key(type.type) + "]\n" + robot_text(type);
  return "\n[simulation]\n" + lines_of(simulation, 26) + sweep_text(experiment, "simulation") + recovery + navigation +
         robots + "\n[ending]\n" + lines_of(ending_settings(copy.simulation), 12) + "\n[record]\n" +
         lines_of(record_settings(copy), 11) + "\n[benchmark]\n" + lines_of(benchmark_settings(copy), 15) +
         "\n[limits]\n" + lines_of(limits_settings(copy.limits), 17);
}

}  // namespace dmrp::host
