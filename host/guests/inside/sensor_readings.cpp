// SPDX-License-Identifier: MIT
#include "host/guests/inside/sensor_readings.hpp"

#include <utility>

namespace dmrp::host {

SensorReadings::SensorReadings(Ask ask) : ask_(std::move(ask)) {
  lidar_ = {sizeof(lidar_), 0, this, [](const dmrp_lidar* self, std::uint32_t robot) noexcept {
              return static_cast<const dmrp_scan*>(SensorReadings::ask(self->context, GuestQuestion::scan, robot));
            }};
  costmap_ = {
      sizeof(costmap_), 0, this, [](const dmrp_local_costmap* self, std::uint32_t robot) noexcept {
        return static_cast<const dmrp_costmap*>(SensorReadings::ask(self->context, GuestQuestion::costmap, robot));
      }};
  field_ = {
      sizeof(field_), 0, this, [](const dmrp_distance_field* self, std::uint32_t robot) noexcept {
        return static_cast<const dmrp_field*>(SensorReadings::ask(self->context, GuestQuestion::distance_field, robot));
      }};
  clusters_ = {sizeof(clusters_), 0, this, [](const dmrp_obstacle_clusters* self, std::uint32_t robot) noexcept {
                 return static_cast<const dmrp_obstacle_cluster_list*>(
                     SensorReadings::ask(self->context, GuestQuestion::clusters, robot));
               }};
}

const void* SensorReadings::ask(const void* self, GuestQuestion::Kind kind, std::uint32_t robot) noexcept {
  try {
    return static_cast<const SensorReadings*>(self)->ask_(kind, robot);
  } catch (...) {  // out of memory
    return nullptr;
  }
}

const void* SensorReadings::extension(std::string_view id) {
  if (id == DMRP_EXT_LIDAR) return &lidar_;
  const void* of_costmap = nullptr;
  if (id == DMRP_EXT_LOCAL_COSTMAP) of_costmap = &costmap_;
  if (id == DMRP_EXT_DISTANCE_FIELD) of_costmap = &field_;
  if (id == DMRP_EXT_OBSTACLE_CLUSTERS) of_costmap = &clusters_;
  if (of_costmap) ask_(GuestQuestion::subscribe_to_costmap, 0);
  return of_costmap;
}

}  // namespace dmrp::host
