// SPDX-License-Identifier: MIT
// robot_sensors.hpp: what a robot perceives, as the extensions that its controller asks for.
#pragma once

#include <dmrp/ext/distance_field.h>
#include <dmrp/ext/lidar.h>
#include <dmrp/ext/local_costmap.h>
#include <dmrp/ext/obstacle_clusters.h>

#include <memory>
#include <string>
#include <vector>

#include "core/sensors/costmap.hpp"
#include "core/sensors/lidar.hpp"
#include "core/sensors/obstacle_clusters.hpp"
#include "core/sensors/odometry.hpp"
#include "core/world/world.hpp"

namespace dmrp::host {

// One robot's sensors in one trial. Nothing is computed that nobody asked for: scans when they are read, the costmap
// on every scan from the moment it is subscribed to (it has a history), its distance field and the obstacles' clusters
// when they are read.
class RobotSensors {
 public:
  // `world` and `lidar` outlive it; the lidar serves all robots. `seed` is the trial's.
  RobotSensors(const core::World& world, std::uint32_t robot, core::Lidar& lidar, std::uint64_t seed);
  RobotSensors(const RobotSensors&) = delete;
  RobotSensors& operator=(const RobotSensors&) = delete;

  // The extension behind an id, nullptr if it is not offered. Asking for the costmap or what is derived from it
  // subscribes to it.
  const void* extension(const std::string& id);

  // A control tick begins: what was read before is out of date.
  void tick();

  // Where the robot believes it is and how fast; all that it is told of lies about it there.
  const core::Odometry& odometry() const { return odometry_; }

  // What its lidar sees; the same however often it is asked for.
  const dmrp_scan& scan();

  // The others that the robot is told of, as in its observation.
  const std::vector<dmrp_agent>& agents();

 private:
  const dmrp_obstacle_cluster_list& clusters();

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
  std::unique_ptr<core::LocalCostmap> costmap_;  // there once somebody has subscribed
  core::ObstacleClusters clusters_;
  const dmrp_obstacle_cluster_list* fresh_clusters_ = nullptr;
  dmrp_lidar lidar_extension_{};
  dmrp_local_costmap costmap_extension_{};
  dmrp_distance_field field_extension_{};
  dmrp_obstacle_clusters clusters_extension_{};
};

}  // namespace dmrp::host
