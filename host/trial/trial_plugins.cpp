// SPDX-License-Identifier: MIT
#include "host/trial/trial_plugins.hpp"

#include <dmrp/draft/processor_time.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <string_view>

#include "core/scene/robot_task.hpp"
#include "host/trial/observation.hpp"

namespace dmrp::host {

namespace {

constexpr const char* world_text = "the world (it, or another plugin of this trial)";

bool asks_for(const PluginInfo& info, std::string_view id) {
  const auto has = [id](const std::vector<std::string>& ids) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
  };
  return has(info.needs) || has(info.uses);
}

std::uint64_t instance_seed(std::uint64_t seed, const char* purpose, std::uint32_t index) {
  return toolkit::Stream(seed, purpose, index).next_u64();
}

}  // namespace

TrialPlugins::TrialPlugins(InstancePool& pool, const Experiment& experiment, const Combination& combination,
                           const VariantWorld& variant, const core::World& world, std::uint64_t seed,
                           core::TraceEncoder& trace, FirstPlan first_plan)
    : experiment_(experiment),
      variant_(variant),
      world_(world),
      first_plan_(std::move(first_plan)),
      scanned_trace_(experiment.scans && experiment.traces != RecordTraces::none ? &trace : nullptr),
      annotated_trace_(experiment.annotations && experiment.traces != RecordTraces::none ? &trace : nullptr) {
  copy_world();
  if (combination.global_planner >= 0) {
    planner_use_ = &experiment_.global_planners[static_cast<std::size_t>(combination.global_planner)];
    if (!first_plan_.given || (annotated_trace_ && asks_for(planner_use_->info, DMRP_EXT_ANNOTATE)))
      start_planner(pool, seed);
  }
  if (combination.local_controller >= 0) start_controllers(combination, pool, seed);
  if (combination.pedestrian_model >= 0) start_pedestrian_model(combination, pool, seed);
}

core::Lidar& TrialPlugins::lidar_of(std::uint32_t robot) {
  const core::RobotSettings& type = world_.robot_settings(robot);
  return lidars_.try_emplace(type.type, type.lidar, variant_.geometry).first->second;
}

void TrialPlugins::start_planner(InstancePool& pool, std::uint64_t seed) {
  planner_ = &pool.get(*planner_use_, DMRP_NO_ROBOT);
  offer(*planner_, DMRP_KIND_GLOBAL_PLANNER, annotated_trace_);
  planner_->start(variant_.view.world(), instance_seed(seed, "global_planner", 0),
                  nanoseconds(experiment_.limits.planner_time_s));
}

void TrialPlugins::start_controllers(const Combination& combination, InstancePool& pool, std::uint64_t seed) {
  const PluginUse& use = experiment_.local_controllers[static_cast<std::size_t>(combination.local_controller)];
  const auto robot_count = static_cast<std::uint32_t>(world_.robots().size());
  const auto start = [&](Instance& instance, std::uint32_t index) {
    instance.start(variant_.view.world(), instance_seed(seed, "local_controller", index),
                   nanoseconds(experiment_.limits.step_time_s));
  };
  central_ = use.info.has_flag(DMRP_FLAG_CENTRAL);
  for (std::uint32_t i = 0; i < robot_count; ++i) {
    Instance& instance = pool.get(use, central_ ? DMRP_NO_ROBOT : static_cast<std::int32_t>(i));
    controllers_.push_back({&instance, std::make_shared<RobotSensors>(world_, i, lidar_of(i), seed),
                            instance.table<dmrp_local_controller>()});
    if (central_) continue;
    offer_to_controller(instance, i, 1);
    start(instance, i);
  }
  if (!central_ || robot_count == 0) return;
  offer_to_controller(*controllers_[0].instance, 0, robot_count);
  start(*controllers_[0].instance, 0);
}

void TrialPlugins::start_pedestrian_model(const Combination& combination, InstancePool& pool, std::uint64_t seed) {
  pedestrian_model_ = &start_crowd(combination, pool, seed, annotated_trace_);
  crowd_.emplace(*pedestrian_model_, world_, nanoseconds(experiment_.limits.step_time_s));
}

Instance& TrialPlugins::start_crowd(const Combination& combination, InstancePool& pool, std::uint64_t seed,
                                    core::TraceEncoder* annotated_trace) {
  const PluginUse& use = experiment_.pedestrian_models[static_cast<std::size_t>(combination.pedestrian_model)];
  Instance& model = pool.get(use, DMRP_NO_ROBOT);
  offer(model, DMRP_KIND_PEDESTRIAN_MODEL, annotated_trace);
  model.start(variant_.view.world(), instance_seed(seed, "pedestrian_model", 0),
              nanoseconds(experiment_.limits.step_time_s));
  return model;
}

