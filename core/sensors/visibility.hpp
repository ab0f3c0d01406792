// SPDX-License-Identifier: MIT
// visibility.hpp: the scans and visible agents of the robots in a world.
#pragma once

#include <dmrp/observation.h>

#include <cstdint>
#include <dmrp/toolkit/neighbour_grid.hpp>
#include <span>
#include <vector>

#include "core/sensors/lidar.hpp"
#include "core/world/world.hpp"

namespace dmrp::core {

// Knows what stands near each robot of a world, and looks again when its time has passed. Serves all robots of a trial.
class Sight {
 public:
  // `world` outlives it.
  explicit Sight(const World& world) : world_(world) {}

  const World& world() const { return world_; }

  // Scans the world from a robot's true pose.
  void scan_from(std::uint32_t robot, Lidar& lidar, std::span<float> ranges);

  // The other agents that this robot observes with the `tracking` of the world's settings, ordered by kind, then id.
  // Visible: the centre is in range and in line of sight of the robot's centre; robots and people do not occlude.
  // Overwrites `agents`.
  void visible_agents(std::uint32_t robot, std::vector<dmrp_agent>& agents);

 private:
  void look();

  const World& world_;
  std::int64_t looked_ns_ = -1;
  toolkit::NeighbourGrid robots_;
  toolkit::NeighbourGrid people_;
  double greatest_radius_m_ = 0.0;  // of robots and people
  std::vector<Disc> discs_;
  std::vector<ConvexPolygon> polygons_;
};

}  // namespace dmrp::core
