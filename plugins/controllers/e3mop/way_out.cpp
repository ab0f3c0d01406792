// SPDX-License-Identifier: MIT
#include "controllers/e3mop/way_out.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>

#include "controllers/e3mop/guarded_motion.hpp"
#include "controllers/motion/stop_and_rotate.hpp"
#include "controllers/motion/unicycle.hpp"

namespace dmrp::controllers::e3mop {

namespace {

// A robot that stands for this time, and turns more slowly than this, looks for a way out.
constexpr double patience_s = 1.0;
constexpr double turning_rad_s = 0.1;

// The way out is straight and free for `reach_m`; the robot drives `driven_m` of it, at `speed`.
constexpr double reach_m = 0.3;
constexpr double driven_m = 0.2;
constexpr double speed_m_s = 0.2;
constexpr double ray_step_m = 0.02;

// Directions to either side of the path's, so far apart.
constexpr int directions_a_side = 32;
constexpr double direction_step_rad = toolkit::pi / directions_a_side;

// The robot drives once it faces the way out as closely as this.
constexpr double facing_rad = 0.05;

bool is_way_out(Vec2 from, double bearing, const FreeSpace& free_space) {
  DirectedPoint at = directed(from, bearing);
  for (int step = 1; step * ray_step_m <= reach_m; ++step) {
    at.at = from + step * ray_step_m * at.heading;
    if (!free_space.is_free(at)) return false;
  }
  return true;
}

}  // namespace

bool WayOut::take(const Observation& now, const Command& command, double lead, const FreeSpace& free_space) {
  const bool is_stopped = std::max(now.velocity.v_x, command.v_x) < stopped_m_s &&
                          std::max(std::abs(now.velocity.omega), std::abs(command.omega)) < turning_rad_s;
  stopped_s_ = is_stopped ? stopped_s_ + seconds(now.dt_ns) : 0.0;
  if (stopped_s_ < patience_s) return false;
  stopped_s_ = 0.0;
  from_ = toolkit::position(now.pose);
  for (int k = 0; k <= directions_a_side; ++k) {
    for (const double side : {1.0, -1.0}) {
      const double bearing = toolkit::wrap(lead + side * k * direction_step_rad);
      if (!is_way_out(from_, bearing, free_space)) continue;
      bearing_ = bearing;
      return true;
    }
  }
  return false;
}

Command WayOut::drive(const Observation& now, const FreeSpace& free_space) {
  const double aside = toolkit::difference(now.pose.theta, *bearing_);
  Command command;
  if (std::abs(aside) > facing_rad) {
    command = guarded_turn(now, aside, free_space);
    if (command.omega == 0.0) reset();
    return command;
  }
  command = braking(now);
  command.v_x = toward(now.velocity.v_x, speed_m_s, now.limits.a_max * seconds(now.dt_ns));
  command = guarded(now, command, free_space);
  const bool has_driven = toolkit::distance(from_, toolkit::position(now.pose)) >= driven_m;
  if (has_driven || command.v_x <= 0.0) reset();
  return command;
}

}  // namespace dmrp::controllers::e3mop
