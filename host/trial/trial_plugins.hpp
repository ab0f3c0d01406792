// SPDX-License-Identifier: MIT
// trial_plugins.hpp: the plugins of one trial; every call goes through the call guard.
#pragma once

#include <dmrp/local_controller.h>
#include <dmrp/metric.h>
#include <dmrp/pedestrian_model.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/sensors/lidar.hpp"
#include "core/world/world.hpp"
#include "host/trial/annotations.hpp"
#include "host/trial/dispatcher.hpp"
#include "host/trial/instance_pool.hpp"
#include "host/trial/planning.hpp"
#include "host/trial/robot_sensors.hpp"
#include "host/trial/variant_world.hpp"

namespace dmrp::host {

class TrialPlugins {
 public:
  // Takes the combination's instances from the pool and starts them for this trial. Their annotations go to `trace`. All
  // functions throw PluginFault.
  TrialPlugins(InstancePool& pool, const Experiment& experiment, const Combination& combination,
               const VariantWorld& variant, const core::World& world, std::uint64_t seed, core::TraceEncoder& trace);
  TrialPlugins(const TrialPlugins&) = delete;
  TrialPlugins& operator=(const TrialPlugins&) = delete;

  // Makes a plan for the robots, of which there is one at least. `in_force`: the plan in force, nullptr for the first.
  Plan plan(const InForce* in_force, std::int64_t step);

  // Passes a path to a robot's controller.
  void set_path(std::uint32_t robot, std::span<const dmrp_waypoint> waypoints, std::int64_t step);

  // Updates the sensors of all active robots; at the beginning of a control tick.
  void sense();

  // The next command of a robot. Nothing if its controller found none: the host then brakes.
  std::optional<dmrp_twist> control(std::uint32_t robot, const Guidance& guidance, std::int64_t step);

  // The velocities of all people for the next step.
  const std::vector<dmrp_vec2>& people_velocities(std::int64_t step);

  // The calls of plugins since the previous take_calls().
  std::vector<dmrp_call> take_calls() { return std::move(calls_); }

 private:
  void start_planner(const Combination& combination, InstancePool& pool, std::uint64_t seed);
  void start_controllers(const Combination& combination, InstancePool& pool, std::uint64_t seed);
  void start_pedestrian_model(const Combination& combination, InstancePool& pool, std::uint64_t seed);

  // Offers an instance the extension for annotations and, for a controller, those of the robot's sensors.
  void offer(Instance& instance, core::AnnotationSource source, const std::shared_ptr<RobotSensors>& sensors);
  dmrp_observation observation(std::uint32_t robot, const Guidance& guidance) const;
  void note_call(std::uint32_t kind, std::uint32_t robot, const CallGuard::Result& result);

  const Experiment& experiment_;
  const VariantWorld& variant_;
  const core::World& world_;
  const PluginUse* planner_use_ = nullptr;  // nullptr without robots, as planner_
  Instance* planner_ = nullptr;
  Instance* pedestrian_model_ = nullptr;
  struct Controller {
    Instance* instance;
    std::shared_ptr<RobotSensors> sensors;
    dmrp_world view;
    dmrp_local_controller table;
    std::uint64_t revision = 0;  // of its path
  };
  core::Lidar lidar_;
  core::TraceEncoder* scanned_trace_;    // nullptr if no scans are recorded
  core::TraceEncoder* annotated_trace_;  // nullptr if no annotations are recorded
  std::vector<std::shared_ptr<Annotations>> annotations_;
  std::vector<Controller> controllers_;
  dmrp_pedestrian_model pedestrian_table_{};
  std::vector<dmrp_vec2> velocities_;  // parallel to world_.people()
  std::vector<dmrp_call> calls_;
};

}  // namespace dmrp::host
