// SPDX-License-Identifier: MIT
// stage_extensions.hpp: the host's extensions for an instance on a stage.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "core/sensors/lidar.hpp"
#include "host/check/rehearsal/grown_extensions.hpp"
#include "host/check/rehearsal/stage.hpp"
#include "host/guests/inside/annotations.hpp"
#include "host/plugins/instance.hpp"
#include "host/trial/robot_sensors.hpp"

namespace dmrp::host {

class StageExtensions {
 public:
  // Offers them to the instance, which must not ask for any once this object is gone. `robots`: those that the instance,
  // if it is a controller, drives.
  StageExtensions(Instance& instance, const PluginInfo& info, Stage& stage, std::uint32_t robots);
  StageExtensions(const StageExtensions&) = delete;
  StageExtensions& operator=(const StageExtensions&) = delete;

  RobotSensors& sensors(std::uint32_t robot) { return *sensors_[robot]; }

 private:
  const void* find(std::string_view id);
  const void* own(std::string_view id);

  const PluginInfo& info_;
  Stage& stage_;
  AnnotationBuffer annotated_{true};  // nobody reads it
  Annotations annotations_;
  core::Lidar lidar_;
  std::vector<std::shared_ptr<RobotSensors>> sensors_;
  SensorReadings sensor_readings_;
  GrownExtensions grown_;
};

}  // namespace dmrp::host
