// SPDX-License-Identifier: MIT
#include "host/trial/run_trial.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/execution/collision_monitor.hpp"
#include "core/execution/recovery.hpp"
#include "core/execution/referee.hpp"
#include "core/execution/replanning.hpp"
#include "core/world/world.hpp"
#include "host/trial/dispatcher.hpp"
#include "host/trial/navigator.hpp"

namespace dmrp::host {

namespace {

// The experiment's, with the latency of the trial's controller if it has one of its own.
core::SimulationSettings settings_of(const Trial& trial) {
  core::SimulationSettings settings = trial.variant.simulation;
  if (settings.replan.period_steps > 0)
    settings.replan.period_ns = settings.replan.period_steps * settings.step_duration_ns;
  const std::int32_t controller = trial.combination.local_controller;
  if (controller < 0) return settings;
  const PluginUse& use = trial.experiment.local_controllers[static_cast<std::size_t>(controller)];
  settings.control_latency_ns = use.control_latency_ns.value_or(settings.control_latency_ns);
  return settings;
}

// Files do not plan.
bool can_replan(const Trial& trial) {
  const std::int32_t planner = trial.combination.global_planner;
  const bool from_file =
      planner >= 0 && trial.experiment.global_planners[static_cast<std::size_t>(planner)].plans.is_given();
  return !from_file && core::can_replan(trial.variant.simulation);
}

class Run {
 public:
  Run(const Trial& trial, Guests& guests, core::TraceEncoder& trace)
      : settings_(settings_of(trial)),
        can_replan_(can_replan(trial)),
        world_(trial.variant.scenario, trial.variant.types, settings_, trial.variant.geometry, trial.variant.routes,
               trial.seed),
        plugins_(guests, trial.experiment, trial.combination, trial.variant, world_, trial.seed, trace,
                 {can_replan_ ? nullptr : trial.first_plan.given, trial.first_plan.on_made}),
        trace_(trace),
        dispatcher_(trial.variant, world_),
        navigator_(navigator_of(trial.variant)),
        referee_(world_, *trial.variant.planning_grids, {settings_.oscillation_fails, can_replan_}, trial.seed),
        replanning_(settings_.replan, world_.robots().size()),
        recoveries_(world_, robots_with_costmap()) {}

  dmrp_trial_end run() {
    if (has_robots()) {
      plan(nullptr);
      if (!has_plan() && !pending_plan_) {
        record({});  // for the call
        return end_without_plan();
      }
    }
    record({});

    std::uint32_t ending = referee_.ending();
    while (ending == 0) {
      if (control_due()) {  // on the state that was recorded last
        referee_.judge_progress(dispatcher_.places());
        activate_pending_plan();
        if (replan_due()) replan();
        if (has_plan())
          control();
        else
          wait_for_plan();
      }
      const auto contacts = world_.step(plugins_.people_velocities(step_));
      ++step_;
      referee_.judge_arrivals(dispatcher_.places());
      dispatcher_.update_progress();
      record(contacts);
      ending = referee_.ending();
    }
    ends_ = referee_.robot_ends(ending);
    return end(ending);
  }

  // All robots arrived, and none is excluded. A trial without robots succeeds.
  bool succeeded() const {
    return std::all_of(ends_.begin(), ends_.end(), [](const dmrp_robot_end& end) {
      return end.state == DMRP_ROBOT_FINISHED && end.failure == DMRP_FAILURE_NONE;
    });
  }

 private:
  bool has_robots() const { return !world_.robots().empty(); }
  bool has_plan() const { return plan_.exists(); }

  bool control_due() const { return world_.t_ns() % settings_.control_period_ns == 0; }

  bool replan_due() {
    if (!can_replan_ || !has_plan() || pending_plan_) return false;
    const bool due = replanning_.due(world_.t_ns(), world_.robots(), referee_.gained_m(), dispatcher_.progress());
    const bool waits = referee_.wants_plan();
    return std::exchange(recovery_asks_for_plan_, false) || due || waits;
  }

