// SPDX-License-Identifier: MIT
// trial_plugins.hpp: the plugins of one trial; every call goes through the call guard.
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
#include "core/world/world.hpp"
#include "host/plugins/calls/input_copy.hpp"
#include "host/plugins/calls/output.hpp"
#include "host/trial/annotations.hpp"
#include "host/trial/crowd_model.hpp"
#include "host/trial/dispatcher.hpp"
#include "host/trial/instance_pool.hpp"
#include "host/trial/plans/planning.hpp"
#include "host/trial/robot_sensors.hpp"
#include "host/trial/sensor_extensions.hpp"
#include "host/trial/world/variant_world.hpp"

namespace dmrp::host {

// An active robot and its part of the plan.
struct GuidedRobot {
  std::uint32_t robot;
  Guidance guidance;
};

// The first plan of a trial, if it is there already: then the planner is not asked for it.
struct FirstPlan {
  const PlannerAnswer* given = nullptr;
  std::function<void(const PlannerAnswer&)> on_made;  // called with a valid plan, or none, of the planner; may be empty
};

class TrialPlugins {
 public:
  // Takes the combination's instances from the pool and starts them for this trial: the planner only if it is asked for
  // a plan, or annotates. Their annotations go to `trace`. All functions throw PluginFault.
  TrialPlugins(InstancePool& pool, const Experiment& experiment, const Combination& combination,
               const VariantWorld& variant, const core::World& world, std::uint64_t seed, core::TraceEncoder& trace,
               FirstPlan first_plan = {});
  TrialPlugins(const TrialPlugins&) = delete;
  TrialPlugins& operator=(const TrialPlugins&) = delete;

  // Makes a plan for the robots, of which there is one at least. `in_force`: the plan in force, nullptr for the first.
  Plan plan(const InForce* in_force, std::int64_t step);

  // Passes a path to a robot's controller.
  void set_path(std::uint32_t robot, std::span<const dmrp_waypoint> waypoints, std::int64_t step);

  // Updates the sensors of all active robots; at the beginning of a control tick.
  void sense();

  // Whether one controller instance drives all robots: then control_all() takes the place of control().
  bool has_central_controller() const { return central_; }

  // The next command of a robot. Nothing if its controller found none: the host then brakes.
  std::optional<dmrp_twist> control(std::uint32_t robot, const Guidance& guidance, std::int64_t step);

  // The next commands of all active robots, parallel to `robots`, valid until the next call.
  std::span<const std::optional<dmrp_twist>> control_all(std::span<const GuidedRobot> robots, std::int64_t step);

  // The velocities of all people for the next step.
  const std::vector<dmrp_vec2>& people_velocities(std::int64_t step);

  // The trial has ended without a fault.
  void end_trial(const dmrp_trial_end& end, std::int64_t step);

  // The command of a robot was beyond its drive's ability.
  void note_clipped(std::uint32_t robot) { calls_.push_back({DMRP_CALL_CLIPPED, robot, DMRP_OK, 0, 0}); }

  // The robot's recovery began a step, or ended: DMRP_RECOVERY_*.
  void note_recovery(std::uint32_t robot, std::int32_t step) {
    calls_.push_back({DMRP_CALL_RECOVERY, robot, step, 0, 0});
  }

  // Whether the robot has a costmap, which remembers; and makes it forget.
  bool has_costmap(std::uint32_t robot) const { return controllers_[robot].sensors->has_costmap(); }
  void clear_costmap(std::uint32_t robot) { controllers_[robot].sensors->clear_costmap(); }

  // The calls of plugins since the previous take_calls().
  std::vector<dmrp_call> take_calls() { return std::move(calls_); }

 private:
  void start_planner(InstancePool& pool, std::uint64_t seed);
  void start_controllers(const Combination& combination, InstancePool& pool, std::uint64_t seed);
  void start_pedestrian_model(const Combination& combination, InstancePool& pool, std::uint64_t seed);
  Instance& start_crowd(const Combination& combination, InstancePool& pool, std::uint64_t seed,
                        core::TraceEncoder* annotated_trace);

  core::Lidar& lidar_of(std::uint32_t robot);

  // Offer an instance its extensions.
  void offer(Instance& instance, std::uint32_t kind, core::TraceEncoder* annotated_trace);
  void offer_to_controller(Instance& instance, std::uint32_t first_robot, std::uint32_t robot_count);
  void copy_input(std::span<const dmrp_observation> observations);
  void copy_world();
  dmrp_twist checked(std::uint32_t robot, const dmrp_command& command, const char* function, std::int64_t step) const;
  void note_call(std::uint32_t kind, std::uint32_t robot, const CallGuard::Result& result);

  const Experiment& experiment_;
  const VariantWorld& variant_;
  const core::World& world_;
  FirstPlan first_plan_;
  const PluginUse* planner_use_ = nullptr;  // nullptr without robots
  Instance* planner_ = nullptr;             // nullptr where it is not asked
  Instance* pedestrian_model_ = nullptr;
  struct Controller {
    Instance* instance;
    std::shared_ptr<RobotSensors> sensors;
    dmrp_local_controller table;
    std::uint64_t revision = 0;  // of its path
  };
  std::map<std::string, core::Lidar> lidars_;  // by type of robot
  core::TraceEncoder* scanned_trace_;          // nullptr if no scans are recorded
  core::TraceEncoder* annotated_trace_;        // nullptr if no annotations are recorded
  std::vector<std::shared_ptr<Annotations>> annotations_;
  std::vector<std::shared_ptr<SensorExtensions>> sensor_extensions_;
  std::vector<Controller> controllers_;  // by robot; all with the same instance if it is central
  bool central_ = false;
  InputCopy input_;  // of the call that runs
  InputCopy world_input_;
  Output<dmrp_command> command_;
  std::vector<dmrp_observation> observations_;  // of control_all(), as the next two
  OutputArray<dmrp_command> commands_;
  std::vector<std::optional<dmrp_twist>> twists_;
  std::optional<CrowdModel> crowd_;  // of pedestrian_model_
  std::vector<dmrp_vec2> at_rest_;   // without a model; parallel to world_.people()
  std::vector<dmrp_call> calls_;
};

}  // namespace dmrp::host
