// SPDX-License-Identifier: MIT
#include "host/trial/trial_plugins.hpp"

#include <dmrp/ext/annotate.h>
#include <fmt/format.h>

#include <algorithm>
#include <dmrp/toolkit/random.hpp>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/scene/robot_task.hpp"
#include "host/guests/exchange/breach.hpp"
#include "host/guests/exchange/plan_message.hpp"
#include "host/guests/inside/annotations.hpp"
#include "host/trial/observation.hpp"

namespace dmrp::host {

namespace {

constexpr std::size_t most_robots_of_a_request = 64;

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

std::vector<dmrp_grid> grids_of(const VariantWorld& variant, std::uint32_t kind) {
  std::vector<dmrp_grid> grids;
  if (kind == DMRP_KIND_GLOBAL_PLANNER) {
    grids.push_back(variant.planning_grid.view());
    for (const core::RobotSettings& type : variant.types.all())
      grids.push_back(variant.planning_grids->of(type.type).view());
  }
  if (kind == DMRP_KIND_PEDESTRIAN_MODEL || kind == DMRP_KIND_METRIC)
    for (const WalkingGrids::Known& grid : variant.walking_grids->known()) grids.push_back(grid.view);
  return grids;
}

TrialPlugins::TrialPlugins(Guests& guests, const Experiment& experiment, const Combination& combination,
                           const VariantWorld& variant, const core::World& world, std::uint64_t seed,
                           core::TraceEncoder& trace, FirstPlan first_plan)
    : experiment_(experiment),
      variant_(variant),
      world_(world),
      first_plan_(std::move(first_plan)),
      step_budget_ns_(nanoseconds(experiment.limits.step_time_s)),
      scanned_trace_(experiment.scans && experiment.traces != RecordTraces::none ? &trace : nullptr),
      annotated_trace_(experiment.annotations && experiment.traces != RecordTraces::none ? &trace : nullptr) {
  const auto use = [](const std::vector<PluginUse>& uses, std::int32_t index) {
    return index >= 0 ? &uses[static_cast<std::size_t>(index)] : nullptr;
  };
  planner_use_ = use(experiment_.global_planners, combination.global_planner);
  if (planner_use_ && (!first_plan_.given || (annotated_trace_ && asks_for(planner_use_->info, DMRP_EXT_ANNOTATE))))
    planner_ = start_planner(guests, *planner_use_, "global_planner", seed);
  if (planner_use_) start_fallback(guests, seed);
  if (const PluginUse* const controller = use(experiment_.local_controllers, combination.local_controller))
    start_controllers(guests, *controller, seed);
  if (const PluginUse* const people = use(experiment_.pedestrian_models, combination.pedestrian_model))
    people_ = start(guests, *people, {}, instance_seed(seed, "pedestrian_model", 0), step_budget_ns_);
}

core::Lidar& TrialPlugins::lidar_of(std::uint32_t robot) {
  const core::RobotSettings& type = world_.robot_settings(robot);
  return lidars_.try_emplace(type.type, type.lidar, variant_.geometry).first->second;
}

TrialPlugins::InstanceHandle TrialPlugins::start_planner(Guests& guests, const PluginUse& use, const char* purpose,
                                                         std::uint64_t seed) {
  return start(guests, use, {}, instance_seed(seed, purpose, 0), nanoseconds(experiment_.limits.planner_time_s));
}

void TrialPlugins::start_fallback(Guests& guests, std::uint64_t seed) {
  for (const PluginUse& use : experiment_.fallback_planners)
    if (use.info.id == variant_.simulation.replan.fallback) fallback_use_ = &use;
  if (fallback_use_) fallback_ = start_planner(guests, *fallback_use_, "fallback_planner", seed);
}

void TrialPlugins::start_controllers(Guests& guests, const PluginUse& use, std::uint64_t seed) {
  const auto robot_count = static_cast<std::uint32_t>(world_.robots().size());
  central_ = use.info.has_flag(DMRP_FLAG_CENTRAL);
  for (std::uint32_t i = 0; i < robot_count; ++i)
    controllers_.push_back({{}, std::make_unique<RobotSensors>(sight_, i, lidar_of(i), seed)});
  for (std::uint32_t i = 0; i < robot_count; ++i) {
    InstanceHandle& handle = controllers_[i].handle;
    if (central_ && i > 0) {
      handle = controllers_[0].handle;
      continue;
    }
    handle.first_robot = i;
    handle.robot_count = central_ ? robot_count : 1;
    handle = start(guests, use, handle, instance_seed(seed, "local_controller", i), step_budget_ns_);
  }
}

TrialPlugins::InstanceHandle TrialPlugins::start(Guests& guests, const PluginUse& use, InstanceHandle handle,
                                                 std::uint64_t seed, std::int64_t budget_ns) {
  const bool drives_one = use.info.kind == DMRP_KIND_LOCAL_CONTROLLER && !central_;
  handle.instance = &guests.get(use, drives_one ? static_cast<std::int32_t>(handle.first_robot) : DMRP_NO_ROBOT);
  handle.kind = use.info.kind;
  Guest& guest = *handle.instance->guest;
  const VariantWorld& shared = variant_.shared();
  SentWorld& sent_shared = guest.shared_world(shared.world_for(handle.kind), grids_of(shared, handle.kind));
  handle.world = &shared == &variant_
                     ? &sent_shared
                     : &guest.own_world(variant_.world_for(handle.kind), sent_shared, grids_of(variant_, handle.kind));
  Arena& arena = guest.begin();
  const SentScene scene = guest.scene(sent_shared, shared.walking_grids->known());
  const StartInput* const input =
      arena.copy(StartInput{&handle.world->world(), scene, seed, handle.first_robot, handle.robot_count});
  call(handle, {GuestTask::start, 0, 0, budget_ns, input});
  return handle;
}

std::string_view TrialPlugins::call(const InstanceHandle& handle, GuestRequest request) {
  request.instance = handle.instance->number;
  request.annotated = annotated_trace_ && takes_annotations(*annotated_trace_) ? 1 : 0;
  Guest& guest = *handle.instance->guest;
  std::string_view text;
  try {
    text = guest.call(request,
                      [&](const GuestQuestion& question, Arena& arena) { return answer(handle, question, arena); });
  } catch (const PluginFault&) {
    record_annotations(handle);
    throw;
  }
  record_annotations(handle);
  return text;
}

void TrialPlugins::record_annotations(const InstanceHandle& handle) {
  const auto bytes = handle.instance->guest->annotations();
  if (bytes.empty() || !annotated_trace_) return;
  const auto source = [&](std::uint32_t instance, std::uint32_t robot) -> std::optional<core::AnnotationSource> {
    if (handle.kind != DMRP_KIND_LOCAL_CONTROLLER) return core::AnnotationSource{handle.kind, 0};
    if (robot >= controllers_.size() || !controllers_[robot].handle.instance ||
        controllers_[robot].handle.instance->number != instance)
      return std::nullopt;
    return core::AnnotationSource{handle.kind, robot};
  };
  host::record_annotations(bytes, source, *annotated_trace_);
}

// Copies the reading into the arena, where the guest finds it.
const void* TrialPlugins::answer(const InstanceHandle& handle, const GuestQuestion& question, Arena& arena) {
  if (handle.kind != DMRP_KIND_LOCAL_CONTROLLER) return nullptr;
  if (question.kind == GuestQuestion::subscribe_to_costmap) {
    for (std::uint32_t i = 0; i < handle.robot_count; ++i)
      controllers_[handle.first_robot + i].sensors->subscribe_to_costmap();
    return nullptr;
  }
  const bool drives = question.robot < controllers_.size() && controllers_[question.robot].handle.instance &&
                      controllers_[question.robot].handle.instance->number == question.instance;
  if (!drives) return nullptr;
  return reading(*controllers_[question.robot].sensors, question.kind, arena);
}

const void* TrialPlugins::reading(RobotSensors& sensors, std::uint32_t kind, Arena& arena) {
  if (kind == GuestQuestion::scan) return sent(arena, sensors.scan());
  if (!sensors.has_costmap()) return nullptr;
  switch (kind) {
    case GuestQuestion::costmap:
      return sent(arena, sensors.costmap());
    case GuestQuestion::distance_field:
      return sent(arena, sensors.distance_field());
    case GuestQuestion::clusters:
      return sent(arena, sensors.clusters());
    default:
      return nullptr;
  }
}

SentReadings TrialPlugins::readings_of(const Controller& controller, Arena& arena) {
  SentReadings readings{};
  for (std::uint32_t kind = 0; kind < SentReadings::kinds; ++kind)
    if (controller.read & 1u << kind) readings.of[kind] = reading(*controller.sensors, kind, arena);
  return readings;
}

void TrialPlugins::note_call(std::uint32_t kind, std::uint32_t robot, const CallAnswer& answer) {
  calls_.push_back({kind, robot, answer.status, 0, answer.duration_ns});
}

Plan TrialPlugins::plan(const InForce* in_force, std::int64_t step) {
  const auto source = [&](const dmrp_planning_problem& problem) {
    return planner_.instance ? ask_planner(planner_, problem, step) : *first_plan_.given;
  };
  Plan plan = make(source, planner_use_->info, in_force, step);
  if (!planner_use_->plans.is_given()) note_plan(plan);
  if (!in_force && planner_.instance && first_plan_.on_made) first_plan_.on_made(plan);
  return plan;
}

Plan TrialPlugins::plan_by_fallback(const InForce* in_force, std::int64_t step) {
  const auto source = [&](const dmrp_planning_problem& problem) { return ask_planner(fallback_, problem, step); };
  Plan plan = make(source, fallback_use_->info, in_force, step);
  note_plan(plan);
  return plan;
}

Plan TrialPlugins::make(const PlanSource& source, const PluginInfo& info, const InForce* in_force, std::int64_t step) {
  return make_plan(source, info, variant_, world_, in_force, nanoseconds(experiment_.limits.planner_time_s), step);
}

void TrialPlugins::note_plan(const Plan& plan) {
  if (plan.answered) note_call(DMRP_CALL_PLAN, DMRP_ALL_ROBOTS, {plan.status, plan.planning_ns});
}

PlannerAnswer TrialPlugins::ask_planner(const InstanceHandle& planner, const dmrp_planning_problem& problem,
                                        std::int64_t step) {
  Guest& guest = *planner.instance->guest;
  Arena& arena = guest.begin();
  const PlanInput* const input = arena.copy(plan_input(arena, guest.output(), *planner.world, problem));
  const std::string_view text = call(planner, {GuestTask::plan, 0, step, problem.time_budget_ns, input});
  return planner_answer(text, *input, problem.robot_count, planner.instance->site("plan", step));
}

void TrialPlugins::sense() {
  for (std::uint32_t i = 0; i < controllers_.size(); ++i)
    if (world_.robots()[i].state == DMRP_ROBOT_ACTIVE) {
      controllers_[i].sensors->tick();
      if (scanned_trace_) scanned_trace_->scan(i, controllers_[i].sensors->scan());
    }
}

std::span<const TrialPlugins::Answer> TrialPlugins::control(std::span<const DrivenRobot> robots, std::int64_t step) {
  answers_.clear();
  const std::size_t most = central_ ? robots.size() : most_robots_of_a_request;
  for (std::size_t first = 0; first < robots.size(); first += most)
    control_all(robots.subspan(first, std::min(most, robots.size() - first)), step);
  return answers_;
}

const dmrp_path_update* TrialPlugins::update_of(const DrivenRobot& robot, Arena& arena) {
  const PathUpdate& handed = robot.new_path;
  if (handed.waypoints.empty()) return nullptr;
  const auto count = static_cast<std::uint32_t>(handed.waypoints.size());
  const dmrp_path* const path = arena.copy(dmrp_path{sizeof(dmrp_path), count, sizeof(dmrp_waypoint), handed.flags,
                                                     arena.copy(handed.waypoints.data(), count)});
  return arena.copy(dmrp_path_update{sizeof(dmrp_path_update), robot.robot, ++controllers_[robot.robot].revision, path,
                                     handed.update_flags, 0});
}

void TrialPlugins::control_all(std::span<const DrivenRobot> robots, std::int64_t step) {
  const InstanceHandle& first = controllers_[robots[0].robot].handle;
  Guest& guest = *first.instance->guest;
  Arena& arena = guest.begin();
  auto* const items = arena.make<ControlItem>(robots.size());
  auto* const observations = arena.make<dmrp_observation>(robots.size());
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const DrivenRobot& robot = robots[i];
    const Controller& controller = controllers_[robot.robot];
    const dmrp_observation seen = observation_of(robot.robot, robot.guidance, variant_, world_, *controller.sensors);
    observations[i] = controller.handle.world->copy(arena, seen);
    items[i] = {controller.handle.instance->number, update_of(robot, arena), readings_of(controller, arena)};
  }
  auto* const answers = guest.output().make<ControlAnswer>(robots.size());
  auto* const of_all = guest.output().make<CallAnswer>();
  const ControlInput* const input =
      arena.copy(ControlInput{static_cast<std::uint32_t>(robots.size()), items, observations, answers});
  call(first, {GuestTask::control_all, 0, step, step_budget_ns_, input, of_all});
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const ControlAnswer answer = answers[i];
    take_command(robots[i], answer, step);
    if (!central_) note_call(DMRP_CALL_CONTROL, robots[i].robot, answer.call);
  }
  if (central_) note_call(DMRP_CALL_CONTROL, DMRP_ALL_ROBOTS, *of_all);
}

