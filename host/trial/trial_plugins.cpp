// SPDX-License-Identifier: MIT
#include "host/trial/trial_plugins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <dmrp/toolkit/random.hpp>

#include "core/scene/robot_task.hpp"

namespace dmrp::host {

namespace {

constexpr double fastest_person_mps = 5.0;  // faster people are an error of the model

std::uint64_t instance_seed(std::uint64_t seed, const char* purpose, std::uint32_t index) {
  return toolkit::Stream(seed, purpose, index).next_u64();
}

}  // namespace

TrialPlugins::TrialPlugins(InstancePool& pool, const Experiment& experiment, const Combination& combination,
                           const VariantWorld& variant, const core::World& world, std::uint64_t seed,
                           core::TraceEncoder& trace)
    : experiment_(experiment),
      variant_(variant),
      world_(world),
      lidar_(experiment.robot.lidar, variant.geometry),
      scanned_trace_(experiment.scans && experiment.traces != RecordTraces::none ? &trace : nullptr),
      annotated_trace_(experiment.annotations && experiment.traces != RecordTraces::none ? &trace : nullptr) {
  if (combination.global_planner >= 0) start_planner(combination, pool, seed);
  if (combination.local_controller >= 0) start_controllers(combination, pool, seed);
  if (combination.pedestrian_model >= 0) start_pedestrian_model(combination, pool, seed);
}

void TrialPlugins::start_planner(const Combination& combination, InstancePool& pool, std::uint64_t seed) {
  planner_use_ = &experiment_.global_planners[static_cast<std::size_t>(combination.global_planner)];
  planner_ = &pool.get(*planner_use_, -1);
  offer(*planner_, {DMRP_KIND_GLOBAL_PLANNER, 0}, nullptr);
  planner_->start(variant_.view.world(), instance_seed(seed, "global_planner", 0),
                  nanoseconds(experiment_.limits.planner_time_s));
}

void TrialPlugins::start_controllers(const Combination& combination, InstancePool& pool, std::uint64_t seed) {
  const PluginUse& use = experiment_.local_controllers[static_cast<std::size_t>(combination.local_controller)];
  controllers_.reserve(world_.robots().size());  // plugins keep the address of their view
  for (std::uint32_t i = 0; i < world_.robots().size(); ++i) {
    Instance& instance = pool.get(use, static_cast<std::int32_t>(i));
    controllers_.push_back({&instance, std::make_shared<RobotSensors>(world_, i, lidar_, seed),
                            variant_.view.seen_by(static_cast<std::int32_t>(i)),
                            instance.table<dmrp_local_controller>()});
    Controller& controller = controllers_.back();
    offer(instance, {DMRP_KIND_LOCAL_CONTROLLER, i}, controller.sensors);
    instance.start(controller.view, instance_seed(seed, "local_controller", i),
                   nanoseconds(experiment_.limits.step_time_s));
  }
}

void TrialPlugins::start_pedestrian_model(const Combination& combination, InstancePool& pool, std::uint64_t seed) {
  pedestrian_model_ =
      &pool.get(experiment_.pedestrian_models[static_cast<std::size_t>(combination.pedestrian_model)], -1);
  offer(*pedestrian_model_, {DMRP_KIND_PEDESTRIAN_MODEL, 0}, nullptr);
  pedestrian_model_->start(variant_.view.world(), instance_seed(seed, "pedestrian_model", 0),
                           nanoseconds(experiment_.limits.step_time_s));
  pedestrian_table_ = pedestrian_model_->table<dmrp_pedestrian_model>();
}

// The instance outlives the trial, so it must not keep the extensions alive.
void TrialPlugins::offer(Instance& instance, core::AnnotationSource source,
                         const std::shared_ptr<RobotSensors>& sensors) {
  annotations_.push_back(std::make_shared<Annotations>(annotated_trace_, source));
  instance.offer([annotations = std::weak_ptr(annotations_.back()),
                  sensors = std::weak_ptr(sensors)](const char* id) -> const void* {
    if (const auto here = annotations.lock(); here && std::strcmp(id, DMRP_EXT_ANNOTATE) == 0) return here->extension();
    const auto here = sensors.lock();
    return here ? here->extension(id) : nullptr;
  });
}

void TrialPlugins::note_call(std::uint32_t kind, std::uint32_t robot, const CallGuard::Result& result) {
  calls_.push_back({kind, robot, result.status, 0, result.duration_ns});
}

Plan TrialPlugins::plan(const InForce* in_force, std::int64_t step) {
  Plan plan = make_plan(*planner_, planner_use_->info, variant_, world_, in_force,
                        nanoseconds(experiment_.limits.planner_time_s), step);
  if (plan.planner_called) note_call(DMRP_CALL_PLAN, 0, {plan.status, plan.planning_ns});
  return plan;
}

void TrialPlugins::set_path(std::uint32_t robot, std::span<const dmrp_waypoint> waypoints, std::int64_t step) {
  const dmrp_path path = {sizeof(path), static_cast<std::uint32_t>(waypoints.size()), sizeof(dmrp_waypoint), 0,
                          waypoints.data()};
  Controller& controller = controllers_[robot];
  const std::uint64_t revision = ++controller.revision;
  controller.instance->call("set_path", step, nanoseconds(experiment_.limits.step_time_s),
                            [&] { return controller.table.set_path(controller.instance->self(), &path, revision); });
}

void TrialPlugins::sense() {
  for (std::uint32_t i = 0; i < controllers_.size(); ++i)
    if (world_.robots()[i].state == DMRP_ROBOT_ACTIVE) {
      controllers_[i].sensors->tick();
      if (scanned_trace_) scanned_trace_->scan(i, controllers_[i].sensors->scan());
    }
}

// The observation without the robot's agents.
dmrp_observation TrialPlugins::observation(std::uint32_t robot, const Guidance& guidance) const {
  const core::RobotState& state = world_.robots()[robot];
  const dmrp_world& view = variant_.view.world();
  const dmrp_robot& body = *DMRP_AT(dmrp_robot, view.robots, view.robot_stride, robot);
  const core::Odometry& odometry = controllers_[robot].sensors->odometry();

  dmrp_observation observation{};
  observation.struct_size = sizeof(observation);
  observation.robot = robot;
  observation.t_ns = world_.t_ns();
  observation.dt_ns = variant_.simulation.control_period_ns;
  observation.pose = odometry.pose();
  observation.velocity = odometry.velocity();
  observation.applied = state.command;
  observation.goal = guidance.goal;
  observation.goal_index = state.goal_index;
  observation.goal_count = static_cast<std::uint32_t>(world_.goals(robot).size());
  observation.progress_m = guidance.progress_m;
  observation.progress_waypoint = guidance.progress_waypoint;
  observation.released_waypoint = guidance.released_waypoint;
  observation.limits = body.limits;
  observation.footprint = body.footprint;
  return observation;
}

std::optional<dmrp_twist> TrialPlugins::control(std::uint32_t robot, const Guidance& guidance, std::int64_t step) {
  Controller& controller = controllers_[robot];
  const std::vector<dmrp_agent>& agents = controller.sensors->agents();
  dmrp_observation seen = observation(robot, guidance);
  seen.agents = agents.data();
  seen.agent_count = static_cast<std::uint32_t>(agents.size());
  seen.agent_stride = sizeof(dmrp_agent);

  dmrp_command command{};
  command.struct_size = sizeof(command);
  const auto result = controller.instance->call("step", step, nanoseconds(experiment_.limits.step_time_s), [&] {
    return controller.table.step(controller.instance->self(), &seen, &command);
  });
  note_call(DMRP_CALL_CONTROL, robot, result);
  if (result.status == DMRP_NO_SOLUTION) return std::nullopt;
  if (!std::isfinite(command.v_x) || !std::isfinite(command.v_y) || !std::isfinite(command.omega))
    throw PluginFault(fault_kind::bad_output, controller.instance->site("step", step),
                      fmt::format("gave the command ({}, {}, {})", command.v_x, command.v_y, command.omega));
  return dmrp_twist{command.v_x, command.v_y, command.omega};
}

const std::vector<dmrp_vec2>& TrialPlugins::people_velocities(std::int64_t step) {
  velocities_.assign(world_.people().size(), {0.0, 0.0});
  if (!pedestrian_model_ || velocities_.empty()) return velocities_;
  const auto people = world_.people();
  const auto robots = world_.robot_agents();
  const dmrp_crowd crowd = {sizeof(crowd),       static_cast<std::uint32_t>(people.size()),
                            world_.t_ns(),       variant_.simulation.step_ns,
                            people.data(),       robots.data(),
                            sizeof(dmrp_person), static_cast<std::uint32_t>(robots.size()),
                            sizeof(dmrp_agent),  0};
  const auto result = pedestrian_model_->call("step", step, nanoseconds(experiment_.limits.step_time_s), [&] {
    return pedestrian_table_.step(pedestrian_model_->self(), &crowd, velocities_.data());
  });
  note_call(DMRP_CALL_PEOPLE, 0, result);
  if (result.status == DMRP_NO_SOLUTION) std::fill(velocities_.begin(), velocities_.end(), dmrp_vec2{0.0, 0.0});
  for (std::size_t i = 0; i < velocities_.size(); ++i)
    if (!(std::hypot(velocities_[i].x, velocities_[i].y) <= fastest_person_mps))
      throw PluginFault(
          fault_kind::bad_output, pedestrian_model_->site("step", step),
          fmt::format("gave person {} the velocity ({}, {})", people[i].id, velocities_[i].x, velocities_[i].y));
  return velocities_;
}

}  // namespace dmrp::host