  // Where the planner finds none, its fallback is asked. Without a new plan, the plan in force stays.
  void plan(const InForce* in_force) {
    Plan plan = plugins_.plan(in_force, step_);
    trace_.plan(plan.view(), plan.conflicts);
    if (!plan.exists() && plan.answered && plugins_.has_fallback()) {
      plan = plugins_.plan_by_fallback(in_force, step_);
      trace_.plan(plan.view(), plan.conflicts);
    }
    if (!plan.exists()) return;
    pending_plan_ = std::move(plan);
    activate_pending_plan();
  }

  void activate_pending_plan() {
    if (!pending_plan_ || world_.t_ns() < pending_plan_->from_ns) return;
    plan_ = *std::exchange(pending_plan_, std::nullopt);
    dispatcher_.set_plan(plan_);
  }

  // The first plan is not in force yet: robots sense and stand still.
  void wait_for_plan() {
    plugins_.sense();
    for (std::uint32_t i = 0; i < world_.robots().size(); ++i) referee_.command_given(i);
  }

  void replan() {
    std::vector<PathPosition> positions = dispatcher_.positions_on_paths(settings_.planning_latency_ns);
    for (std::uint32_t i = 0; i < positions.size(); ++i)
      positions[i].waiting_ns = world_.t_ns() - referee_.waits_since_ns(i);
    const InForce in_force = {plan_.view(), positions};
    plan(&in_force);
  }

  void control() {
    dispatcher_.update_targets();
    plugins_.sense();
    driven_.clear();
    for (std::uint32_t i = 0; i < world_.robots().size(); ++i)
      if (!recovers(i) && is_active(i))
        driven_.push_back(rerouted({i, dispatcher_.guidance(i), dispatcher_.take_new_path(i)}));
    answers_ = plugins_.control(driven_, step_);
    for (std::size_t i = 0; i < driven_.size(); ++i) drive(driven_[i].robot, answers_[i].command);
  }

  // With the local route in place of the dispatcher's path, if robots have one.
  TrialPlugins::DrivenRobot rerouted(TrialPlugins::DrivenRobot robot) {
    if (!navigator_) return robot;
    const Navigator::Rerouted route =
        navigator_->reroute(robot.robot, robot.guidance, robot.new_path, plugins_.sensors(robot.robot));
    if (route.is_anew) note(DMRP_ROBOT_EVENT_ROUTE, robot.robot, 0);
    return {robot.robot, route.guidance, route.path};
  }

  bool is_active(std::uint32_t robot) const { return world_.robots()[robot].state == DMRP_ROBOT_ACTIVE; }

  // A single waypoint is led nowhere.
  std::optional<Navigator> navigator_of(const VariantWorld& variant) {
    if (settings_.navigation.route == core::LocalRoute::path || settings_.dispatch != core::Dispatch::full_path)
      return std::nullopt;
    for (std::uint32_t i = 0; i < world_.robots().size(); ++i) plugins_.sensors(i).subscribe_to_costmap();
    return Navigator(variant, world_);
  }

  std::vector<bool> robots_with_costmap() const {
    std::vector<bool> robots;
    for (std::uint32_t i = 0; i < world_.robots().size(); ++i) robots.push_back(plugins_.has_costmap(i));
    return robots;
  }

