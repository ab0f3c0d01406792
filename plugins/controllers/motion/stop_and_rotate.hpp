// SPDX-License-Identifier: MIT
// stop_and_rotate.hpp: stopping at the goal: brake, come closer if the goal demands it, then turn in
// place to its heading.
#pragma once

#include <optional>

#include "controllers/motion/footprint_check.hpp"
#include "controllers/motion/path_tracker.hpp"

namespace dmrp::controllers {

// The turning rate that turns the robot in place by the signed `angle`: within the limits of omega and its
// acceleration, and slow enough to stop in time, omega <= sqrt(2 alpha |angle|).
double turning_rate(double angle, const Observation& now);

// The command that brakes at the maximum deceleration; a car-like robot keeps its curvature.
Command braking(const Observation& now);

// Brakes and turns by this angle. Nothing if the outline would not be free for half a second of the turn.
std::optional<Command> braking_turn(double angle, const Observation& now, const FootprintCheck& footprint);

// A latch on the stop point: once the robot is close, command() controls it until the stop point moves or the robot is
// pushed out of the tolerance. A replan to the same stop point does not release the latch.
//
// Published controllers come as near to a goal as their samples, horizons and parameters let them: within 0.1 m, as they
// are tuned. Where a goal asks for more, command() drives what is left. A car-like robot cannot.
class StopAndRotate {
 public:
  void reset() { latched_ = false, turning_ = false, approaching_ = false; }

  // Whether the robot has reached the stop point now, or reached it before and the latch holds.
  bool reached(const StopPoint& stop, const Observation& now);

  // The same; but a car-like robot, which cannot turn there, has to arrive with the stop point's heading, if any.
  bool arrived(const StopPoint& stop, const Observation& now);

  // For a robot that cannot come closer: latches if it is within the tolerance, with a small margin.
  bool settles(const StopPoint& stop, const Observation& now);

  // Drives on to a stop point that asks for more than the controller can, brakes to a stop, then turns to the stop point's
  // heading if it has one. A car-like robot does neither drive on nor turn.
  Command command(const StopPoint& stop, const Observation& now);

 private:
  bool latch(const StopPoint& stop, const Observation& now, double share);
  bool approaches(const StopPoint& stop, const Observation& now);

  bool latched_ = false;
  bool turning_ = false;
  bool approaching_ = false;
  Vec2 latched_at_ = {0.0, 0.0};
};

}  // namespace dmrp::controllers
