// SPDX-License-Identifier: MIT
#include "controllers/mpc/feasibility.hpp"

#include <algorithm>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::controllers::mpc {

namespace {

// The least distance between a predicted pose and an obstacle, unless the robot already stands closer.
constexpr double least_gap_m = 0.02;

// A robot that stands closer may come closer by this much.
constexpr double tolerated_approach_m = 0.005;

// Occupied cells within this distance of an agent count as the agent's.
constexpr double agent_cells_m = 0.15;

// Against the obstacles at their predicted positions, and against the costmap. The costmap shows the agents at their
// current positions, so it does not count beside them.
bool is_free(const Pose& pose, double ahead_s, double least_m, const Surroundings& around) {
  const Vec2 robot = toolkit::position(pose);
  const Footprint& footprint = around.now.footprint;
  bool beside_agent = false;
  for (const Obstacle& obstacle : around.obstacles) {
    if (least_distance(footprint, robot, obstacle, ahead_s) < least_m &&
        separation(footprint, pose, obstacle, ahead_s).distance_m < least_m)
      return false;
    beside_agent =
        beside_agent || (obstacle.is_agent && least_distance(footprint, robot, obstacle, 0.0) < agent_cells_m);
  }
  return beside_agent || around.footprint.cost(directed(pose)) != in_collision;
}

}  // namespace

bool is_collision_free(const Trajectory& trajectory, std::size_t first, std::size_t most_states,
                       const Surroundings& around) {
  double least_m = least_gap_m;
  for (const Obstacle& obstacle : around.obstacles) {
    const double distance_m = separation(around.now.footprint, around.now.pose, obstacle, 0.0).distance_m;
    least_m = std::min(least_m, distance_m - tolerated_approach_m);
  }
  const std::size_t last = std::min(trajectory.size() - first - 1, most_states);
  for (std::size_t k = 1; k <= last; ++k)
    if (!is_free(trajectory.states[first + k], static_cast<double>(k) * trajectory.dt_s, least_m, around)) return false;
  return true;
}

}  // namespace dmrp::controllers::mpc
