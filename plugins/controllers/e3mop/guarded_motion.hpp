// SPDX-License-Identifier: MIT
// guarded_motion.hpp: commands that the collision check has seen.
#pragma once

#include <dmrp/cpp/local_controller.hpp>

#include "controllers/e3mop/free_space.hpp"

namespace dmrp::controllers::e3mop {

// Brakes and turns in place by an angle, as far as the outline has room.
Command guarded_turn(const Observation& now, double angle, const FreeSpace& free_space);

// The command, or braking if its arc collides within the braking distance.
Command guarded(const Observation& now, const Command& command, const FreeSpace& free_space);

}  // namespace dmrp::controllers::e3mop
