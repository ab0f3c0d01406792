// SPDX-License-Identifier: MIT
// progress.hpp: a robot's progress along its path.
#pragma once

#include <dmrp/path.h>

#include <cstdint>
#include <span>
#include <vector>

namespace dmrp::core {

// Progress is the arc length of the place on the path that the robot has reached. It never decreases on a path, and it
// does not pass the current goal before the robot has arrived there.
//
// The gain is the progress summed over all paths of the robot as if they were one. A change of the path is no gain. If
// a path begins elsewhere, the straight line to its beginning is part of it. A robot that was off its old path first
// has to recover that distance. So neither frequent new paths nor paths that lead a robot back and forth count as a
// gain.
class PathProgress {
 public:
  // Begins a new path (at least one waypoint) at the robot's present position.
  void set_path(std::span<const dmrp_waypoint> path, dmrp_vec2 position);

  void update(dmrp_vec2 position, std::uint32_t goal_index);

  double progress_m() const;
  std::uint32_t waypoint() const;                // the last one passed; the first one until then
  bool has_begun() const;                        // whether the first waypoint has been passed
  double gained_m() const { return gained_m_; }  // over all paths so far; never decreases
  double off_path_m() const;                     // distance from the robot to the place reached

 private:
  void advance(double limit_m);
  void pass_waypoints();

  std::vector<dmrp_waypoint> path_;  // with the line to its beginning
  std::vector<double> arcs_;
  std::uint32_t approach_ = 0;  // waypoints of path_ inserted before the path: 0 or 1
  double reached_m_ = 0.0;      // along path_
  double gained_m_ = 0.0;
  double lost_m_ = 0.0;       // to be recovered before progress counts as a gain
  double travelled_m_ = 0.0;  // since the last progress: bounds the length of a shortcut
  dmrp_vec2 last_position_{};
  std::uint32_t waypoint_ = 0;  // of path_
};

}  // namespace dmrp::core
