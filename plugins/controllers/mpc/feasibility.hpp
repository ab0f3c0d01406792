// SPDX-License-Identifier: MIT
// feasibility.hpp: the collision check of an optimised trajectory.
#pragma once

#include "controllers/motion/footprint_check.hpp"
#include "controllers/motion/obstacles.hpp"
#include "controllers/mpc/trajectory.hpp"

namespace dmrp::controllers::mpc {

// The least distance between a predicted pose and an agent, unless the robot already stands closer. Other obstacles are
// a cell larger than what the lidar saw, and no more is needed beside them.
inline constexpr double least_gap_m = 0.02;

// The input of the check in one control cycle. Does not own what it refers to.
struct Surroundings {
  const Observation& now;
  const std::vector<Obstacle>& obstacles;
  FootprintCheck& footprint;  // on the costmap
};

// Whether the first `most_states` states (-1: all) are free, state k at the time k dt_s.
bool is_collision_free(const Trajectory& trajectory, int most_states, const Surroundings& around);

}  // namespace dmrp::controllers::mpc
