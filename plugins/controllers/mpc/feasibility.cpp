// SPDX-License-Identifier: MIT
#include "controllers/mpc/feasibility.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>
#include <numbers>

#include "controllers/motion/drive_ability.hpp"
#include "controllers/motion/stop_and_rotate.hpp"
#include "controllers/motion/unicycle.hpp"

namespace dmrp::controllers::mpc {

namespace {

// Poses closer by no more than this count as no closer.
constexpr double rounding_m = 1e-3;

// A robot that is on its way evades too, so a predicted contact with it counts only if it is less than the braking time
// and this ahead. Where two have to share the room, as in a narrow corridor, neither could plan past the other alone.
constexpr double shared_evasion_s = 1.0;

// A robot that brakes may come so close to an obstacle, a cell larger than it was seen: a fifth of that cell nearer than
// trajectories may, so that small errors in following them are none.
constexpr double stop_m = -0.01;

// A trajectory that turns away from an obstacle comes so much closer to it first.
constexpr double turning_room_m = 0.05;

// Occupied cells within this distance of an agent count as the agent's.
constexpr double agent_cells_m = 0.15;

double needed_from(const Obstacle& obstacle) {
  return obstacle.is_agent ? least_gap_m : 0.0;
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

// The costmap shows agents at their current positions.
bool is_beside_agent(const Pose& pose, const Surroundings& around) {
  return std::any_of(around.obstacles.begin(), around.obstacles.end(), [&](const Obstacle& obstacle) {
    return obstacle.is_agent &&
           least_distance(around.now.footprint, toolkit::position(pose), obstacle, 0.0) < agent_cells_m;
  });
}

// Against the obstacles at their predicted positions, and against the costmap. The costmap shows the agents at their
// current positions, so it does not count beside them.
bool is_free(const Pose& pose, double ahead_s, const Surroundings& around) {
  const Vec2 robot = toolkit::position(pose);
  const Footprint& footprint = around.now.footprint;
  bool beside_agent = false;
  for (const Obstacle& obstacle : around.obstacles) {
    const bool evades_too = around.robots_evade && obstacle.is_robot && obstacle.velocity != Vec2{0.0, 0.0} &&
                            ahead_s > around.now.velocity.v_x / around.now.limits.a_max + shared_evasion_s;
    if (!evades_too && comes_too_close(pose, obstacle, ahead_s, needed_from(obstacle), around)) return false;
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

// Whether the pose is closer to an occupied cell than half of that cell's diagonal, and closer than now. A disc costs as
// much as the cell of its centre, which is up to that far beside it: where this cost is a collision, the distance counts.
bool comes_too_close_to_cells(const Pose& pose, const Surroundings& around, const FootprintCheck& padded,
                              const CostmapView& map) {
  if (padded.cost(directed(pose)) != in_collision) return false;
  const Footprint& footprint = around.now.footprint;
  if (footprint.part_count > 0) return true;
  const double needed_m = footprint.radius_m + std::numbers::sqrt2 / 2.0 * map.resolution_m();
  const double distance_m = map.distance_to_lethal(toolkit::position(pose), needed_m);
  return distance_m < needed_m &&
         distance_m < map.distance_to_lethal(toolkit::position(around.now.pose), needed_m) - rounding_m;
}

}  // namespace

bool is_collision_free(const Trajectory& trajectory, std::size_t first, std::size_t most_states,
                       const Surroundings& around) {
  const std::size_t last = std::min(trajectory.size() - first - 1, most_states);
  for (std::size_t k = 0; k < last; ++k) {
    const double from_s = static_cast<double>(k) * trajectory.dt_s;
    if (!is_leg_free(trajectory.states[first + k], trajectory.states[first + k + 1], from_s, trajectory.dt_s, around))
      return false;
  }
  return true;
}

bool stops_in_time(const Command& command, const Surroundings& around, const CostmapView& map) {
  const FootprintCheck padded(map, around.now.footprint, 0.5 * map.resolution_m(), around.now.pose);
  const bool begins_inside = padded.cost(directed(around.now.pose)) == in_collision;
  Observation at = around.now;
  const double period_s = seconds(at.dt_ns);
  Command next = command;
  do {
    DirectedPoint point = directed(at.pose);
    ArcStepper(0.5 * (at.velocity.v_x + next.v_x), 0.5 * (at.velocity.v_y + next.v_y),
               0.5 * (at.velocity.omega + next.omega), period_s)
        .step(point);
    at.pose = pose_of(point);
    at.velocity = {next.v_x, next.v_y, next.omega};
    if (std::any_of(around.obstacles.begin(), around.obstacles.end(), [&](const Obstacle& obstacle) {
          return !obstacle.is_agent && comes_too_close(at.pose, obstacle, 0.0, stop_m, around);
        }))
      return false;
    if (!begins_inside && !is_beside_agent(at.pose, around) && comes_too_close_to_cells(at.pose, around, padded, map))
      return false;
    next = braking(at);
  } while (speed_of(at.velocity) > 0.0);
  return true;
}

Command slow_enough(const Command& command, const Surroundings& around, const CostmapView& map) {
  const Observation& now = around.now;
  const Vec2 velocity = {now.velocity.v_x, now.velocity.v_y};
  const auto slowed = [&](double share, double omega) {
    const Vec2 slower = toward(velocity, share * Vec2{command.v_x, command.v_y}, now.limits.a_max * seconds(now.dt_ns));
    return Command{slower.x, slower.y, omega};
  };
  if (stops_in_time(command, around, map)) return command;
  if (is_car_like(now.limits)) return braking(now);
  for (const Command& slow : {slowed(0.5, command.omega), slowed(0.25, command.omega), slowed(0.25, braking(now).omega),
                              slowed(0.0, command.omega)}) {
    if (stops_in_time(slow, around, map)) return slow;
  }
  return braking(now);
}

bool stands_close(const Surroundings& around) {
  return std::any_of(around.obstacles.begin(), around.obstacles.end(), [&](const Obstacle& obstacle) {
    return separation(around.now.footprint, around.now.pose, obstacle, 0.0).distance_m <
           needed_from(obstacle) + turning_room_m;
  });
}

}  // namespace dmrp::controllers::mpc
