// SPDX-License-Identifier: MIT
// stage_extensions.hpp: the host's extensions for an instance on a stage.
#pragma once

#include <dmrp/ext/obstacle_clusters.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <string_view>
#include <vector>

#include "core/sensors/lidar.hpp"
#include "host/check/rehearsal/inputs.hpp"
#include "host/check/rehearsal/stage.hpp"
#include "host/guests/inside/annotations.hpp"
#include "host/plugins/instance.hpp"
#include "host/trial/robot_sensors.hpp"

namespace dmrp::host {

// The host's extensions, and what they return, as long as a later minor version would make them.
class GrownExtensions {
 public:
  // `grown_bytes`, a multiple of 8: by which they are longer.
  explicit GrownExtensions(std::uint32_t grown_bytes) : tables_(grown_bytes), results_(grown_bytes) {}
  GrownExtensions(const GrownExtensions&) = delete;
  GrownExtensions& operator=(const GrownExtensions&) = delete;

  // A longer copy of this extension of the host, which outlives this object. nullptr stays so.
  const void* grown(std::string_view id, const void* extension);

 private:
  // Where the functions of a copy find the host's table.
  struct Origin {
    const void* table;
    GrownExtensions* self;
  };

  // A copy of the table that has this function, which then gives longer copies of what the host's gives.
  template <auto function, class Table, class Result, class Argument>
  const void* wrapped(const Result* (*Table::*)(const Table*, Argument), const void* extension);

  template <class Result>
  const Result* longer(const Result& result) {
    return results_.one(result);
  }
  const dmrp_obstacle_cluster_list* longer(const dmrp_obstacle_cluster_list& list);

  Inputs tables_;
  Inputs results_;
  std::deque<Origin> origins_;
};

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

  CallGuard& guard_;
  const PluginInfo& info_;
  Stage& stage_;
  AnnotationBuffer annotated_{true};  // nobody reads it
  Annotations annotations_;
  core::Sight sight_;
  core::Lidar lidar_;
  std::vector<std::shared_ptr<RobotSensors>> sensors_;
  SensorReadings sensor_readings_;
  GrownExtensions grown_;
};

}  // namespace dmrp::host