  // Whether the robot recovers, which commands it; its controller is not called.
  bool recovers(std::uint32_t robot) {
    if (settings_.recovery.retries == 0) return false;
    const bool recovered = recoveries_.is_recovering(robot);
    const std::uint32_t now = referee_.class_of(robot);
    const bool waits = now == DMRP_CLASS_HELD || now == DMRP_CLASS_SETTLING;
    const auto action = recoveries_.act(robot, referee_.gained_m()[robot], waits);
    if (!action) {
      if (recovered) note(DMRP_ROBOT_EVENT_RECOVERY, robot, DMRP_RECOVERY_NONE);
      referee_.recovers(robot, false);
      return false;
    }
    if (action->begins) {
      note(DMRP_ROBOT_EVENT_RECOVERY, robot, static_cast<std::uint32_t>(*action->begins));
      if (action->begins == core::RecoveryStep::clear_costmap) plugins_.clear_costmap(robot);
      if (action->begins == core::RecoveryStep::replan) recovery_asks_for_plan_ = true;
    }
    world_.set_recovery_command(robot, action->command);
    referee_.recovers(robot, true);
    referee_.command_given(robot);
    return true;
  }

  void note(std::uint32_t kind, std::uint32_t robot, std::uint32_t detail) {
    events_.push_back({kind, robot, world_.t_ns(), detail, DMRP_NOBODY});
  }

  // What the collision monitor leaves of the command.
  dmrp_twist monitored(std::uint32_t robot, const dmrp_twist& command) {
    if (!settings_.navigation.monitor) return command;
    const core::MonitoredCommand left = core::monitored(world_, robot, command);
    if (left.percent < 100) note(DMRP_ROBOT_EVENT_MONITOR, robot, left.percent);
    return left.command;
  }

  // Without a command the robot brakes.
  void drive(std::uint32_t robot, const std::optional<dmrp_twist>& command) {
    const std::uint64_t clipped_before = world_.robots()[robot].clipped_commands;
    world_.set_command(robot, command ? monitored(robot, *command) : dmrp_twist{0.0, 0.0, 0.0});
    if (world_.robots()[robot].clipped_commands > clipped_before) note(DMRP_ROBOT_EVENT_CLIPPED, robot, 0);
    if (command) referee_.command_given(robot);
    recoveries_.controller_answered(robot, command.has_value());
  }

  // The robots' states, and what their controllers were handed and answered since the last sample.
  void note_robots() {
    const dmrp_twist nothing = {std::nan(""), std::nan(""), std::nan("")};
    robots_.clear();
    for (std::size_t i = 0; i < world_.robots().size(); ++i) {
      const core::RobotState& robot = world_.robots()[i];
      robots_.push_back({robot.pose, robot.velocity, robot.command, robot.state, robot.goal_index,
                         dispatcher_.progress()[i].progress_m(), robot.steering_rad, nothing, DMRP_OK, 0});
    }
    paths_.clear();
    routes_.clear();
    for (std::size_t i = 0; i < answers_.size(); ++i) {
      dmrp_robot_sample& robot = robots_[driven_[i].robot];
      robot.answer = answers_[i].command.value_or(nothing);
      robot.answer_status = answers_[i].status;
      const PathUpdate& path = driven_[i].new_path;
      if (!path.waypoints.empty())
        paths_.push_back({sizeof(dmrp_path), static_cast<std::uint32_t>(path.waypoints.size()), sizeof(dmrp_waypoint),
                          path.flags, path.waypoints.data()});
    }
    for (std::size_t i = 0; i < answers_.size(); ++i)
      if (!driven_[i].new_path.waypoints.empty())
        routes_.push_back({driven_[i].robot, driven_[i].new_path.update_flags, &paths_[routes_.size()]});
    answers_ = {};
  }

