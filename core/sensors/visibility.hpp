// SPDX-License-Identifier: MIT
// sensing.hpp: what a robot of a world perceives.
#pragma once

#include <dmrp/observation.h>

#include <cstdint>
#include <span>
#include <vector>

#include "core/sensors/lidar.hpp"
#include "core/world/world.hpp"

namespace dmrp::core {

// The scan that a robot takes now.
void scan_from(const World& world, std::uint32_t robot, Lidar& lidar, std::span<float> ranges);

// The others that the tracking of the world's settings tells this robot of, ordered by kind, then id. Visible: the
// centre within range and in line of sight of the robot's centre; robots and people hide nobody. Replaces `agents`.
void visible_agents(const World& world, std::uint32_t robot, std::vector<dmrp_agent>& agents);

}  // namespace dmrp::core
