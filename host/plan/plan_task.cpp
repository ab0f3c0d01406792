// SPDX-License-Identifier: MIT
#include "host/plan/plan_task.hpp"

#include <fmt/format.h>

namespace dmrp::host {

namespace {

constexpr double cell_m = 1.0;

core::Scenario scenario_of(const core::CellMap& map, const std::vector<MovingAiTask>& tasks) {
  core::Scenario scenario;
  scenario.name = "cells";
  scenario.upper = {cell_m * map.width, cell_m * map.height};
  scenario.shapes = core::boxes_of(map, cell_m, scenario.lower);
  const auto pose_of = [&](MovingAiCell cell) {
    const dmrp_vec2 center = center_of(cell, map, cell_m);
    return dmrp_pose{center.x, center.y, core::free_heading};
  };
  for (const MovingAiTask& task : tasks)
    scenario.robots.push_back(
        {fmt::format("robot {}", scenario.robots.size()), pose_of(task.start), {pose_of(task.goal)}});
  return scenario;
}

// Starts and goals are at the centres of free cells.
void stage_cells(const dmrp_world& world, const Experiment& experiment, StagedProblem& problem) {
  problem.grid = *world.planning_grid;
  problem.goals.resize(world.robot_count);
  for (std::uint32_t i = 0; i < world.robot_count; ++i) {
    const dmrp_robot& body = *DMRP_AT(dmrp_robot, world.robots, world.robot_stride, i);
    problem.goals[i] = {body.goals[0]};
    dmrp_planning_robot robot{};
    robot.state = DMRP_ROBOT_ACTIVE;
    robot.goal_count = 1;
    robot.goals = problem.goals[i].data();
    robot.goal_stride = sizeof(dmrp_goal);
    robot.grid = &problem.grid;
    robot.robot = &body;
    robot.pose = body.start;
    robot.start = {body.start.x, body.start.y};
    problem.robots.push_back(robot);
  }
  dmrp_planning_problem& c = problem.c;
  c.struct_size = sizeof(c);
  c.robot_count = world.robot_count;
  c.robots = problem.robots.data();
  c.robot_stride = sizeof(dmrp_planning_robot);
  c.revision = 1;
  c.step_duration_ns = experiment.simulation.step_duration_ns;
  c.time_budget_ns = nanoseconds(experiment.limits.planner_time_s);
  c.grid = &problem.grid;
}

}  // namespace

std::unique_ptr<PlanTask> scenario_task(const Experiment& experiment) {
  auto task = std::make_unique<PlanTask>();
  task->variant = std::make_unique<VariantWorld>(experiment, experiment.scenarios[0]);
  if (is_drawn(experiment.scenarios[0])) {
    const std::uint64_t seed = task_seed(experiment, task->variant->scenario.name, experiment.scenarios[0].wishes, 0);
    task->variant = std::make_unique<VariantWorld>(experiment, experiment.scenarios[0], *task->variant, seed);
  }
  const VariantWorld& variant = *task->variant;
  task->geometry = variant.geometry;
  stage_first_problem(experiment, variant, task->problem);
  return task;
}

std::unique_ptr<PlanTask> cell_task(const core::CellMap& map, const std::vector<MovingAiTask>& tasks,
                                    const Experiment& experiment) {
  auto task = std::make_unique<PlanTask>();
  const core::Scenario scenario = scenario_of(map, tasks);
  task->geometry = std::make_shared<core::StaticGeometry>(scenario);
  core::RobotSettings point = experiment.robot;
  point.radius_m = 0.0;
  const core::PlanningGrid grid = core::planning_grid_of(map, cell_m);
  task->cell_view = std::make_unique<core::WorldView>(scenario, point, experiment.simulation, *task->geometry, grid,
                                                      nanoseconds(experiment.limits.step_time_s));
  stage_cells(task->cell_view->world(), experiment, task->problem);
  return task;
}

}  // namespace dmrp::host
