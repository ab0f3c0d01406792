// SPDX-License-Identifier: MIT
// cast.hpp: the plugins that play in one trial, each entered through its guarded call.
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

class Cast {
 public:
  // Takes the combination's instances from the pool and starts them for this trial; what they say goes to `trace`.
  // Throws PluginFault.
  Cast(InstancePool& pool, const Experiment& experiment, const Combination& combination, const VariantWorld& variant,
       const core::World& world, std::uint64_t seed, core::TraceEncoder& trace);
  Cast(const Cast&) = delete;
  Cast& operator=(const Cast&) = delete;

  // Plans from where the robots are, of which there is one at least; `in_force`: what holds meanwhile, nullptr for the
  // first plan.
  Plan plan(const InForce* in_force, std::int64_t step);

  // Hands a robot's controller a path.
  void set_path(std::uint32_t robot, std::span<const dmrp_waypoint> waypoints, std::int64_t step);

  // A control tick begins: sensors look.
  void sense();

  // The next command of a robot; nothing where its controller found none, and the host brakes.
  std::optional<dmrp_twist> drive(std::uint32_t robot, const Guidance& guidance, std::int64_t step);

  // Velocities of all people for the next step.
  const std::vector<dmrp_vec2>& walk(std::int64_t step);

  // The calls since the last time it was asked.
  std::vector<dmrp_call> take_calls() { return std::move(calls_); }

 private:
  void start_planner(const Combination& combination, InstancePool& pool, std::uint64_t seed);
  void start_controllers(const Combination& combination, InstancePool& pool, std::uint64_t seed);
  void start_pedestrian_model(const Combination& combination, InstancePool& pool, std::uint64_t seed);

  // Gives an instance the annotations besides the robot's sensors, if any.
  void offer(Instance& instance, core::AnnotationSource source, const std::shared_ptr<RobotSensors>& sensors);
  void note_call(std::uint32_t kind, std::uint32_t robot, const CallGuard::Result& result);

  const Experiment& experiment_;
  const VariantWorld& variant_;
  const core::World& world_;
  const PluginUse* planner_use_ = nullptr;  // these two: nullptr where there are no robots
  Instance* planner_ = nullptr;
  Instance* pedestrian_model_ = nullptr;
  struct Driver {
    Instance* controller;
    std::shared_ptr<RobotSensors> sensors;
    dmrp_world view;
    dmrp_local_controller table;
    std::uint64_t paths = 0;  // handed over so far
  };
  core::Lidar lidar_;
  core::TraceEncoder* scanned_trace_;    // nullptr where no scans are kept
  core::TraceEncoder* annotated_trace_;  // nullptr where no annotations are kept
  std::vector<std::shared_ptr<Annotations>> annotations_;
  std::vector<Driver> drivers_;
  dmrp_pedestrian_model pedestrian_table_{};
  std::vector<dmrp_vec2> velocities_;  // parallel to world_.people()
  std::vector<dmrp_call> calls_;
};

}  // namespace dmrp::host
