// SPDX-License-Identifier: MIT
#include "controllers/mpc/feasibility.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>

#include "controllers/motion/unicycle.hpp"

namespace dmrp::controllers::mpc {

namespace {

// Poses closer by no more than this count as no closer: the solver meets a distance to its tolerance, and a pose between
// two states that touch an obstacle cuts the chord.
constexpr double rounding_m = 1e-3;

// Occupied cells within this distance of an agent count as the agent's.
constexpr double agent_cells_m = 0.15;

double needed_from(const Obstacle& obstacle) {
  return obstacle.is_agent ? least_gap_m : -rounding_m;
}

// A robot that already stands closer than it needs may move as long as it comes no closer to this obstacle.
bool comes_too_close(const Pose& pose, const Obstacle& obstacle, double ahead_s, double needed_m,
                     const Surroundings& around) {
  const Footprint& footprint = around.now.footprint;
  if (least_distance(footprint, toolkit::position(pose), obstacle, ahead_s) >= needed_m) return false;
  const double distance_m = separation(footprint, pose, obstacle, ahead_s).distance_m;
  return distance_m < needed_m &&
         distance_m < separation(footprint, around.now.pose, obstacle, 0.0).distance_m - rounding_m;
}

// Against the obstacles at their predicted positions, and against the costmap. The costmap shows the agents at their
// current positions, so it does not count beside them.
bool is_free(const Pose& pose, double ahead_s, const Surroundings& around) {
  const Vec2 robot = toolkit::position(pose);
  const Footprint& footprint = around.now.footprint;
  bool beside_agent = false;
  for (const Obstacle& obstacle : around.obstacles) {
    if (comes_too_close(pose, obstacle, ahead_s, needed_from(obstacle), around)) return false;
    beside_agent =
        beside_agent || (obstacle.is_agent && least_distance(footprint, robot, obstacle, 0.0) < agent_cells_m);
  }
  return beside_agent || around.footprint.cost(directed(pose)) != in_collision;
}

// Between two states the robot keeps its heading and its speed. Checked at steps of at most the inscribed radius, as
// upstream: states on both sides of an obstacle would otherwise pass for a path through it.
bool is_leg_free(const State& from, const State& to, double from_s, double dt_s, const Surroundings& around) {
  const double leg_m = std::hypot(to.x - from.x, to.y - from.y);
  const int steps = std::max(1, static_cast<int>(std::ceil(leg_m / around.now.footprint.inscribed_radius_m)));
  for (int i = 1; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    if (!is_free(between(from, to, share), from_s + share * dt_s, around)) return false;
  }
  return true;
}

}  // namespace

bool is_collision_free(const Trajectory& trajectory, int most_states, const Surroundings& around) {
  std::size_t last = trajectory.size() - 1;
  if (most_states >= 0) last = std::min(last, static_cast<std::size_t>(most_states));
  for (std::size_t k = 0; k < last; ++k) {
    const double from_s = static_cast<double>(k) * trajectory.dt_s;
    if (!is_leg_free(trajectory.states[k], trajectory.states[k + 1], from_s, trajectory.dt_s, around)) return false;
  }
  return true;
}

}  // namespace dmrp::controllers::mpc
