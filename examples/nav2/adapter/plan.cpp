// SPDX-License-Identifier: MIT
#include <adapter/plan.hpp>
#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/polyline.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <nav2_util/geometry_utils.hpp>

namespace nav2_adapter {

namespace {

constexpr double spacing_m = 0.05;

void append(nav_msgs::msg::Path& plan, const dmrp::Vec2& point, double heading) {
  geometry_msgs::msg::PoseStamped pose;
  pose.header = plan.header;
  pose.pose.position.x = point.x;
  pose.pose.position.y = point.y;
  pose.pose.orientation = nav2_util::geometry_utils::orientationAroundZAxis(heading);
  plan.poses.push_back(pose);
}

}  // namespace

void Course::set(dmrp::Path path) {
  waypoints_.assign(path.begin(), path.end());
  dmrp::toolkit::arc_lengths(waypoints_, arcs_m_);
  leads_to_goal_ = !path.is_partial();
}

dmrp::Vec2 Course::point(std::size_t waypoint) const {
  return {waypoints_[waypoint].x, waypoints_[waypoint].y};
}

nav_msgs::msg::Path Course::plan(const dmrp::Pose& robot, double progress_m, double heading) const {
  std::vector<dmrp::Vec2> corners;
  const double from_m = std::min(progress_m, arcs_m_.back());
  // nav2's plans begin at the robot; a path here may begin ahead of it.
  if (progress_m == 0.0) corners.push_back({robot.x, robot.y});
  corners.push_back(dmrp::toolkit::point_at(waypoints_, arcs_m_, from_m));
  for (std::size_t i = 0; i < waypoints_.size(); ++i)
    if (arcs_m_[i] > from_m) corners.push_back(point(i));

  nav_msgs::msg::Path plan;
  plan.header.frame_id = "map";
  double along = robot.theta;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const dmrp::Vec2 leg{corners[i + 1].x - corners[i].x, corners[i + 1].y - corners[i].y};
    const double length_m = std::hypot(leg.x, leg.y);
    if (length_m == 0.0) continue;
    along = std::atan2(leg.y, leg.x);
    const auto pieces = static_cast<std::size_t>(std::ceil(length_m / spacing_m));
    for (std::size_t k = 0; k < pieces; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(pieces);
      append(plan, {corners[i].x + share * leg.x, corners[i].y + share * leg.y}, along);
    }
  }
  append(plan, corners.back(), std::isnan(heading) ? along : heading);
  return plan;
}

}  // namespace nav2_adapter