  void record(std::span<const dmrp_contact> contacts) {
    note_robots();
    const auto people = world_.people();
    const auto calls = plugins_.take_calls();
    const auto changes = referee_.take_changes();
    events_.insert(events_.end(), changes.begin(), changes.end());
    std::stable_sort(events_.begin(), events_.end(), [](const auto& a, const auto& b) { return a.robot < b.robot; });
    dmrp_sample sample{};
    sample.struct_size = sizeof(sample);
    sample.control_tick = control_due();
    sample.t_ns = world_.t_ns();
    sample.dt_ns = step_ == 0 ? 0 : settings_.step_ns;
    sample.plan = plan_.exists() ? &plan_.view() : nullptr;
    sample.robots = robots_.data();
    sample.robot_count = static_cast<std::uint32_t>(robots_.size());
    sample.robot_stride = sizeof(dmrp_robot_sample);
    sample.people = people.data();
    sample.person_count = static_cast<std::uint32_t>(people.size());
    sample.person_stride = sizeof(dmrp_person);
    sample.contacts = contacts.data();
    sample.contact_count = static_cast<std::uint32_t>(contacts.size());
    sample.contact_stride = sizeof(dmrp_contact);
    sample.calls = calls.data();
    sample.call_count = static_cast<std::uint32_t>(calls.size());
    sample.call_stride = sizeof(dmrp_call);
    sample.events = events_.data();
    sample.event_count = static_cast<std::uint32_t>(events_.size());
    sample.event_stride = sizeof(dmrp_robot_event);
    sample.routes = routes_.data();
    sample.route_count = static_cast<std::uint32_t>(routes_.size());
    sample.route_stride = sizeof(dmrp_route);
    trace_.sample(sample);
    events_.clear();
  }

  dmrp_trial_end end_without_plan() {
    for (const core::RobotState& robot : world_.robots())
      ends_.push_back({robot.state, DMRP_FAILURE_NO_PLAN, -1, 0, DMRP_NOBODY});
    return end(DMRP_ENDING_NO_PLAN);
  }

  dmrp_trial_end end(std::uint32_t ending) {
    const dmrp_trial_end c = {sizeof(c),
                              ending,
                              world_.t_ns(),
                              ends_.data(),
                              static_cast<std::uint32_t>(ends_.size()),
                              sizeof(dmrp_robot_end)};
    plugins_.end_trial(c, step_);
    trace_.end(c, ending_text(ending));
    return c;
  }

  const core::SimulationSettings settings_;
  const bool can_replan_;
  core::World world_;
  TrialPlugins plugins_;
  core::TraceEncoder& trace_;
  Dispatcher dispatcher_;
  std::optional<Navigator> navigator_;  // none: controllers get the dispatcher's paths
  core::Referee referee_;
  core::ReplanMonitor replanning_;
  core::RecoveryLadder recoveries_;
  bool recovery_asks_for_plan_ = false;
  Plan plan_;                         // in force
  std::optional<Plan> pending_plan_;  // comes into force after the planning latency
  std::int64_t step_ = 0;
  std::vector<TrialPlugins::DrivenRobot> driven_;    // of the last control()
  std::span<const TrialPlugins::Answer> answers_{};  // parallel to them; empty once they are recorded
  std::vector<dmrp_robot_event> events_;             // since the last sample
  std::vector<dmrp_robot_sample> robots_;            // of the sample, as the next two
  std::vector<dmrp_path> paths_;
  std::vector<dmrp_route> routes_;
  std::vector<dmrp_robot_end> ends_;
};

}  // namespace

const char* ending_text(std::uint32_t ending) {
  switch (ending) {
    case DMRP_ENDING_ARRIVED:
      return "all robots arrived";
    case DMRP_ENDING_TIME_LIMIT:
      return "time limit";
    case DMRP_ENDING_DEADLOCK:
      return "deadlock";
    case DMRP_ENDING_NO_PLAN:
      return "the planner found no plan";
    case DMRP_ENDING_DESERTED:
      return "everybody left";
    case DMRP_ENDING_OVER:
      return "no robot drives any more";
    default:
      return "";
  }
}

TrialEnding run_trial(const Trial& trial, Guests& guests, core::TraceEncoder& trace) {
  Run run(trial, guests, trace);
  const dmrp_trial_end end = run.run();
  TrialEnding ending;
  ending.succeeded = run.succeeded();
  ending.sim_time_s = static_cast<double>(end.t_ns) / 1e9;  // rounded once: 39.72 s are 39.72
  return ending;
}

}  // namespace dmrp::host
