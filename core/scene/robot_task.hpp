// SPDX-License-Identifier: MIT
// robot_task.hpp: a robot's task and settings in the terms of the plugin contract.
#pragma once

#include <dmrp/robot.h>

#include <vector>

#include "core/scene/scenario.hpp"
#include "core/scene/settings.hpp"

namespace dmrp::core {

dmrp_limits limits_of(const RobotSettings& settings);
dmrp_footprint footprint_of(const RobotSettings& settings);
std::vector<dmrp_goal> goals_of(const RobotTask& task, const GoalSettings& settings);

// The start with its heading filled in: along the dominant axis toward the first goal where it is free.
dmrp_pose start_of(const RobotTask& task);

}  // namespace dmrp::core