// Instances outlive the trial, so they must not keep the extensions alive.
void TrialPlugins::offer(Instance& instance, std::uint32_t kind, core::TraceEncoder* annotated_trace) {
  annotations_.push_back(std::make_shared<Annotations>(annotated_trace, kind, 0, 0));
  const auto grids = kind == DMRP_KIND_PEDESTRIAN_MODEL ? variant_.walking_grids : nullptr;
  instance.offer([annotations = std::weak_ptr(annotations_.back()),
                  grids = std::weak_ptr(grids)](std::string_view id) -> const void* {
    if (const auto here = annotations.lock(); here && id == DMRP_EXT_ANNOTATE) return here->extension();
    const auto here = grids.lock();
    return here && id == DMRP_EXT_WALKING_GRID ? here->extension() : nullptr;
  });
}

void TrialPlugins::offer_to_controller(Instance& instance, std::uint32_t first_robot, std::uint32_t robot_count) {
  annotations_.push_back(
      std::make_shared<Annotations>(annotated_trace_, DMRP_KIND_LOCAL_CONTROLLER, first_robot, robot_count));
  std::vector<std::shared_ptr<RobotSensors>> sensors(first_robot);
  for (std::uint32_t i = 0; i < robot_count; ++i) sensors.push_back(controllers_[first_robot + i].sensors);
  sensor_extensions_.push_back(std::make_shared<SensorExtensions>(std::move(sensors)));
  instance.offer([annotations = std::weak_ptr(annotations_.back()),
                  sensors = std::weak_ptr(sensor_extensions_.back())](std::string_view id) -> const void* {
    if (const auto here = annotations.lock(); here && id == DMRP_EXT_ANNOTATE) return here->extension();
    const auto here = sensors.lock();
    return here ? here->extension(id) : nullptr;
  });
}

void TrialPlugins::note_call(std::uint32_t kind, std::uint32_t robot, const CallGuard::Result& result) {
  calls_.push_back({kind, robot, result.status, 0, result.duration_ns});
}

Plan TrialPlugins::plan(const InForce* in_force, std::int64_t step) {
  const auto source = [&](const dmrp_planning_problem& problem) {
    return planner_ ? call_planner(*planner_, problem, step) : *first_plan_.given;
  };
  Plan plan = make_plan(source, planner_use_->info, variant_, world_, in_force,
                        nanoseconds(experiment_.limits.planner_time_s), step);
  if (!in_force && planner_ && first_plan_.on_made) first_plan_.on_made(plan);
  if (plan.answered) {
    note_call(DMRP_CALL_PLAN, 0, {plan.status, plan.planning_ns});
    note_call(DMRP_CALL_PLAN_PROCESSOR_TIME, 0, {plan.status, plan.processor_ns});
  }
  return plan;
}

void TrialPlugins::set_path(std::uint32_t robot, std::span<const dmrp_waypoint> waypoints, std::int64_t step) {
  const dmrp_path path = {sizeof(path), static_cast<std::uint32_t>(waypoints.size()), sizeof(dmrp_waypoint), 0,
                          waypoints.data()};
  Controller& controller = controllers_[robot];
  const dmrp_path_update update = {sizeof(update), robot, ++controller.revision, &path};
  controller.instance->call("set_path", step, nanoseconds(experiment_.limits.step_time_s), Answers::no_other,
                            [&] { return controller.table.set_path(controller.instance->self(), &update); });
}

void TrialPlugins::sense() {
  for (std::uint32_t i = 0; i < controllers_.size(); ++i)
    if (world_.robots()[i].state == DMRP_ROBOT_ACTIVE) {
      controllers_[i].sensors->tick();
      if (scanned_trace_) scanned_trace_->scan(i, controllers_[i].sensors->scan());
    }
}

void TrialPlugins::copy_input(std::span<const dmrp_observation> observations) {
  input_.clear();
  input_.add(observations);
  for (const dmrp_observation& observation : observations) {
    input_.add(*observation.goal);
    input_.add(*observation.limits);
    input_.add(*observation.footprint);
    input_.add(std::span(observation.agents, observation.agent_count));
  }
}

