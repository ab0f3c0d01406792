// SPDX-License-Identifier: MIT
#include "host/trial/robot_sensors.hpp"

#include "core/sensing.hpp"

namespace dmrp::host {

RobotSensors::RobotSensors(const core::World& world, std::uint32_t robot, core::Lidar& lidar)
    : world_(world), robot_(robot), lidar_(lidar), ranges_(lidar.beams()) {
  lidar_extension_ = {sizeof(dmrp_lidar), 0, this, [](const dmrp_lidar* self) -> const dmrp_scan* {
                        return &static_cast<RobotSensors*>(self->context)->scan();
                      }};
  costmap_extension_ = {sizeof(dmrp_local_costmap), 0, this, [](const dmrp_local_costmap* self) -> const dmrp_costmap* {
                          return &static_cast<RobotSensors*>(self->context)->costmap_->costmap();
                        }};
  field_extension_ = {sizeof(dmrp_distance_field), 0, this, [](const dmrp_distance_field* self) -> const dmrp_field* {
                        return &static_cast<RobotSensors*>(self->context)->costmap_->distance_field();
                      }};
}

const void* RobotSensors::extension(const std::string& id) {
  if (id == DMRP_EXT_LIDAR) return &lidar_extension_;
  if (id != DMRP_EXT_LOCAL_COSTMAP && id != DMRP_EXT_DISTANCE_FIELD) return nullptr;
  if (!costmap_) {
    costmap_ = std::make_unique<core::LocalCostmap>(world_.robot_settings().costmap, world_.robot_settings().radius_m);
    costmap_->update(world_.robots()[robot_].pose, scan());
  }
  return id == DMRP_EXT_LOCAL_COSTMAP ? static_cast<const void*>(&costmap_extension_) : &field_extension_;
}

void RobotSensors::tick() {
  scan_is_fresh_ = false;
  if (costmap_) costmap_->update(world_.robots()[robot_].pose, scan());
}

const dmrp_scan& RobotSensors::scan() {
  if (!scan_is_fresh_) {
    core::scan_from(world_, robot_, lidar_, ranges_);
    scan_ = lidar_.describe(world_.t_ns(), ranges_);
    scan_is_fresh_ = true;
  }
  return scan_;
}

}  // namespace dmrp::host
