// SPDX-License-Identifier: MIT
#include "controllers/dwa/critics.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>

namespace dmrp::controllers::dwa {

namespace {

// Below this speed a turn counts as a turn in place (min_vel_trans upstream).
constexpr double hardly_driving_m_s = 0.1;

// Sets `direction` to the sign of `value`; true if that reverses the earlier direction.
bool reverses(double value, int& direction) {
  if (value == 0.0) return false;
  const int now = value > 0.0 ? 1 : -1;
  const bool reversed = direction == -now;
  direction = now;
  return reversed;
}

// The highest footprint cost along the arc, or in_collision; `at` becomes the arc's end. The footprint grows with the
// speed, so that fast arcs keep a larger clearance.
int obstacle_cost(const Sample& sample, const Scene& scene, const Tuning& tuning, FootprintCheck& footprint,
                  DirectedPoint& at) {
  const double fast = std::max(scene.v_max - tuning.scaling_speed, 1e-9);
  const double share = std::clamp((speed_of(sample) - tuning.scaling_speed) / fast, 0.0, 1.0);
  footprint.scale(1.0 + tuning.max_scaling_factor * share);
  const int steps = simulation_steps(sample, tuning);
  Rollout rollout(sample, scene, tuning.sim_time, steps);
  int highest = 0;
  for (int i = 0; i < steps; ++i) {
    rollout.step(at);
    const int cost = footprint.cost(at);
    if (cost == in_collision) return in_collision;
    highest = std::max(highest, cost);
  }
  return highest;
}

// The distance in cells from the nose to the front's seeds. If the nose is over an obstacle or outside the window,
// takes the first point toward the centre that the front reached, and adds the distance to it.
double nose_cells(const WaveFront& front, const Scene& scene, const DirectedPoint& at, std::int32_t center,
                  double nose_length_m) {
  const double cell_m = scene.map.resolution_m();
  for (double length_m = nose_length_m; length_m > 0.0; length_m -= cell_m) {
    const std::int32_t index = scene.terrain.index_of(scene.map, at.at + length_m * at.heading);
    if (front.reached(index)) return front.cells(index) + (nose_length_m - length_m) / cell_m;
  }
  return front.cells(center) + nose_length_m / cell_m;
}

}  // namespace

void OscillationGuard::release(const Pose& now, double reset_distance_m, double reset_angle_rad) {
  if (only_drive_ == 0 && only_turn_ == 0) return;
  const double moved_m = toolkit::distance(toolkit::position(since_), toolkit::position(now));
  if (moved_m > reset_distance_m || std::abs(toolkit::difference(since_.theta, now.theta)) > reset_angle_rad) reset();
}

void OscillationGuard::record(const Pose& now, const Sample& command) {
  bool reversed = false;
  if (reverses(command.v, drive_)) {
    only_drive_ = drive_;
    reversed = true;
  }
  const bool hardly_drives = std::abs(command.v) <= hardly_driving_m_s;
  if (hardly_drives && reverses(command.omega, turn_)) {
    only_turn_ = turn_;
    reversed = true;
  }
  if (hardly_drives && reverses(command.v_y, strafe_)) {
    only_strafe_ = strafe_;
    reversed = true;
  }
  if (reversed) since_ = now;
}

Scene with_heading(const Scene& scene, double heading, const OscillationGuard& oscillation) {
  return {{scene.pose.x, scene.pose.y, heading},
          scene.v_max,
          scene.map,
          scene.terrain,
          scene.path,
          scene.goal,
          scene.goal_front,
          scene.front_length_m,
          scene.follow,
          scene.align,
          oscillation,
          nullptr,
          scene.room};
}

int simulation_steps(const Sample& sample, const Tuning& tuning) {
  const double straight = speed_of(sample) * tuning.sim_time / tuning.sim_granularity;
  const double turning = std::abs(sample.omega) * tuning.sim_time / tuning.angular_sim_granularity;
  return std::max(1, static_cast<int>(std::ceil(std::max(straight, turning))));
}

double score(const Sample& sample, const Scene& scene, const Tuning& tuning, FootprintCheck& footprint, double best) {
  if (!scene.oscillation.allows(sample)) return rejected;

  DirectedPoint end = directed(scene.pose);
  const int obstacle = obstacle_cost(sample, scene, tuning, footprint, end);
  if (obstacle == in_collision) return rejected;
  double sum = tuning.occdist_scale * obstacle;
  if (scene.room && scene.room->is_too_close(end)) sum += stay_cost;
  if (sum > best) return sum;

  // the four grid critics, first at the robot's nose, then at its centre
  const double resolution_m = scene.map.resolution_m();
  // a robot that moves away from an obstacle may still be on a blocked cell
  const std::int32_t center = scene.terrain.nearest_free(scene.terrain.index_of(scene.map, end.at), escape_reach_cells);
  if (!scene.path.reached(center) || !scene.goal.reached(center)) return rejected;
  const double goal_scale = tuning.goal_distance_bias * resolution_m;
  const double path_scale = tuning.path_distance_bias * resolution_m;

  sum += goal_scale * nose_cells(scene.goal_front, scene, end, center, scene.front_length_m);
  if (sum > best) return sum;
  if (scene.follow && scene.align)
    sum += path_scale * nose_cells(scene.path, scene, end, center, tuning.forward_point_distance);
  if (sum > best) return sum;
  if (scene.follow) sum += path_scale * scene.path.cells(center);
  if (sum > best) return sum;
  sum += goal_scale * scene.goal.cells(center);
  return sum + tuning.twirling_scale * std::abs(sample.omega);
}

std::optional<Sample> cheapest(const VelocityWindow& window, const Scene& scene, const Tuning& tuning,
                               FootprintCheck& footprint) {
  std::optional<Sample> choice;
  double best = std::numeric_limits<double>::infinity();
  for (const double v : window.v) {
    for (const double v_y : window.v_y) {
      for (const double omega : window.omega) {
        const Sample sample = window.at(v, v_y, omega);
        const double cost = score(sample, scene, tuning, footprint, best);
        if (cost == rejected || !(cost < best)) continue;
        choice = sample;
        best = cost;
      }
    }
  }
  return choice;
}

}  // namespace dmrp::controllers::dwa
