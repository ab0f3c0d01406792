// SPDX-License-Identifier: MIT
// The goal's tolerances for nav2's controllers. It is the host that decides whether a robot has arrived.
#pragma once

#include <cmath>
#include <dmrp/plugin.hpp>
#include <nav2_core/goal_checker.hpp>
#include <nav2_util/geometry_utils.hpp>

namespace nav2_adapter {

class GoalChecker final : public nav2_core::GoalChecker {
 public:
  void set(const dmrp::Goal& goal) {
    // A robot that stops right at the tolerance has not arrived.
    xy_m_ = 0.9 * goal.tolerance_m;
    yaw_ = std::isnan(goal.pose.theta) ? M_PI : 0.9 * goal.tolerance_rad;
  }

  void initialize(const rclcpp_lifecycle::LifecycleNode::WeakPtr&, const std::string&,
                  std::shared_ptr<nav2_costmap_2d::Costmap2DROS>) override {}
  void reset() override {}
  bool isGoalReached(const geometry_msgs::msg::Pose& robot, const geometry_msgs::msg::Pose& goal,
                     const geometry_msgs::msg::Twist&) override {
    const double yaw = std::remainder(tf2::getYaw(robot.orientation) - tf2::getYaw(goal.orientation), 2.0 * M_PI);
    return std::hypot(robot.position.x - goal.position.x, robot.position.y - goal.position.y) <= xy_m_ &&
           std::abs(yaw) <= yaw_;
  }
  bool getTolerances(geometry_msgs::msg::Pose& pose, geometry_msgs::msg::Twist& velocity) override {
    constexpr double none = std::numeric_limits<double>::lowest();  // as nav2's checkers say that they check no speed
    pose.position.x = pose.position.y = xy_m_;
    pose.position.z = none;
    pose.orientation = nav2_util::geometry_utils::orientationAroundZAxis(yaw_);
    velocity.linear.x = velocity.linear.y = velocity.linear.z = none;
    velocity.angular.x = velocity.angular.y = velocity.angular.z = none;
    return true;
  }

 private:
  double xy_m_ = 0.0, yaw_ = 0.0;
};

}  // namespace nav2_adapter
