// SPDX-License-Identifier: MIT
// clear_way.hpp: whether a robot can move without meeting what it senses.
#pragma once

#include <dmrp/values.h>

#include <cstdint>
#include <span>

#include "core/world/world.hpp"

namespace dmrp::core {

// The gap that a moving robot keeps, m: a cell of a costmap.
inline constexpr double clear_gap_m = 0.05;

// Whether the robot, led through these poses from the one that it has, keeps clear_gap_m to the static bodies, and to the
// robots and people that it senses, where they are now. What is nearer must not come nearer still: a robot that touches
// something can leave it. It senses those whose centre its lidar would reach: in range, in its field of view, and behind
// no static body.
bool way_is_clear(const World& world, std::uint32_t robot, std::span<const dmrp_pose> poses);

}  // namespace dmrp::core
