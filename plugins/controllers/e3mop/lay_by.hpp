// SPDX-License-Identifier: MIT
// lay_by.hpp: where the robot lets somebody pass who leaves it no way.
#pragma once

#include <dmrp/cpp/local_controller.hpp>
#include <optional>
#include <vector>

#include "controllers/e3mop/free_space.hpp"

namespace dmrp::controllers::e3mop {

// Two robots that meet in the middle of a corridor see no way past each other, though there is room for them side by
// side: each would have to see the other move aside first. So each drives to its own right-hand side.
//
// If somebody who stands or comes toward the robot blocks the path: the place some way before that point, so far to the
// right of the path as it takes to pass, or as there is room. Nothing if the path is free, something else blocks it, or
// there is no room. Agents sweep their predicted motion for `prediction_time_s`. A robot that is told of no agents takes
// what blocks its path for somebody of its own size: no planned path leads through what is on the map.
std::optional<Vec2> lay_by(const Observation& now, const std::vector<Vec2>& path, double prediction_time_s,
                           const FreeSpace& free_space);

}  // namespace dmrp::controllers::e3mop
