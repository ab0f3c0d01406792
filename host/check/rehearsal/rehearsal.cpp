// SPDX-License-Identifier: MIT
#include "host/check/rehearsal/rehearsal.hpp"

#include <stdexcept>

namespace dmrp::host {

namespace {

const dmrp_world& grown_world(const dmrp_world& world, Inputs& inputs) {
  dmrp_world& grown = *inputs.one(world);
  dmrp_robot* const robots = inputs.array(world.robots, world.robot_count);
  for (std::uint32_t i = 0; i < world.robot_count; ++i) {
    dmrp_robot& robot = inputs.at(robots, i);
    robot.limits = inputs.one(*robot.limits);
    robot.footprint = inputs.one(*robot.footprint);
    robot.goals = inputs.array(robot.goals, robot.goal_count);
    robot.goal_stride = inputs.stride<dmrp_goal>();
  }
  grown.robots = robots;
  grown.robot_stride = inputs.stride<dmrp_robot>();
  grown.shapes = inputs.array(world.shapes, world.shape_count);
  grown.shape_stride = inputs.stride<dmrp_shape>();
  if (world.planning_grid) grown.planning_grid = inputs.one(*world.planning_grid);
  return grown;
}

Calls calls_of(Instance& instance, const PluginInfo& info, Stage& stage) {
  switch (info.kind) {
    case DMRP_KIND_GLOBAL_PLANNER:
      return planner_calls(instance, info, stage);
    case DMRP_KIND_LOCAL_CONTROLLER:
      return controller_calls(instance, info, stage);
    case DMRP_KIND_PEDESTRIAN_MODEL:
      return pedestrian_calls(instance, info, stage);
    case DMRP_KIND_METRIC:
      return metric_calls(instance, info, stage);
    default:
      throw std::logic_error("a kind without a rehearsal");
  }
}

}  // namespace

Rehearsal::Rehearsal(Instance& instance, const PluginInfo& info, const StageSettings& settings, std::uint64_t seed)
    : stage_(std::make_unique<Stage>(info, settings, 1)),
      calls_(calls_of(instance, info, *stage_)),
      world_(std::make_unique<Inputs>(settings.grown_bytes)) {
  const dmrp_world& world = grown_world(stage_->variant.view.world(), *world_);
  world_->seal();
  instance.start(world, seed, stage_budget_ns);
}

bool Rehearsal::advance() {
  return calls_(outputs_);
}

Outputs rehearse(Instance& instance, const PluginInfo& info, const StageSettings& settings, std::uint64_t seed) {
  Rehearsal rehearsal(instance, info, settings, seed);
  while (rehearsal.advance()) {
  }
  return rehearsal.outputs();
}

}  // namespace dmrp::host
