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
//
// What a robot has gained is progress summed over all its paths, as if there had been one: finding itself on a new path
// is no gain, the straight way to the beginning of one that begins elsewhere is part of it, and a robot that was driven
// off its old path first has to win back what it lost. So neither a new path a second nor one that leads a robot to and
// fro looks like progress.
class PathProgress {
 public:
  // Begins a new path (at least one waypoint) from where the robot is.
  void set_path(std::span<const dmrp_waypoint> path, dmrp_vec2 position);

  void update(dmrp_vec2 position, std::uint32_t goal_index);

  double progress_m() const;
  std::uint32_t waypoint() const;                // the last one passed; the first from the beginning
  bool has_begun() const;                        // the first waypoint is passed
  double gained_m() const { return gained_m_; }  // over all paths so far; never falls
  double off_path_m() const;                     // from the robot to the place reached

 private:
  void advance(double limit_m);
  void pass_waypoints();

  std::vector<dmrp_waypoint> path_;  // with the way to its beginning
  std::vector<double> arcs_;
  std::uint32_t way_there_ = 0;  // waypoints of path_ that were put before the path: 0 or 1
  double reached_m_ = 0.0;       // along path_
  double gained_m_ = 0.0;
  double lost_m_ = 0.0;       // to be won back before anything counts as gained
  double travelled_m_ = 0.0;  // since the last progress: how much path may have been cut off
  dmrp_vec2 last_position_{};
  std::uint32_t waypoint_ = 0;  // of path_
};

}  // namespace dmrp::core
