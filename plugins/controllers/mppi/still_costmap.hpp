// SPDX-License-Identifier: MIT
// still_costmap.hpp: the costmap without the agents that move.
#pragma once

#include <dmrp/ext/local_costmap.h>

#include <cstdint>
#include <vector>

#include "controllers/motion/obstacles.hpp"

namespace dmrp::controllers::mppi {

// A costmap shows moving agents where they are now. Where their motion is predicted, that would count them twice.
class StillCostmap {
 public:
  // A copy of the map in which the cells about every moving agent have the costs that the obstacles beside it give
  // them. Valid until the next call.
  const dmrp_costmap& copy(const dmrp_costmap& map, const std::vector<Obstacle>& obstacles);

 private:
  void rebuild(const Obstacle& agent, const std::vector<Obstacle>& obstacles);

  dmrp_costmap map_{};
  std::vector<std::uint8_t> costs_;
  std::vector<const Obstacle*> beside_;  // an agent
};

// Whether an obstacle counts where it will be instead of where it is.
inline bool is_moving(const Obstacle& obstacle) {
  return obstacle.is_agent && (obstacle.velocity.x != 0.0 || obstacle.velocity.y != 0.0);
}

}  // namespace dmrp::controllers::mppi
