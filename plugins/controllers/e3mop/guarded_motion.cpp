// SPDX-License-Identifier: MIT
#include "controllers/e3mop/guarded_motion.hpp"

#include <cmath>

#include "controllers/motion/stop_and_rotate.hpp"
#include "controllers/motion/unicycle.hpp"

namespace dmrp::controllers::e3mop {

namespace {

// The step of the collision check.
constexpr double check_step_m = 0.05;

}  // namespace

Command guarded_turn(const Observation& now, double angle, const FreeSpace& free_space) {
  Command command = braking(now);
  const double omega = turning_rate(angle, now);
  const double turned = omega * (seconds(now.dt_ns) + 0.5 * std::abs(omega) / now.limits.alpha_max);
  for (const double share : {0.5, 1.0})
    if (!free_space.is_free(directed(toolkit::position(now.pose), now.pose.theta + share * turned))) return command;
  command.omega = omega;
  return command;
}

Command guarded(const Observation& now, const Command& command, const FreeSpace& free_space) {
  const double period_s = seconds(now.dt_ns);
  const double braking_s = command.v_x / now.limits.a_max + period_s;
  const int steps = 1 + static_cast<int>(command.v_x * braking_s / check_step_m);
  DirectedPoint at = directed(now.pose);
  // braking from v covers the same distance as driving at v for half the time
  const ArcStepper stepper(command.v_x, command.omega, 0.5 * (braking_s + period_s) / steps);
  for (int i = 0; i < steps; ++i) {
    stepper.step(at);
    if (free_space.is_free(at)) continue;
    Command slower = braking(now);
    slower.omega = command.omega;
    return slower;
  }
  return command;
}

}  // namespace dmrp::controllers::e3mop
