// SPDX-License-Identifier: MIT
#include "host/trial/sensor_extensions.hpp"

namespace dmrp::host {

namespace {

// `reading` of the sensors of a robot; nullptr without sensors, or if it runs out of memory.
template <class Reading>
auto read(RobotSensors* sensors, Reading&& reading) noexcept -> decltype(&reading(*sensors)) {
  try {
    return sensors ? &reading(*sensors) : nullptr;
  } catch (...) {
    return nullptr;
  }
}

}  // namespace

SensorExtensions::SensorExtensions(std::vector<std::shared_ptr<RobotSensors>> sensors) : sensors_(std::move(sensors)) {
  lidar_ = {sizeof(lidar_), 0, this, [](const dmrp_lidar* self, std::uint32_t robot) noexcept -> const dmrp_scan* {
              return read(of(self->context, robot), [](RobotSensors& s) -> const dmrp_scan& { return s.scan(); });
            }};
  costmap_ = {sizeof(costmap_), 0, this,
              [](const dmrp_local_costmap* self, std::uint32_t robot) noexcept -> const dmrp_costmap* {
                return read(of(self->context, robot),
                            [](RobotSensors& s) -> const dmrp_costmap& { return s.costmap(); });
              }};
  field_ = {
      sizeof(field_), 0, this, [](const dmrp_distance_field* self, std::uint32_t robot) noexcept -> const dmrp_field* {
        return read(of(self->context, robot), [](RobotSensors& s) -> const dmrp_field& { return s.distance_field(); });
      }};
  clusters_ = {
      sizeof(clusters_), 0, this,
      [](const dmrp_obstacle_clusters* self, std::uint32_t robot) noexcept -> const dmrp_obstacle_cluster_list* {
        return read(of(self->context, robot),
                    [](RobotSensors& s) -> const dmrp_obstacle_cluster_list& { return s.clusters(); });
      }};
}

RobotSensors* SensorExtensions::of(void* self, std::uint32_t robot) {
  const auto& sensors = static_cast<SensorExtensions*>(self)->sensors_;
  return robot < sensors.size() ? sensors[robot].get() : nullptr;
}

void SensorExtensions::subscribe_to_costmap() {
  for (const auto& sensors : sensors_)
    if (sensors) sensors->subscribe_to_costmap();
}

const void* SensorExtensions::extension(std::string_view id) {
  if (id == DMRP_EXT_LIDAR) return &lidar_;
  const void* of_costmap = nullptr;
  if (id == DMRP_EXT_LOCAL_COSTMAP) of_costmap = &costmap_;
  if (id == DMRP_EXT_DISTANCE_FIELD) of_costmap = &field_;
  if (id == DMRP_EXT_OBSTACLE_CLUSTERS) of_costmap = &clusters_;
  if (of_costmap) subscribe_to_costmap();
  return of_costmap;
}

}  // namespace dmrp::host
