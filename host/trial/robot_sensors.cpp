// SPDX-License-Identifier: MIT
#include "host/trial/robot_sensors.hpp"

#include "core/scene/footprint.hpp"
#include "core/sensors/sensor_noise.hpp"

namespace dmrp::host {

RobotSensors::RobotSensors(core::Sight& sight, std::uint32_t robot, core::Lidar& lidar, std::uint64_t seed)
    : sight_(sight),
      world_(sight.world()),
      robot_(robot),
      lidar_(lidar),
      seed_(seed),
      odometry_(world_.robot_settings(robot).odometry, seed, robot, world_.robots()[robot].pose,
                world_.robot_settings(robot).drive),
      ranges_(lidar.beams()) {}

void RobotSensors::subscribe_to_costmap() {
  if (costmap_) return;
  const core::RobotSettings& robot = world_.robot_settings(robot_);
  costmap_ =
      std::make_unique<core::LocalCostmap>(robot.costmap, core::inscribed_radius(robot), robot.lidar.dropout_share);
  costmap_->update(odometry_.pose(), scan());
}

void RobotSensors::clear_costmap() {
  costmap_->reset();
  costmap_->update(odometry_.pose(), scan());
  fresh_clusters_ = nullptr;
}

void RobotSensors::tick() {
  odometry_.read(world_.t_ns(), world_.robots()[robot_].pose, world_.robots()[robot_].velocity);
  scan_is_fresh_ = false;
  agents_are_fresh_ = false;
  fresh_clusters_ = nullptr;
  if (costmap_) costmap_->update(odometry_.pose(), scan());
}

const dmrp_scan& RobotSensors::scan() {
  if (!scan_is_fresh_) {
    sight_.scan_from(robot_, lidar_, ranges_);
    core::disturb_scan(world_.robot_settings(robot_).lidar, {seed_, robot_, world_.t_ns()}, ranges_);
    scan_ = lidar_.describe(world_.t_ns(), ranges_);
    scan_is_fresh_ = true;
  }
  return scan_;
}

const std::vector<dmrp_agent>& RobotSensors::agents() {
  if (!agents_are_fresh_) {
    sight_.visible_agents(robot_, agents_);
    core::disturb_agents(world_.settings().tracking_velocity_noise_sd, {seed_, robot_, world_.t_ns()}, agents_);
    for (dmrp_agent& agent : agents_) {
      agent.pose = odometry_.to_estimated(agent.pose);
      agent.velocity = odometry_.direction_to_estimated(agent.velocity);
    }
    agents_are_fresh_ = true;
  }
  return agents_;
}

const dmrp_obstacle_cluster_list& RobotSensors::clusters() {
  if (!fresh_clusters_) fresh_clusters_ = &clusters_.derive(costmap_->costmap(), agents());
  return *fresh_clusters_;
}

SensorReadings::Ask readings_of(std::vector<std::shared_ptr<RobotSensors>> sensors) {
  return [sensors = std::move(sensors)](GuestQuestion::Kind kind, std::uint32_t robot) -> const void* {
    if (kind == GuestQuestion::subscribe_to_costmap)
      for (const auto& one : sensors)
        if (one) one->subscribe_to_costmap();
    RobotSensors* const own = robot < sensors.size() ? sensors[robot].get() : nullptr;
    if (!own) return nullptr;
    switch (kind) {
      case GuestQuestion::scan:
        return &own->scan();
      case GuestQuestion::costmap:
        return &own->costmap();
      case GuestQuestion::distance_field:
        return &own->distance_field();
      case GuestQuestion::clusters:
        return &own->clusters();
      default:
        return nullptr;
    }
  };
}

}  // namespace dmrp::host
