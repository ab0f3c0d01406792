// SPDX-License-Identifier: MIT
// sensor_extensions.hpp: the sensors of the robots that one controller instance drives, as extensions.
#pragma once

#include <dmrp/ext/distance_field.h>
#include <dmrp/ext/lidar.h>
#include <dmrp/ext/local_costmap.h>
#include <dmrp/ext/obstacle_clusters.h>

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "host/trial/robot_sensors.hpp"

namespace dmrp::host {

class SensorExtensions {
 public:
  // `sensors`: by robot; nullptr for a robot that the instance does not drive.
  explicit SensorExtensions(std::vector<std::shared_ptr<RobotSensors>> sensors);
  SensorExtensions(const SensorExtensions&) = delete;
  SensorExtensions& operator=(const SensorExtensions&) = delete;

  // The extension with this id, nullptr if it is not offered. Asking for the costmap, or for an extension derived from it,
  // subscribes the robots to the costmap.
  const void* extension(std::string_view id);

 private:
  // The sensors of a robot of `self`; nullptr for a robot that the instance does not drive.
  static RobotSensors* of(void* self, std::uint32_t robot);
  void subscribe_to_costmap();

  std::vector<std::shared_ptr<RobotSensors>> sensors_;
  dmrp_lidar lidar_{};
  dmrp_local_costmap costmap_{};
  dmrp_distance_field field_{};
  dmrp_obstacle_clusters clusters_{};
};

}  // namespace dmrp::host
