// SPDX-License-Identifier: MIT
// robot_sensors.hpp: the sensors of one robot.
#pragma once

#include <dmrp/ext/distance_field.h>
#include <dmrp/ext/lidar.h>
#include <dmrp/ext/local_costmap.h>
#include <dmrp/ext/obstacle_clusters.h>

#include <memory>
#include <vector>

#include "core/sensors/costmap.hpp"
#include "core/sensors/lidar.hpp"
#include "core/sensors/obstacle_clusters.hpp"
#include "core/sensors/odometry.hpp"
#include "core/sensors/visibility.hpp"
#include "core/world/world.hpp"
#include "host/guests/inside/sensor_readings.hpp"

namespace dmrp::host {

// One robot's sensors in one trial, computed on demand: scans, distance field and obstacle clusters when they are read;
// the costmap, which accumulates scans, on every scan once it is subscribed to.
class RobotSensors {
 public:
  // `sight` and `lidar` outlive it; all robots share them. `seed` is the trial's.
  RobotSensors(core::Sight& sight, std::uint32_t robot, core::Lidar& lidar, std::uint64_t seed);
  RobotSensors(const RobotSensors&) = delete;
  RobotSensors& operator=(const RobotSensors&) = delete;

  // From now on every scan is entered into the costmap, which the readings below the scan need.
  void subscribe_to_costmap();

  bool has_costmap() const { return costmap_ != nullptr; }

  // Forgets all earlier scans.
  void clear_costmap();

  // A control tick begins: earlier readings are out of date.
  void tick();

  // The robot's estimate of its pose and velocity, to which all other readings are relative.
  const core::Odometry& odometry() const { return odometry_; }

  // The lidar's scan; the same for the whole tick.
  const dmrp_scan& scan();

  // The robots and people that the robot perceives, as in its observation.
  const std::vector<dmrp_agent>& agents();

  const dmrp_costmap& costmap() const { return costmap_->costmap(); }
  const dmrp_field& distance_field() { return costmap_->distance_field(); }
  const dmrp_obstacle_cluster_list& clusters();

 private:
  core::Sight& sight_;
  const core::World& world_;
  std::uint32_t robot_;
  core::Lidar& lidar_;
  std::uint64_t seed_;
  core::Odometry odometry_;
  std::vector<float> ranges_;
  dmrp_scan scan_{};
  bool scan_is_fresh_ = false;
  std::vector<dmrp_agent> agents_;
  bool agents_are_fresh_ = false;
  std::unique_ptr<core::LocalCostmap> costmap_;  // nullptr until somebody subscribes
  core::ObstacleClusters clusters_;
  const dmrp_obstacle_cluster_list* fresh_clusters_ = nullptr;
};

// Answers in place of a judge: readings of these sensors, by robot; nullptr for a robot that the instance does not drive.
SensorReadings::Ask readings_of(std::vector<std::shared_ptr<RobotSensors>> sensors);

}  // namespace dmrp::host
