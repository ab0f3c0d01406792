// SPDX-License-Identifier: MIT
#include "host/experiment/settings_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "host/toml/toml_text.hpp"

namespace dmrp::host {

namespace {

constexpr double max_time_s = 1e6;
constexpr double min_time_s = 1e-3;
constexpr double max_latency_s = 10.0;
constexpr double max_length_m = 1e4;
constexpr double max_dropout_share = 0.9;     // with more a costmap cannot distinguish them from free space
constexpr double max_costmap_cells = 2000.0;  // along a side

// A key of a table: reads its value from a file, and writes it as TOML.
struct Setting {
  std::string key;
  std::function<void(const TomlValue&)> read;
  std::function<std::string()> write;
};
using Settings = std::vector<Setting>;

std::vector<TomlTable::KeyReader> readers_of(const Settings& settings) {
  std::vector<TomlTable::KeyReader> readers;
  for (const Setting& setting : settings) readers.emplace_back(setting.key, setting.read);
  return readers;
}

TomlKeys keys_of(const std::string& title, const Settings& settings) {
  return {title, TomlTable::keys_of(readers_of(settings))};
}

// Lines of key = value, the keys padded to `width`.
std::string lines_of(const Settings& settings, std::size_t width) {
  std::string lines;
  for (const Setting& setting : settings) lines += fmt::format("{:<{}} = {}\n", setting.key, width, setting.write());
  return lines;
}

std::string inline_table(const Settings& settings) {
  std::string text;
  for (const Setting& setting : settings)
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", setting.key, setting.write());
  return "{ " + text + " }";
}

Setting number(const std::string& key, double& to, double minimum, double maximum) {
  return {key, [&to, minimum, maximum](const TomlValue& value) { to = value.number(minimum, maximum); },
          [&to] { return toml_text(to); }};
}

Setting positive(const std::string& key, double& to, double maximum) {
  return {key,
          [&to, maximum](const TomlValue& value) {
            value.positive();
            to = value.number(0.0, maximum);
          },
          [&to] { return toml_text(to); }};
}

template <class Integer>
Setting integer(const std::string& key, Integer& to, std::int64_t minimum, std::int64_t maximum) {
  return {
      key,
      [&to, minimum, maximum](const TomlValue& value) { to = static_cast<Integer>(value.integer(minimum, maximum)); },
      [&to] { return std::to_string(to); }};
}

Setting boolean(const std::string& key, bool& to) {
  return {key, [&to](const TomlValue& value) { to = value.boolean(); }, [&to] { return to ? "true" : "false"; }};
}

// Seconds in the file, nanoseconds in memory.
Setting time(const std::string& key, std::int64_t& to_ns, double minimum_s, double maximum_s) {
  return {key,
          [&to_ns, minimum_s, maximum_s](const TomlValue& value) {
            to_ns = std::llround(value.number(minimum_s, maximum_s) * 1e9);
          },
          [&to_ns] { return toml_text(static_cast<double>(to_ns) / 1e9); }};
}
Setting seconds(const std::string& key, std::int64_t& to_ns) {
  return time(key, to_ns, min_time_s, max_time_s);
}
Setting seconds_or_never(const std::string& key, std::int64_t& to_ns) {  // 0: never
  return time(key, to_ns, 0.0, max_time_s);
}
Setting latency(const std::string& key, std::int64_t& to_ns) {
  return time(key, to_ns, 0.0, max_latency_s);
}

// A table in the table. `check` runs after all its keys have been read.
Setting subtable(const std::string& key, const Settings& settings,
                 const std::function<void(const TomlTable&)>& check = {}) {
  return {key,
          [settings, check](const TomlValue& value) {
            const TomlTable table = value.table();
            table.read(readers_of(settings));
            if (check) check(table);
          },
          [settings] { return inline_table(settings); }};
}

// One of a list; the position in the list is the value of the enumerator.
template <class Enum>
Setting choice(const std::string& key, Enum& to, const std::vector<std::string>& choices) {
  return {key,
          [&to, choices](const TomlValue& value) {
            const std::string chosen = value.choice(choices);
            to = static_cast<Enum>(std::find(choices.begin(), choices.end(), chosen) - choices.begin());
          },
          [&to, choices] { return toml_text(choices[static_cast<std::size_t>(to)]); }};
}

void check_control_period(const TomlTable& table, const core::SimulationSettings& simulation) {
  if (simulation.control_period_ns % simulation.step_ns == 0) return;
  const auto period = table.find("control_period_s");
  const auto step = table.find("step_s");
  (period ? *period : *step)
      .fail(fmt::format("'control_period_s' must be a multiple of 'step_s': {} s is none of {} s",
                        static_cast<double>(simulation.control_period_ns) / 1e9,
                        static_cast<double>(simulation.step_ns) / 1e9));
}

// Robots change to a new plan at control ticks.
void check_replanning(const TomlTable& table, const core::SimulationSettings& simulation) {
  for (const auto& [key, ns] : {std::pair("replan_period_s", simulation.replan.period_ns),
                                std::pair("replan_stall_s", simulation.replan.stall_ns)})
    if (ns > 0 && ns < simulation.control_period_ns)
      table.need(key).fail(fmt::format("'{}' must be 0 (never) or at least 'control_period_s', {} s", key,
                                       static_cast<double>(simulation.control_period_ns) / 1e9));
}

Settings simulation_settings(core::SimulationSettings& to) {
  return {seconds("step_s", to.step_ns),
          seconds("control_period_s", to.control_period_ns),
          seconds("time_limit_s", to.time_limit_ns),
          number("grid_resolution_m", to.grid_resolution_m, 0.05, 100.0),
          seconds("step_duration_s", to.step_duration_ns),
          latency("control_latency_s", to.control_latency_ns),
          latency("planning_latency_s", to.planning_latency_ns),
          number("planning_margin_m", to.planning_margin_m, 0.0, 10.0),
          choice("tracking", to.tracking, {"none", "visible", "all"}),
          positive("tracking_range_m", to.tracking_range_m, max_length_m),
          number("tracking_velocity_noise_sd", to.tracking_velocity_noise_sd, 0.0, 10.0),
          positive("goal_tolerance_m", to.goal.tolerance_m, max_length_m),
          positive("goal_tolerance_rad", to.goal.tolerance_rad, std::numbers::pi),
          positive("goal_tolerance_speed", to.goal.tolerance_speed, 100.0),
          number("goal_settle_s", to.goal.settle_s, 0.0, max_time_s),
          choice("dispatch", to.dispatch, {"full_path", "waypoint"}),
          choice("execution", to.execution, {"free", "ordered"}),
          seconds_or_never("replan_period_s", to.replan.period_ns),
          number("replan_stray_m", to.replan.stray_m, 0.0, max_length_m),
          seconds_or_never("replan_stall_s", to.replan.stall_ns),
          seconds_or_never("replan_min_interval_s", to.replan.min_interval_ns)};
}

void read_simulation(const TomlTable& table, Experiment& experiment) {
  core::SimulationSettings& simulation = experiment.simulation;
  table.read(readers_of(simulation_settings(simulation)));
  experiment.time_limit_set = table.find("time_limit_s").has_value();
  check_control_period(table, simulation);
  check_replanning(table, simulation);
}

Settings footprint_settings(core::RobotSettings& to) {
  return {number("radius_m", to.radius_m, 0.01, 10.0)};
}

Settings odometry_settings(core::OdometrySettings& to) {
  const auto read_noise = [&to](const TomlValue& value) {
    const std::vector<TomlValue> given = value.array();
    if (given.size() != to.noise.size())
      value.fail(
          fmt::format("'noise' must be [a1, a2, a3, a4], not {} number{}", given.size(), given.size() == 1 ? "" : "s"));
    for (std::size_t i = 0; i < given.size(); ++i) to.noise[i] = given[i].number(0.0, 100.0);
  };
  const auto write_noise = [&to] { return toml_text(std::vector<double>(to.noise.begin(), to.noise.end())); };
  return {{"noise", read_noise, write_noise}, seconds_or_never("fix_period_s", to.fix_period_ns)};
}

Settings lidar_settings(core::LidarSettings& to) {
  return {integer("beams", to.beams, 1, 100'000),
          number("field_of_view_rad", to.field_of_view_rad, 0.01, 2.0 * std::numbers::pi),
          number("range_min_m", to.range_min_m, 0.0, max_length_m),
          positive("range_max_m", to.range_max_m, max_length_m),
          number("noise_sd_m", to.noise_sd_m, 0.0, 10.0),
          number("dropout_share", to.dropout_share, 0.0, max_dropout_share)};
}

void check_lidar(const TomlTable& table, const core::LidarSettings& lidar) {
  if (lidar.range_min_m >= lidar.range_max_m)
    table.fail(
        fmt::format("'lidar' needs range_min_m < range_max_m, not {} and {}", lidar.range_min_m, lidar.range_max_m));
}

Settings costmap_settings(core::CostmapSettings& to) {
  return {number("resolution_m", to.resolution_m, 0.01, 1.0),
          number("window_m", to.window_m, 1.0, 100.0),
          positive("obstacle_range_m", to.obstacle_range_m, max_length_m),
          positive("raytrace_range_m", to.raytrace_range_m, max_length_m),
          positive("inflation_radius_m", to.inflation_radius_m, 100.0),
          positive("cost_scaling", to.cost_scaling, 1000.0)};
}

void check_costmap(const TomlTable& table, const core::CostmapSettings& costmap) {
  const double cells = costmap.window_m / costmap.resolution_m;
  if (cells > max_costmap_cells)
    table.fail(fmt::format("'costmap' can have at most {} cells along a side: a window of {} m at {} m has {:.0f}",
                           max_costmap_cells, costmap.window_m, costmap.resolution_m, cells));
}

Settings robot_settings(core::RobotSettings& to) {
  return {subtable("footprint", footprint_settings(to)),
          number("v_min", to.v_min, -100.0, 0.0),
          positive("v_max", to.v_max, 100.0),
          positive("omega_max", to.omega_max, 100.0),
          positive("a_max", to.a_max, 1000.0),
          positive("alpha_max", to.alpha_max, 1000.0),
          latency("actuation_latency_s", to.actuation_latency_ns),
          subtable("odometry", odometry_settings(to.odometry)),
          subtable("lidar", lidar_settings(to.lidar), [&to](const TomlTable& table) { check_lidar(table, to.lidar); }),
          subtable("costmap", costmap_settings(to.costmap),
                   [&to](const TomlTable& table) { check_costmap(table, to.costmap); })};
}

Settings record_settings(Experiment& experiment) {
  return {choice("traces", experiment.traces, {"all", "failed", "none"}), boolean("scans", experiment.scans),
          boolean("annotations", experiment.annotations)};
}

Settings limits_settings(RunLimits& to) {
  return {number("planner_time_s", to.planner_time_s, min_time_s, max_time_s),
          number("step_time_s", to.step_time_s, min_time_s, max_time_s),
          number("trial_wall_time_s", to.trial_wall_time_s, min_time_s, max_time_s),
          integer("memory_mb", to.memory_mb, 0, 1 << 30), boolean("processes", to.processes)};
}

}  // namespace

std::vector<TomlTable::KeyReader> settings_readers(const TomlTable& root, Experiment& experiment) {
  const auto reader_of = [&root](const std::string& key, const std::function<Settings()>& settings) {
    return TomlTable::KeyReader(
        key, [&root, key, settings](const TomlValue&) { root.find_table(key)->read(readers_of(settings())); });
  };
  return {{"simulation", [&](const TomlValue&) { read_simulation(*root.find_table("simulation"), experiment); }},
          reader_of("robot", [&experiment] { return robot_settings(experiment.robot); }),
          reader_of("record", [&experiment] { return record_settings(experiment); }),
          reader_of("limits", [&experiment] { return limits_settings(experiment.limits); })};
}

std::vector<TomlKeys> settings_keys() {
  Experiment unused;
  core::RobotSettings& robot = unused.robot;
  return {keys_of("[simulation]", simulation_settings(unused.simulation)),
          keys_of("[robot]", robot_settings(robot)),
          keys_of("[robot.footprint]", footprint_settings(robot)),
          keys_of("[robot.odometry]", odometry_settings(robot.odometry)),
          keys_of("[robot.lidar]", lidar_settings(robot.lidar)),
          keys_of("[robot.costmap]", costmap_settings(robot.costmap)),
          keys_of("[record]", record_settings(unused)),
          keys_of("[limits]", limits_settings(unused.limits))};
}

std::string settings_text(const Experiment& experiment) {
  Experiment copy;  // Setting::read needs variables; the text does not change them
  copy.simulation = experiment.simulation;
  copy.robot = experiment.robot;
  copy.traces = experiment.traces;
  copy.scans = experiment.scans;
  copy.annotations = experiment.annotations;
  copy.limits = experiment.limits;
  Settings simulation = simulation_settings(copy.simulation);
  if (!experiment.time_limit_set)
    std::erase_if(simulation, [](const Setting& setting) { return setting.key == "time_limit_s"; });
  return "\n[simulation]\n" + lines_of(simulation, 26) + "\n[robot]\n" + lines_of(robot_settings(copy.robot), 9) +
         "\n[record]\n" + lines_of(record_settings(copy), 11) + "\n[limits]\n" +
         lines_of(limits_settings(copy.limits), 17);
}

}  // namespace dmrp::host
