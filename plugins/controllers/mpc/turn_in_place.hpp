// SPDX-License-Identifier: MIT
// turn_in_place.hpp: the turn of a standing robot that cannot drive off as it faces.
#pragma once

#include <optional>
#include <vector>

#include "controllers/motion/footprint_check.hpp"

namespace dmrp::controllers::mpc {

class TurnInPlace {
 public:
  void reset() { heading_.reset(); }

  // Toward the way.
  void begin(const std::vector<Vec2>& route, const Observation& now);

  // Begins it for a holonomic robot, which keeps its heading in a trajectory, if that would be slow in the direction of its
  // way, because it is slower backwards or sideways. Returns whether it turns.
  bool begin_if_slow(const std::vector<Vec2>& route, const Observation& now);

  // The command of the turn. False if there is none, or if it ends or is blocked.
  bool goes_on(const Observation& now, const FootprintCheck& footprint, Command& command);

 private:
  std::optional<double> heading_;  // where it ends
};

}  // namespace dmrp::controllers::mpc
