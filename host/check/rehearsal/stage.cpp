// SPDX-License-Identifier: MIT
#include "host/check/rehearsal/stage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace dmrp::host {

namespace {

constexpr double cell_m = 1.0;

core::Shape box(const char* name, dmrp_vec2 lower, dmrp_vec2 upper) {
  core::Shape shape;
  shape.name = name;
  shape.vertices = {lower, {upper.x, lower.y}, upper, {lower.x, upper.y}};
  return shape;
}

core::Scenario hall(const StageSettings& settings) {
  const double c = settings.corner_m;
  const dmrp_vec2 size = settings.is_large ? dmrp_vec2{60.0, 50.0} : dmrp_vec2{16.0, 12.0};
  core::Scenario scenario;
  scenario.name = "hall";
  scenario.lower = {c, c};
  scenario.upper = {c + size.x, c + size.y};
  const double middle = c + 0.5 * size.x;
  if (settings.walled_off) {
    scenario.shapes.push_back(box("wall", {middle - 0.5, c}, {middle + 0.5, c + size.y}));
  } else {
    scenario.shapes.push_back(box("left shelf", {middle - 4.0, c + 8.1}, {middle - 2.0, c + 8.9}));
    scenario.shapes.push_back(box("right shelf", {middle + 2.0, c + 8.1}, {middle + 4.0, c + 8.9}));
  }
  for (std::uint32_t i = 0; i < settings.robots; ++i) {
    const double y = c + 1.5 + (settings.touching ? 2.0 * core::RobotSettings{}.radius_m + 0.01 : 2.0) * i;
    core::RobotTask task;
    task.name = "robot " + std::to_string(i);
    task.start = {c + 1.5, y, 0.0};
    const double x = i == 0 && settings.starts_at_goal ? task.start.x : c + size.x - 1.5;
    task.goals = {{x, y, settings.goals_have_headings ? 0.5 * std::numbers::pi : core::free_heading}};
    scenario.robots.push_back(task);
  }
  const double margin_m = 0.5;
  const double depth_m = settings.is_large ? 6.0 : 2.0;
  scenario.regions = {{"left", {c + margin_m, c + margin_m}, {c + depth_m, c + size.y - margin_m}},
                      {"right", {c + size.x - depth_m, c + margin_m}, {c + size.x - margin_m, c + size.y - margin_m}}};
  if (settings.people > 0 && !settings.walled_off) {
    const std::uint32_t to_right = settings.people / 2;
    scenario.flows = {{"to the right", {0, 1}, to_right}, {"to the left", {1, 0}, settings.people - to_right}};
  }
  return scenario;
}

core::RobotSettings robot_for(const PluginInfo& info) {
  core::RobotSettings robot;
  const auto drives = [&](std::uint32_t kinematics) { return (info.kinematics & (1u << kinematics)) != 0; };
  if (info.kind != DMRP_KIND_LOCAL_CONTROLLER || drives(DMRP_KINEMATICS_DIFFERENTIAL)) return robot;
  if (drives(DMRP_KINEMATICS_HOLONOMIC)) {
    robot.drive = core::Drive::holonomic;
    robot.v_y_max = 0.8;
  } else {
    robot.drive = core::Drive::ackermann;
    robot.wheelbase_m = 0.3;
  }
  return robot;
}

Experiment experiment_on(const PluginInfo& info, const StageSettings& settings, std::uint64_t seed) {
  Experiment experiment;
  experiment.seed = seed;
  experiment.robot = robot_for(info);
  experiment.simulation.tracking = core::Tracking::all;
  experiment.simulation.dispatch = settings.by_waypoint ? core::Dispatch::waypoint : core::Dispatch::full_path;
  experiment.simulation.step_duration_ns = 1'300'000'000;  // a bit more than a cell takes at full speed
  ScenarioVariant variant;
  variant.scenario = hall(settings);
  variant.label = variant.scenario.name;
  variant.types = core::RobotTypes(experiment.robot);
  experiment.scenarios.push_back(variant);
  return experiment;
}

}  // namespace

Stage::Stage(const PluginInfo& info, const StageSettings& chosen, std::uint64_t seed)
    : settings(chosen),
      experiment_(experiment_on(info, chosen, seed)),
      variant(experiment_, experiment_.scenarios[0]),
      world(variant.scenario, variant.types, variant.simulation, variant.geometry, variant.routes, seed) {}

Plan Stage::straight_plan() const {
  Plan plan;
  plan.revision = 1;
  plan.status = DMRP_OK;
  plan.step_duration_ns = variant.simulation.step_duration_ns;
  for (std::uint32_t i = 0; i < world.robots().size(); ++i) {
    const dmrp_pose& from = world.robots()[i].pose;
    const dmrp_pose& to = world.goals(i).front().pose;
    const auto cells = static_cast<std::int64_t>(std::lround(std::abs(to.x - from.x) / cell_m));
    std::vector<dmrp_waypoint> path;
    for (std::int64_t k = 0; k <= cells; ++k)
      path.push_back(
          {from.x + static_cast<double>(k) * cell_m, from.y, core::free_heading, k * plan.step_duration_ns, 0, 0});
    plan.paths.push_back(std::move(path));
  }
  return plan;
}

std::span<const dmrp_contact> Stage::step() {
  std::vector<dmrp_vec2> velocities;
  for (const dmrp_person& person : world.people()) {
    const dmrp_vec2 way = {person.target.x - person.position.x, person.target.y - person.position.y};
    const double length_m = std::max(std::hypot(way.x, way.y), 1e-9);
    velocities.push_back({way.x / length_m * person.desired_speed, way.y / length_m * person.desired_speed});
  }
  return world.step(velocities);
}

}  // namespace dmrp::host
