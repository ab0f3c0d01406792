// SPDX-License-Identifier: MIT
// way_out.hpp: how a robot gets free that has a path but cannot take its first step.
#pragma once

#include <dmrp/cpp/local_controller.hpp>
#include <optional>

#include "controllers/e3mop/free_space.hpp"

namespace dmrp::controllers::e3mop {

// Beside an obstacle, a path may begin so nearly along it that the collision check stops every command, and a robot
// that stands still has the same path again. It then turns in place to the direction nearest to its path in which it can
// drive straight without coming closer to anything, drives a little, and plans anew from there.
class WayOut {
 public:
  // No way out is taken, and the robot was not stopped.
  void reset() { *this = {}; }

  // Once in each cycle with a path, of which `lead` is the bearing: true, and a way out is taken, if the robot has stood
  // for a second, has commands that do not move it, and there is a way out.
  bool take(const Observation& now, const Command& command, double lead, const FreeSpace& free_space);

  bool is_taken() const { return bearing_.has_value(); }

  // The command of a robot on its way out; ends when it has driven far enough or cannot move on.
  Command drive(const Observation& now, const FreeSpace& free_space);

 private:
  double stopped_s_ = 0.0;
  std::optional<double> bearing_;  // of the way out
  Vec2 from_ = {0.0, 0.0};
};

}  // namespace dmrp::controllers::e3mop
