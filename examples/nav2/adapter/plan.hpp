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

  bool leads_to_goal() const { return leads_to_goal_; }

  // From `progress_m`, or from the robot if it has not begun, to the end. `heading` is that of the last pose; NaN: along
  // the path.
  nav_msgs::msg::Path plan(const dmrp::Pose& robot, double progress_m, double heading) const;

 private:
  dmrp::Vec2 point(std::size_t waypoint) const;

  std::vector<dmrp::Waypoint> waypoints_;
  std::vector<double> arcs_m_;
  bool leads_to_goal_ = false;
};

}  // namespace nav2_adapter
