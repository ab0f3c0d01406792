// SPDX-License-Identifier: MIT
#include "host/experiment/read_settings.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace dmrp::host {

namespace {

constexpr double longest_s = 1e6;

void read_positive(TomlTable& table, const char* key, double& to) {
  if (const auto value = table.find(key)) to = value->positive();
}

void read_number(TomlTable& table, const char* key, double& to, double minimum, double maximum) {
  if (const auto value = table.find(key)) to = value->number(minimum, maximum);
}

void read_seconds(TomlTable& table, const char* key, std::int64_t& to_ns) {
  if (const auto value = table.find(key)) {
    const double seconds = value->number(1e-3, longest_s);
    to_ns = std::llround(seconds * 1e9);
  }
}

// Settings of the design that later work brings: their default is accepted, anything else refused plainly.
void refuse_unbuilt(TomlTable& table, const char* key, const std::string& only) {
  const auto value = table.find(key);
  if (!value) return;
  const std::string written = value->type_name() == "a string" ? value->text() : fmt::format("{}", value->number());
  if (written != only) value->fail(fmt::format("'{}' can only be {} so far: the rest is not built yet", key, only));
}

void read_simulation(TomlTable& root, Experiment& experiment) {
  auto found = root.find_table("simulation");
  if (!found) return;
  TomlTable& table = *found;
  core::SimulationSettings& to = experiment.simulation;
  read_seconds(table, "step_s", to.step_ns);
  read_seconds(table, "control_period_s", to.control_period_ns);
  if (to.control_period_ns % to.step_ns != 0)
    table.fail(fmt::format("control_period_s must be a multiple of step_s, {} s is none of {} s",
                           static_cast<double>(to.control_period_ns) * 1e-9, static_cast<double>(to.step_ns) * 1e-9));
  experiment.time_limit_set = table.find("time_limit_s").has_value();
  read_seconds(table, "time_limit_s", to.time_limit_ns);
  read_number(table, "grid_resolution_m", to.grid_resolution_m, 0.05, 100.0);
  read_seconds(table, "step_duration_s", to.step_duration_ns);
  read_number(table, "planning_margin_m", to.planning_margin_m, 0.0, 10.0);
  if (const auto tracking = table.find("tracking")) {
    const std::string choice = tracking->choice({"none", "visible", "all"});
    to.tracking = choice == "none"      ? core::Tracking::none
                  : choice == "visible" ? core::Tracking::visible
                                        : core::Tracking::all;
  }
  read_positive(table, "tracking_range_m", to.tracking_range_m);
  read_positive(table, "goal_tolerance_m", to.goal.tolerance_m);
  read_positive(table, "goal_tolerance_rad", to.goal.tolerance_rad);
  read_positive(table, "goal_tolerance_speed", to.goal.tolerance_speed);
  read_number(table, "goal_settle_s", to.goal.settle_s, 0.0, longest_s);
  refuse_unbuilt(table, "dispatch", "full_path");
  refuse_unbuilt(table, "execution", "free");
  refuse_unbuilt(table, "replan_period_s", "0");
  table.finish();
}

void read_lidar(TomlTable& robot, core::LidarSettings& to) {
  auto table = robot.find_table("lidar");
  if (!table) return;
  if (const auto beams = table->find("beams")) to.beams = static_cast<std::uint32_t>(beams->integer(1, 100'000));
  read_number(*table, "field_of_view_rad", to.field_of_view_rad, 0.01, 2.0 * std::numbers::pi);
  read_number(*table, "range_min_m", to.range_min_m, 0.0, 1000.0);
  read_positive(*table, "range_max_m", to.range_max_m);
  table->finish();
  if (to.range_min_m >= to.range_max_m) table->fail("'lidar' needs range_min_m < range_max_m");
}

void read_costmap(TomlTable& robot, core::CostmapSettings& to) {
  auto table = robot.find_table("costmap");
  if (!table) return;
  read_number(*table, "resolution_m", to.resolution_m, 0.01, 1.0);
  read_number(*table, "window_m", to.window_m, 1.0, 100.0);
  read_positive(*table, "obstacle_range_m", to.obstacle_range_m);
  read_positive(*table, "raytrace_range_m", to.raytrace_range_m);
  read_positive(*table, "inflation_radius_m", to.inflation_radius_m);
  read_positive(*table, "cost_scaling", to.cost_scaling);
  table->finish();
}

void read_robot(TomlTable& root, core::RobotSettings& to) {
  auto table = root.find_table("robot");
  if (!table) return;
  if (auto footprint = table->find_table("footprint")) {
    read_number(*footprint, "radius_m", to.radius_m, 0.01, 10.0);
    footprint->finish();
  }
  read_number(*table, "v_min", to.v_min, -100.0, 0.0);
  read_positive(*table, "v_max", to.v_max);
  read_positive(*table, "omega_max", to.omega_max);
  read_positive(*table, "a_max", to.a_max);
  read_positive(*table, "alpha_max", to.alpha_max);
  read_lidar(*table, to.lidar);
  read_costmap(*table, to.costmap);
  table->finish();
}

void read_record(TomlTable& root, Experiment& experiment) {
  auto table = root.find_table("record");
  if (!table) return;
  if (const auto traces = table->find("traces")) {
    const std::string choice = traces->choice({"all", "failed", "none"});
    experiment.traces = choice == "all"      ? RecordTraces::all
                        : choice == "failed" ? RecordTraces::failed
                                             : RecordTraces::none;
  }
  table->finish();
}

void read_limits(TomlTable& root, RunLimits& to) {
  auto table = root.find_table("limits");
  if (!table) return;
  read_number(*table, "planner_time_s", to.planner_time_s, 1e-3, longest_s);
  read_number(*table, "step_time_s", to.step_time_s, 1e-3, longest_s);
  read_number(*table, "trial_wall_time_s", to.trial_wall_time_s, 1e-3, longest_s);
  if (const auto memory = table->find("memory_mb")) to.memory_mb = memory->integer(0, 1 << 30);
  table->finish();
}

}  // namespace

void read_settings(TomlTable& root, Experiment& experiment) {
  read_simulation(root, experiment);
  read_robot(root, experiment.robot);
  read_record(root, experiment);
  read_limits(root, experiment.limits);
}

}  // namespace dmrp::host
