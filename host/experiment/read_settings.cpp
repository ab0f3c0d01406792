// SPDX-License-Identifier: MIT
#include "host/experiment/read_settings.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace dmrp::host {

namespace {

constexpr double longest_s = 1e6;
constexpr double shortest_s = 1e-3;
constexpr double longest_latency_s = 10.0;
constexpr double farthest_m = 1e4;
constexpr double most_dropouts = 0.9;          // with more a costmap could not tell them from free space
constexpr double most_costmap_cells = 2000.0;  // along a side

using Read = std::function<void(const TomlValue&)>;
using Readers = std::vector<TomlTable::KeyReader>;

Read positive(double& to, double maximum) {
  return [&to, maximum](const TomlValue& value) {
    value.positive();
    to = value.number(0.0, maximum);
  };
}

Read number(double& to, double minimum, double maximum) {
  return [&to, minimum, maximum](const TomlValue& value) { to = value.number(minimum, maximum); };
}

Read seconds(std::int64_t& to_ns) {
  return [&to_ns](const TomlValue& value) { to_ns = std::llround(value.number(shortest_s, longest_s) * 1e9); };
}

// One of a list, told apart by its place there.
template <class Enum>
Read choice(Enum& to, const std::vector<std::string>& choices) {
  return [&to, choices](const TomlValue& value) {
    const std::string chosen = value.choice(choices);
    for (std::size_t i = 0; i < choices.size(); ++i)
      if (choices[i] == chosen) to = static_cast<Enum>(i);
  };
}

// Shorter than the window in which robots that stand count as stuck.
Read latency(std::int64_t& to_ns) {
  return [&to_ns](const TomlValue& value) { to_ns = std::llround(value.number(0.0, longest_latency_s) * 1e9); };
}

// 0: never.
Read seconds_or_never(std::int64_t& to_ns) {
  return [&to_ns](const TomlValue& value) { to_ns = std::llround(value.number(0.0, longest_s) * 1e9); };
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

// Robots turn to a new plan at control ticks.
void check_replanning(const TomlTable& table, const core::SimulationSettings& simulation) {
  for (const auto& [key, ns] : {std::pair("replan_period_s", simulation.replan.period_ns),
                                std::pair("replan_stall_s", simulation.replan.stall_ns)})
    if (ns > 0 && ns < simulation.control_period_ns)
      table.need(key).fail(fmt::format("'{}' must be 0 (never) or at least 'control_period_s', {} s", key,
                                       static_cast<double>(simulation.control_period_ns) / 1e9));
}

Readers simulation_readers(core::SimulationSettings& to) {
  return {{"step_s", seconds(to.step_ns)},
          {"control_period_s", seconds(to.control_period_ns)},
          {"time_limit_s", seconds(to.time_limit_ns)},
          {"grid_resolution_m", number(to.grid_resolution_m, 0.05, 100.0)},
          {"step_duration_s", seconds(to.step_duration_ns)},
          {"control_latency_s", latency(to.control_latency_ns)},
          {"planning_latency_s", latency(to.planning_latency_ns)},
          {"planning_margin_m", number(to.planning_margin_m, 0.0, 10.0)},
          {"tracking", choice(to.tracking, {"none", "visible", "all"})},
          {"tracking_range_m", positive(to.tracking_range_m, farthest_m)},
          {"tracking_velocity_noise_sd", number(to.tracking_velocity_noise_sd, 0.0, 10.0)},
          {"goal_tolerance_m", positive(to.goal.tolerance_m, farthest_m)},
          {"goal_tolerance_rad", positive(to.goal.tolerance_rad, std::numbers::pi)},
          {"goal_tolerance_speed", positive(to.goal.tolerance_speed, 100.0)},
          {"goal_settle_s", number(to.goal.settle_s, 0.0, longest_s)},
          {"dispatch", choice(to.dispatch, {"full_path", "waypoint"})},
          {"execution", choice(to.execution, {"free", "ordered"})},
          {"replan_period_s", seconds_or_never(to.replan.period_ns)},
          {"replan_stray_m", number(to.replan.stray_m, 0.0, farthest_m)},
          {"replan_stall_s", seconds_or_never(to.replan.stall_ns)},
          {"replan_min_interval_s", seconds_or_never(to.replan.min_interval_ns)}};
}

void read_simulation(const TomlTable& root, Experiment& experiment) {
  const auto table = root.find_table("simulation");
  if (!table) return;
  core::SimulationSettings& to = experiment.simulation;
  table->read(simulation_readers(to));
  experiment.time_limit_set = table->find("time_limit_s").has_value();
  check_control_period(*table, to);
  check_replanning(*table, to);
}

Readers lidar_readers(core::LidarSettings& to) {
  return {{"beams", [&](const TomlValue& v) { to.beams = static_cast<std::uint32_t>(v.integer(1, 100'000)); }},
          {"field_of_view_rad", number(to.field_of_view_rad, 0.01, 2.0 * std::numbers::pi)},
          {"range_min_m", number(to.range_min_m, 0.0, farthest_m)},
          {"range_max_m", positive(to.range_max_m, farthest_m)},
          {"noise_sd_m", number(to.noise_sd_m, 0.0, 10.0)},
          {"dropout_share", number(to.dropout_share, 0.0, most_dropouts)}};
}

void read_lidar(const TomlTable& robot, core::LidarSettings& to) {
  const auto table = robot.find_table("lidar");
  if (!table) return;
  table->read(lidar_readers(to));
  if (to.range_min_m >= to.range_max_m)
    table->fail(fmt::format("'lidar' needs range_min_m < range_max_m, not {} and {}", to.range_min_m, to.range_max_m));
}

Readers costmap_readers(core::CostmapSettings& to) {
  return {{"resolution_m", number(to.resolution_m, 0.01, 1.0)},
          {"window_m", number(to.window_m, 1.0, 100.0)},
          {"obstacle_range_m", positive(to.obstacle_range_m, farthest_m)},
          {"raytrace_range_m", positive(to.raytrace_range_m, farthest_m)},
          {"inflation_radius_m", positive(to.inflation_radius_m, 100.0)},
          {"cost_scaling", positive(to.cost_scaling, 1000.0)}};
}

void read_costmap(const TomlTable& robot, core::CostmapSettings& to) {
  const auto table = robot.find_table("costmap");
  if (!table) return;
  table->read(costmap_readers(to));
  if (to.window_m / to.resolution_m > most_costmap_cells)
    table->fail(fmt::format("'costmap' can have at most {} cells along a side: a window of {} m at {} m has {:.0f}",
                            most_costmap_cells, to.window_m, to.resolution_m, to.window_m / to.resolution_m));
}

Readers odometry_readers(core::OdometrySettings& to) {
  const auto noise = [&to](const TomlValue& value) {
    const std::vector<TomlValue> given = value.array();
    if (given.size() != to.noise.size())
      value.fail(
          fmt::format("'noise' must be [a1, a2, a3, a4], not {} number{}", given.size(), given.size() == 1 ? "" : "s"));
    for (std::size_t i = 0; i < given.size(); ++i) to.noise[i] = given[i].number(0.0, 100.0);
  };
  return {{"noise", noise}, {"fix_period_s", seconds_or_never(to.fix_period_ns)}};
}

void read_odometry(const TomlTable& robot, core::OdometrySettings& to) {
  if (const auto table = robot.find_table("odometry")) table->read(odometry_readers(to));
}

Readers footprint_readers(core::RobotSettings& to) {
  return {{"radius_m", number(to.radius_m, 0.01, 10.0)}};
}

// `table`: [robot], for the tables in it.
Readers robot_readers(const TomlTable& table, core::RobotSettings& to) {
  return {{"footprint", [&to](const TomlValue& value) { value.table().read(footprint_readers(to)); }},
          {"v_min", number(to.v_min, -100.0, 0.0)},
          {"v_max", positive(to.v_max, 100.0)},
          {"omega_max", positive(to.omega_max, 100.0)},
          {"a_max", positive(to.a_max, 1000.0)},
          {"alpha_max", positive(to.alpha_max, 1000.0)},
          {"actuation_latency_s", latency(to.actuation_latency_ns)},
          {"odometry", [&](const TomlValue&) { read_odometry(table, to.odometry); }},
          {"lidar", [&](const TomlValue&) { read_lidar(table, to.lidar); }},
          {"costmap", [&](const TomlValue&) { read_costmap(table, to.costmap); }}};
}

void read_robot(const TomlTable& root, core::RobotSettings& to) {
  if (const auto table = root.find_table("robot")) table->read(robot_readers(*table, to));
}

Readers record_readers(Experiment& experiment) {
  return {{"traces", choice(experiment.traces, {"all", "failed", "none"})},
          {"scans", [&](const TomlValue& value) { experiment.scans = value.boolean(); }},
          {"annotations", [&](const TomlValue& value) { experiment.annotations = value.boolean(); }}};
}

void read_record(const TomlTable& root, Experiment& experiment) {
  if (const auto table = root.find_table("record")) table->read(record_readers(experiment));
}

Readers limits_readers(RunLimits& to) {
  return {{"planner_time_s", number(to.planner_time_s, shortest_s, longest_s)},
          {"step_time_s", number(to.step_time_s, shortest_s, longest_s)},
          {"trial_wall_time_s", number(to.trial_wall_time_s, shortest_s, longest_s)},
          {"memory_mb", [&](const TomlValue& v) { to.memory_mb = v.integer(0, 1 << 30); }}};
}

void read_limits(const TomlTable& root, RunLimits& to) {
  if (const auto table = root.find_table("limits")) table->read(limits_readers(to));
}

}  // namespace

std::vector<TomlTable::KeyReader> settings_readers(const TomlTable& root, Experiment& experiment) {
  return {{"simulation", [&](const TomlValue&) { read_simulation(root, experiment); }},
          {"robot", [&](const TomlValue&) { read_robot(root, experiment.robot); }},
          {"record", [&](const TomlValue&) { read_record(root, experiment); }},
          {"limits", [&](const TomlValue&) { read_limits(root, experiment.limits); }}};
}

std::vector<TomlKeys> settings_keys(const TomlTable& root) {
  Experiment unused;
  core::RobotSettings& robot = unused.robot;
  return {{"[simulation]", TomlTable::keys_of(simulation_readers(unused.simulation))},
          {"[robot]", TomlTable::keys_of(robot_readers(root, robot))},
          {"[robot.footprint]", TomlTable::keys_of(footprint_readers(robot))},
          {"[robot.odometry]", TomlTable::keys_of(odometry_readers(robot.odometry))},
          {"[robot.lidar]", TomlTable::keys_of(lidar_readers(robot.lidar))},
          {"[robot.costmap]", TomlTable::keys_of(costmap_readers(robot.costmap))},
          {"[record]", TomlTable::keys_of(record_readers(unused))},
          {"[limits]", TomlTable::keys_of(limits_readers(unused.limits))}};
}

}  // namespace dmrp::host
