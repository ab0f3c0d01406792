// SPDX-License-Identifier: MIT
// robot_sensors.hpp: what a robot perceives, as the extensions that its controller asks for.
#pragma once

#include <dmrp/ext/distance_field.h>
#include <dmrp/ext/lidar.h>
#include <dmrp/ext/local_costmap.h>

#include <memory>
#include <string>
#include <vector>

#include "core/costmap.hpp"
#include "core/lidar.hpp"
#include "core/world.hpp"

namespace dmrp::host {

// The ids of the extensions that this host offers to local controllers.
inline const std::vector<std::string>& offered_extensions() {
  static const std::vector<std::string> ids = {DMRP_EXT_LIDAR, DMRP_EXT_LOCAL_COSTMAP, DMRP_EXT_DISTANCE_FIELD};
  return ids;
}

// One robot's sensors in one trial. Nothing is computed that nobody asked for: scans when they are read, the costmap
// on every scan from the moment it is subscribed to (it has a history), its distance field when it is read.
class RobotSensors {
 public:
  // `world` and `lidar` outlive it; the lidar serves all robots.
  RobotSensors(const core::World& world, std::uint32_t robot, core::Lidar& lidar);
  RobotSensors(const RobotSensors&) = delete;
  RobotSensors& operator=(const RobotSensors&) = delete;

  // The extension behind an id, nullptr if it is not offered. Asking for the costmap or its field subscribes to it.
  const void* extension(const std::string& id);

  // A control tick begins: what was read before is out of date.
  void tick();

 private:
  const dmrp_scan& scan();

  const core::World& world_;
  std::uint32_t robot_;
  core::Lidar& lidar_;
  std::vector<float> ranges_;
  dmrp_scan scan_{};
  bool scan_is_fresh_ = false;
  std::unique_ptr<core::LocalCostmap> costmap_;  // there once somebody has subscribed
  dmrp_lidar lidar_extension_{};
  dmrp_local_costmap costmap_extension_{};
  dmrp_distance_field field_extension_{};
};

}  // namespace dmrp::host
