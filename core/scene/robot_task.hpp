// SPDX-License-Identifier: MIT
// robot_task.hpp: converts a robot's task and settings to the structs of the plugin contract.
#pragma once

#include <dmrp/robot.h>

#include <span>
#include <vector>

#include "core/scene/scenario.hpp"
#include "core/scene/settings.hpp"

namespace dmrp::core {

dmrp_limits limits_of(const RobotSettings& settings);

// Views of the footprint's parts, and the footprint with them; they point into their arguments.
std::vector<dmrp_polygon> polygons_of(const RobotSettings& settings);
dmrp_footprint footprint_of(const RobotSettings& settings, std::span<const dmrp_polygon> polygons);

std::vector<dmrp_goal> goals_of(const RobotTask& task, const GoalSettings& settings);

// The start pose. A free heading is set along the dominant axis towards the first goal.
dmrp_pose start_of(const RobotTask& task);

}  // namespace dmrp::core
