// SPDX-License-Identifier: MIT
// stop_and_rotate.hpp: the end of the way: brake, then turn to the heading asked for.
#ifndef DMRP_CONTROLLERS_MOTION_STOP_AND_ROTATE_HPP
#define DMRP_CONTROLLERS_MOTION_STOP_AND_ROTATE_HPP

#include "controllers/motion/path_tracker.hpp"

namespace dmrp::controllers {

// Turns in place toward `angle` (how far, signed): omega within the limits, the acceleration, and what can be stopped
// in time, omega <= sqrt(2 alpha |angle|).
double turning_rate(double angle, const Observation& now);

// The command that brakes as hard as the limits allow.
Command braking(const Observation& now);

// A latch on the stop point: once the robot is near, it stays in the hands of command() until the stop point moves or
// the robot is pushed out of the tolerance. A replan that ends at the same place does not open the latch.
class StopAndRotate {
 public:
  void reset() { latched_ = false, turning_ = false; }

  // Whether the robot has reached the stop point, now or since the latch closed.
  bool reached(const StopPoint& stop, const Observation& now);

  // For a robot that comes no nearer: closes the latch if it is within the tolerance, with a little to spare.
  bool settles(const StopPoint& stop, const Observation& now);

  // Brakes to rest, then turns to the stop's heading if it has one.
  Command command(const StopPoint& stop, const Observation& now);

 private:
  bool close(const StopPoint& stop, const Observation& now, double share);

  bool latched_ = false;
  bool turning_ = false;
  Vec2 latched_at_ = {0.0, 0.0};
};

}  // namespace dmrp::controllers

#endif