void TrialPlugins::take_command(const DrivenRobot& robot, const ControlAnswer& answer, std::int64_t step) {
  const dmrp_command& command = answer.command;
  controllers_[robot.robot].read = answer.read;
  const std::int32_t status = answer.call.status;
  if (status == DMRP_NO_SOLUTION) {
    answers_.push_back({std::nullopt, status});
    return;
  }
  const auto fail = [&](const char* kind, const std::string& text) {
    CallSite site = controllers_[robot.robot].handle.instance->site(central_ ? "step_all" : "step", step);
    site.robot = static_cast<std::int32_t>(robot.robot);
    throw PluginFault(kind, site, text);
  };
  if (central_ && status != DMRP_OK)  // the status of a call has been checked
    fail(fault_kind::abi_breach, fmt::format("gave the status {}, which status.h does not allow a command", status));
  if (const std::string breach = breach_of(command); !breach.empty()) fail(fault_kind::bad_output, breach);
  answers_.push_back({dmrp_twist{command.v_x, command.v_y, command.omega}, status});
}

const std::vector<dmrp_vec2>& TrialPlugins::people_velocities(std::int64_t step) {
  const auto people = world_.people();
  velocities_.assign(people.size(), {0.0, 0.0});
  if (!people_.instance || people.empty()) return velocities_;
  Guest& guest = *people_.instance->guest;
  Arena& arena = guest.begin();
  const auto robots = world_.robot_agents();
  auto* const motions = guest.output().make<dmrp_motion>(people.size());
  auto* const answer = guest.output().make<CallAnswer>();
  const dmrp_crowd crowd = {sizeof(crowd),
                            static_cast<std::uint32_t>(people.size()),
                            world_.t_ns(),
                            world_.settings().step_ns,
                            arena.copy(people.data(), people.size()),
                            arena.copy(robots.data(), robots.size()),
                            sizeof(dmrp_person),
                            static_cast<std::uint32_t>(robots.size()),
                            sizeof(dmrp_agent),
                            0};
  const PeopleInput* const input = arena.copy(PeopleInput{crowd, motions});
  call(people_, {GuestTask::move_people, 0, step, step_budget_ns_, input, answer});
  for (std::size_t i = 0; i < people.size(); ++i) {
    const dmrp_vec2 velocity = motions[i].velocity;
    if (const std::string breach = breach_of(people[i].id, velocity); !breach.empty())
      throw PluginFault(fault_kind::bad_output, people_.instance->site("step", step), breach);
    velocities_[i] = velocity;
  }
  note_call(DMRP_CALL_PEOPLE, DMRP_ALL_ROBOTS, *answer);
  return velocities_;
}

void TrialPlugins::end_trial(const dmrp_trial_end& end, std::int64_t step) {
  const auto end_of = [&](const InstanceHandle& handle) {
    if (!handle.instance) return;
    const dmrp_trial_end* const input = sent(handle.instance->guest->begin(), end);
    call(handle, {GuestTask::end_trial, 0, step, step_budget_ns_, input});
  };
  end_of(planner_);
  end_of(fallback_);
  for (const Controller& controller : controllers_) {
    end_of(controller.handle);
    if (central_) break;
  }
  end_of(people_);
}

}  // namespace dmrp::host
