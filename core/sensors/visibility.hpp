// SPDX-License-Identifier: MIT
// visibility.hpp: the scans and visible agents of the robots in a world.
#pragma once

#include <dmrp/observation.h>

#include <cstdint>
#include <span>
#include <vector>

#include "core/sensors/lidar.hpp"
#include "core/world/world.hpp"

namespace dmrp::core {

// Scans the world from a robot's true pose.
void scan_from(const World& world, std::uint32_t robot, Lidar& lidar, std::span<float> ranges);

// The other agents that this robot observes with the `tracking` of the world's settings, ordered by kind, then id.
// Visible: the centre is in range and in line of sight of the robot's centre; robots and people do not occlude.
// Overwrites `agents`.
void visible_agents(const World& world, std::uint32_t robot, std::vector<dmrp_agent>& agents);

}  // namespace dmrp::core