void TrialPlugins::copy_world() {
  const dmrp_world& world = variant_.view.world();
  world_input_.add(world);
  world_input_.add(std::span(world.robots, world.robot_count));
  world_input_.add(std::span(world.shapes, world.shape_count));
  world_input_.add(std::span(world.segments, world.segment_count));
  if (!world.planning_grid) return;
  const dmrp_grid& grid = *world.planning_grid;
  const std::size_t cells = std::size_t{grid.width} * grid.height;
  world_input_.add(grid);
  world_input_.add(std::span(grid.free, cells));
  world_input_.add(std::span(grid.edges, cells));
  world_input_.add(std::span(grid.clearance, cells));
}

dmrp_twist TrialPlugins::checked(std::uint32_t robot, const dmrp_command& command, const char* function,
                                 std::int64_t step) const {
  if (std::isfinite(command.v_x) && std::isfinite(command.v_y) && std::isfinite(command.omega))
    return {command.v_x, command.v_y, command.omega};
  CallSite site = controllers_[robot].instance->site(function, step);
  site.robot = static_cast<std::int32_t>(robot);
  throw PluginFault(fault_kind::bad_output, site,
                    fmt::format("gave the command ({}, {}, {})", command.v_x, command.v_y, command.omega));
}

std::optional<dmrp_twist> TrialPlugins::control(std::uint32_t robot, const Guidance& guidance, std::int64_t step) {
  Controller& controller = controllers_[robot];
  const dmrp_observation seen = observation_of(robot, guidance, variant_, world_, *controller.sensors);
  copy_input({&seen, 1});
  command_.clear();
  const auto result = controller.instance->call(
      "step", step, nanoseconds(experiment_.limits.step_time_s), Answers::no_solution,
      [&] { return controller.table.step(controller.instance->self(), &seen, &command_.value); });
  command_.check(controller.instance->site("step", step), "dmrp_command");
  input_.check(controller.instance->site("step", step), "the observation");
  note_call(DMRP_CALL_CONTROL, robot, result);
  if (result.status == DMRP_NO_SOLUTION) return std::nullopt;
  return checked(robot, command_.value, "step", step);
}

std::span<const std::optional<dmrp_twist>> TrialPlugins::control_all(std::span<const GuidedRobot> robots,
                                                                     std::int64_t step) {
  observations_.clear();
  commands_.resize(robots.size());
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const std::uint32_t robot = robots[i].robot;
    observations_.push_back(observation_of(robot, robots[i].guidance, variant_, world_, *controllers_[robot].sensors));
    commands_[i].struct_size = sizeof(dmrp_command);
  }
  const dmrp_fleet fleet = {sizeof(fleet),        static_cast<std::uint32_t>(robots.size()),
                            observations_.data(), sizeof(dmrp_observation),
                            sizeof(dmrp_command), commands_.data()};
  const Controller& controller = controllers_[0];
  copy_input(observations_);
  const auto result =
      controller.instance->call("step_all", step, nanoseconds(experiment_.limits.step_time_s), Answers::no_other,
                                [&] { return controller.table.step_all(controller.instance->self(), &fleet); });
  commands_.check(controller.instance->site("step_all", step), "the commands");
  input_.check(controller.instance->site("step_all", step), "the observations");
  note_call(DMRP_CALL_CONTROL, 0, result);
  twists_.clear();
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (commands_[i].status == DMRP_NO_SOLUTION)
      twists_.push_back(std::nullopt);
    else
      twists_.push_back(checked(robots[i].robot, commands_[i], "step_all", step));
  }
  return twists_;
}

const std::vector<dmrp_vec2>& TrialPlugins::people_velocities(std::int64_t step) {
  at_rest_.assign(world_.people().size(), {0.0, 0.0});
  if (!crowd_ || at_rest_.empty()) return at_rest_;
  note_call(DMRP_CALL_PEOPLE, 0, crowd_->update(step));
  return crowd_->velocities();
}

void TrialPlugins::end_trial(const dmrp_trial_end& end, std::int64_t step) {
  const auto end_of = [&](Instance* instance) {
    if (instance) instance->end_trial(end, step, nanoseconds(experiment_.limits.step_time_s));
  };
  end_of(planner_);
  for (const Controller& controller : controllers_) {
    end_of(controller.instance);
    if (central_) break;
  }
  end_of(pedestrian_model_);
  // found late: any plugin of the trial can have done it
  for (const Instance* instance :
       {pedestrian_model_, planner_, controllers_.empty() ? nullptr : controllers_[0].instance})
    if (instance) return world_input_.check(instance->site("trial_end", step), world_text);
}

}  // namespace dmrp::host
