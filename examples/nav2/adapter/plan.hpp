// SPDX-License-Identifier: MIT
// A robot's path as nav2's planners give it: poses a cell of the costmap apart, each along the path.
#pragma once

#include <dmrp/plugin.hpp>
#include <nav_msgs/msg/path.hpp>
#include <vector>

namespace nav2_adapter {

class Course {
 public:
  void set(dmrp::Path path);
  bool empty() const { return waypoints_.empty(); }

  // The waypoint of this goal, or the last that may be passed, whichever comes first.
  std::size_t end(std::uint32_t goal_index, std::uint32_t released_waypoint) const;
  // From `progress_m`, or from the robot if it has not begun, to the waypoint `end`. `heading` is that of the last pose;
  // NaN: along the path.
  nav_msgs::msg::Path plan(const dmrp::Pose& robot, double progress_m, std::size_t end, double heading) const;
  dmrp::Vec2 point(std::size_t waypoint) const;

 private:
  std::vector<dmrp::Waypoint> waypoints_;
  std::vector<double> arcs_m_;
};

}  // namespace nav2_adapter
