// SPDX-License-Identifier: MIT
#include "core/scene/robot_task.hpp"

#include <cmath>
#include <numbers>

namespace dmrp::core {

dmrp_limits limits_of(const RobotSettings& settings) {
  dmrp_limits limits{};
  limits.struct_size = sizeof(limits);
  limits.v_min = settings.v_min;
  limits.v_max = settings.v_max;
  limits.omega_max = settings.omega_max;
  limits.a_max = settings.a_max;
  limits.alpha_max = settings.alpha_max;
  return limits;
}

dmrp_footprint footprint_of(const RobotSettings& settings) {
  dmrp_footprint footprint{};
  footprint.struct_size = sizeof(footprint);
  footprint.radius_m = settings.radius_m;
  footprint.inscribed_radius_m = settings.radius_m;
  return footprint;
}

std::vector<dmrp_goal> goals_of(const RobotTask& task, const GoalSettings& settings) {
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
