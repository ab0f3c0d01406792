// SPDX-License-Identifier: MIT
// trial_plugins.hpp: the plugins of one trial, which are guests: what they are shown is sent to them, and what they answer is
// checked.
#pragma once

#include <dmrp/local_controller.h>
#include <dmrp/metric.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/sensors/lidar.hpp"
#include "core/trace/trace_encoder.hpp"
#include "core/world/world.hpp"
#include "host/experiment/experiment.hpp"
#include "host/guests/guests.hpp"
#include "host/plans/planning.hpp"
#include "host/trial/dispatcher.hpp"
#include "host/trial/robot_sensors.hpp"
#include "host/world/variant_world.hpp"

namespace dmrp::host {

// The first plan of a trial, if it is there already, as one from a file is: then the planner is not asked for it.
struct FirstPlan {
  const PlannerAnswer* given = nullptr;
  std::function<void(const PlannerAnswer&)> on_made;  // called with a valid plan, or none, of the planner; may be empty
};

// The grids that a plugin of this kind is sent with the world.
std::vector<dmrp_grid> grids_of(const VariantWorld& variant, std::uint32_t kind);

class TrialPlugins {
 public:
  // Starts the combination's instances for this trial: the planner only if it is asked for a plan, or annotates. Their
  // annotations go to `trace`. All functions throw PluginFault.
  TrialPlugins(Guests& guests, const Experiment& experiment, const Combination& combination,
               const VariantWorld& variant, const core::World& world, std::uint64_t seed, core::TraceEncoder& trace,
               FirstPlan first_plan = {});
  TrialPlugins(const TrialPlugins&) = delete;
  TrialPlugins& operator=(const TrialPlugins&) = delete;

  // Makes a plan for the robots, of which there is one at least. `in_force`: the plan in force, nullptr for the first.
  Plan plan(const InForce* in_force, std::int64_t step);

  // The same of the planner that [simulation] replan_fallback names, if it names one.
  bool has_fallback() const { return fallback_.instance != nullptr; }
  Plan plan_by_fallback(const InForce* in_force, std::int64_t step);

  // Updates the sensors of all active robots; at the beginning of a control tick.
  void sense();

  // A robot whose controller is asked for a command.
  struct DrivenRobot {
    std::uint32_t robot;
    Guidance guidance;
    PathUpdate new_path;
  };

  // What a controller answered: nothing if it found no command. The host then brakes.
  struct Answer {
    std::optional<dmrp_twist> command;
    std::int32_t status;
  };

  // The answers, parallel to `robots`, valid until the next call. All robots are observed before any of them is driven.
  std::span<const Answer> control(std::span<const DrivenRobot> robots, std::int64_t step);

  // The velocities of all people for the next step.
  const std::vector<dmrp_vec2>& people_velocities(std::int64_t step);

  // The trial has ended without a fault.
  void end_trial(const dmrp_trial_end& end, std::int64_t step);

  // The sensors of a robot that has a controller.
  RobotSensors& sensors(std::uint32_t robot) { return *controllers_[robot].sensors; }

  // Whether the robot has a costmap, which remembers; and makes it forget.
  bool has_costmap(std::uint32_t robot) const { return controllers_[robot].sensors->has_costmap(); }
  void clear_costmap(std::uint32_t robot) { controllers_[robot].sensors->clear_costmap(); }

  // The calls of plugins since the previous take_calls().
  std::vector<dmrp_call> take_calls() { return std::move(calls_); }

 private:
  // An instance in this trial.
  struct InstanceHandle {
    GuestInstance* instance = nullptr;
    const SentWorld* world = nullptr;
    std::uint32_t kind = 0;
    std::uint32_t first_robot = 0;  // those that a controller drives
    std::uint32_t robot_count = 0;
  };
  struct Controller {
    InstanceHandle handle;
    std::unique_ptr<RobotSensors> sensors;
    std::uint64_t revision = 0;  // of its path
    std::uint32_t read = 0;      // the sensors that it read in its last call: bits 1u << GuestQuestion::Kind
  };

  InstanceHandle start_planner(Guests& guests, const PluginUse& use, const char* purpose, std::uint64_t seed);
  void start_fallback(Guests& guests, std::uint64_t seed);
  Plan make(const PlanSource& source, const PluginInfo& info, const InForce* in_force, std::int64_t step);
  void start_controllers(Guests& guests, const PluginUse& use, std::uint64_t seed);
  InstanceHandle start(Guests& guests, const PluginUse& use, InstanceHandle handle, std::uint64_t seed,
                       std::int64_t budget_ns);
  std::string_view call(const InstanceHandle& handle, GuestRequest request);
  void record_annotations(const InstanceHandle& handle);
  const void* answer(const InstanceHandle& handle, const GuestQuestion& question, Arena& arena);
  static const void* reading(RobotSensors& sensors, std::uint32_t kind, Arena& arena);
  static SentReadings readings_of(const Controller& controller, Arena& arena);

  PlannerAnswer ask_planner(const InstanceHandle& planner, const dmrp_planning_problem& problem, std::int64_t step);
  void control_all(std::span<const DrivenRobot> robots, std::int64_t step);
  const dmrp_path_update* update_of(const DrivenRobot& robot, Arena& arena);
  void take_command(const DrivenRobot& robot, const ControlAnswer& answer, std::int64_t step);
  void note_plan(const Plan& plan);
  void note_call(std::uint32_t kind, std::uint32_t robot, const CallAnswer& answer);

  core::Lidar& lidar_of(std::uint32_t robot);

  const Experiment& experiment_;
  const VariantWorld& variant_;
  const core::World& world_;
  FirstPlan first_plan_;
  const std::int64_t step_budget_ns_;
  const PluginUse* planner_use_ = nullptr;   // nullptr without robots
  InstanceHandle planner_;                   // no instance where it is not asked
  const PluginUse* fallback_use_ = nullptr;  // nullptr without one
  InstanceHandle fallback_;
  InstanceHandle people_;  // no instance: they stand
  core::Sight sight_{world_};
  std::map<std::string, core::Lidar> lidars_;  // by type of robot
  core::TraceEncoder* scanned_trace_;          // nullptr if no scans are recorded
  core::TraceEncoder* annotated_trace_;        // nullptr if no annotations are recorded
  std::vector<Controller> controllers_;        // by robot; all with the same instance if it is central
  bool central_ = false;
  std::vector<Answer> answers_;        // of control()
  std::vector<dmrp_vec2> velocities_;  // parallel to world_.people()
  std::vector<dmrp_call> calls_;
};

}  // namespace dmrp::host
