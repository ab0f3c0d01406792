// SPDX-License-Identifier: MIT
#include "core/scene/robot_task.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

#include "core/scene/footprint.hpp"

namespace dmrp::core {

dmrp_limits limits_of(const RobotSettings& settings) {
  dmrp_limits limits{};
  limits.struct_size = sizeof(limits);
  limits.v_min = settings.v_min;
  limits.v_max = settings.v_max;
  limits.omega_max = settings.omega_max;
  limits.a_max = settings.a_max;
  limits.alpha_max = settings.alpha_max;
  if (settings.drive == Drive::holonomic) limits.v_y_max = settings.v_y_max;
  if (settings.drive == Drive::ackermann) {
    limits.wheelbase_m = settings.wheelbase_m;
    limits.steering_max = settings.steering_max;
    limits.steering_rate_max = settings.steering_rate_max;
  }
  return limits;
}

std::vector<dmrp_polygon> polygons_of(const RobotSettings& settings) {
  std::vector<dmrp_polygon> polygons;
  for (const ConvexPolygon& part : settings.parts)
    polygons.push_back({part.data(), static_cast<std::uint32_t>(part.size()), 0});
  return polygons;
}

dmrp_footprint footprint_of(const RobotSettings& settings, std::span<const dmrp_polygon> polygons) {
  assert(polygons.size() == settings.parts.size());
  dmrp_footprint footprint{};
  footprint.struct_size = sizeof(footprint);
  footprint.part_count = static_cast<std::uint32_t>(polygons.size());
  footprint.radius_m = settings.radius_m;
  footprint.inscribed_radius_m = inscribed_radius(settings);
  footprint.parts = polygons.empty() ? nullptr : polygons.data();
  footprint.part_stride = polygons.empty() ? 0 : sizeof(dmrp_polygon);
  return footprint;
}

std::vector<dmrp_goal> goals_of(const RobotTask& task, const GoalSettings& settings) {
  assert(!task.goals.empty());
  std::vector<dmrp_goal> goals;
  for (const dmrp_pose& pose : task.goals) {
    goals.push_back({pose, settings.tolerance_m, settings.tolerance_rad, settings.tolerance_speed,
                     std::llround(settings.settle_s * 1e9)});
  }
  return goals;
}

dmrp_pose start_of(const RobotTask& task) {
  dmrp_pose start = task.start;
  if (!std::isnan(start.theta) || task.goals.empty()) return start;
  const double dx = task.goals.front().x - start.x;
  const double dy = task.goals.front().y - start.y;
  if (std::abs(dx) >= std::abs(dy)) {
    start.theta = dx >= 0.0 ? 0.0 : std::numbers::pi;
  } else {
    start.theta = dy >= 0.0 ? 0.5 * std::numbers::pi : -0.5 * std::numbers::pi;
  }
  return start;
}

}  // namespace dmrp::core
