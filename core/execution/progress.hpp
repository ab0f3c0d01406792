// SPDX-License-Identifier: MIT
// progress.hpp: a robot's progress along its path.
#pragma once

#include <dmrp/path.h>

#include <cstdint>
#include <span>
#include <vector>

namespace dmrp::core {

// Progress is the arc length of the place on the path that the robot has reached. It never decreases on a path, and it
// passes neither the current goal before the robot has visited it nor a *return*: the first waypoint ahead, farther along
// the path than return_arc_cells, that lies within return_cells of the place reached. A robot that is pushed out of a
// cell and back drives the loop.
class PathProgress {
 public:
  // `cell_m`: the width of the planning grid's cells.
  explicit PathProgress(double cell_m = 1.0) : cell_m_(cell_m) {}

  // Begins a new path (at least one waypoint) at the robot's present position.
  void set_path(std::span<const dmrp_waypoint> path, dmrp_vec2 position);

  void update(dmrp_vec2 position, std::uint32_t goal_index);

  double progress_m() const;
  std::uint32_t waypoint() const;  // the last one passed; the first one until then
  bool has_begun() const;          // whether the first waypoint has been passed
  double off_path_m() const;       // distance from the robot to the place reached

  // The last waypoint before the robot returns to where it is, by number in the path set; the path's last if it does not.
  std::uint32_t before_return() const;

 private:
  std::size_t first_return(double until_m) const;
  void advance(double limit_m);
  void pass_waypoints();

  std::vector<dmrp_waypoint> path_;  // with the line to its beginning
  std::vector<double> arcs_;
  std::uint32_t approach_ = 0;  // waypoints of path_ inserted before the path: 0 or 1
  double cell_m_;
  double reached_m_ = 0.0;    // along path_
  double travelled_m_ = 0.0;  // since the last progress: bounds the length of a shortcut
  dmrp_vec2 last_position_{};
  std::uint32_t waypoint_ = 0;  // of path_
};

}  // namespace dmrp::core
