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
  bool robots_evade = true;   // moving robots evade too: contacts with them count only for a while
};

// Whether the states 1 to `most_states` after `first` are free, state first + k at the time k dt_s.
bool is_collision_free(const Trajectory& trajectory, std::size_t first, std::size_t most_states,
                       const Surroundings& around);

// Whether the robot stops before it hits an obstacle other than an agent, if it drives this command for a period and
// then brakes. States of a trajectory are where the robot would be if it changed its speed at once. The occupied cells
// count too, since clusters are simplified by more than the cell that they are made larger by.
bool stops_in_time(const Command& command, const Surroundings& around, const CostmapView& map);

// The command, or a slower one that turns alike or not at all, from which the robot stops in time; otherwise braking.
Command slow_enough(const Command& command, const Surroundings& around, const CostmapView& map);

// Whether the robot stands so close to an obstacle that a trajectory may have no room to turn away from it.
bool stands_close(const Surroundings& around);

}  // namespace dmrp::controllers::mpc
