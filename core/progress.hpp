// SPDX-License-Identifier: MIT
// progress.hpp: how far a robot has come along its path.
#pragma once

#include <dmrp/path.h>

#include <cstdint>
#include <span>
#include <vector>

namespace dmrp::core {

// Progress is the arc length of the place on the path that the robot has reached. It never falls on a path, and does not
// pass the current goal before the robot has arrived there.
class PathProgress {
 public:
  // Begins a new path (at least one waypoint) from where the robot is. Getting onto it counts as no gain.
  void set_path(std::span<const dmrp_waypoint> path, dmrp_vec2 position);

  void update(dmrp_vec2 position, std::uint32_t goal_index);

  double progress_m() const { return progress_m_; }
  std::uint32_t waypoint() const { return waypoint_; }  // the last one passed
  double gained_m() const { return gained_m_; }         // the sum over all paths so far

 private:
  void advance(dmrp_vec2 position, double limit_m);

  std::vector<dmrp_waypoint> path_;
  std::vector<double> arcs_;
  double progress_m_ = 0.0;
  double gained_m_ = 0.0;
  double travelled_m_ = 0.0;  // since the last gain: how much path may have been cut off
  dmrp_vec2 last_position_{};
  std::uint32_t waypoint_ = 0;
};

}  // namespace dmrp::core
