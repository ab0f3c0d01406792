// SPDX-License-Identifier: MIT
// sensor_readings.hpp: the sensors of the robots that a controller drives, as extensions: each reading is a question to the
// judge.
#pragma once

#include <dmrp/ext/distance_field.h>
#include <dmrp/ext/lidar.h>
#include <dmrp/ext/local_costmap.h>
#include <dmrp/ext/obstacle_clusters.h>

#include <cstdint>
#include <functional>
#include <string_view>

#include "host/guests/exchange/guest_request.hpp"

namespace dmrp::host {

class SensorReadings {
 public:
  // Gives the answer of the judge; nullptr if it has none.
  using Ask = std::function<const void*(GuestQuestion::Kind kind, std::uint32_t robot)>;

  explicit SensorReadings(Ask ask);
  SensorReadings(const SensorReadings&) = delete;
  SensorReadings& operator=(const SensorReadings&) = delete;

  // The extension with this id, nullptr if it is not offered. Asking for the costmap, or for an extension derived from it,
  // subscribes the robots to the costmap.
  const void* extension(std::string_view id);

 private:
  static const void* ask(const void* self, GuestQuestion::Kind kind, std::uint32_t robot) noexcept;

  Ask ask_;
  dmrp_lidar lidar_{};
  dmrp_local_costmap costmap_{};
  dmrp_distance_field field_{};
  dmrp_obstacle_clusters clusters_{};
};

}  // namespace dmrp::host
