// SPDX-License-Identifier: MIT
// A controller as one writes it for nav2: it steers at a point of the plan ahead.
#include <algorithm>
#include <cmath>
#include <nav2_core/controller.hpp>
#include <nav2_core/controller_exceptions.hpp>
#include <nav2_util/geometry_utils.hpp>
#include <nav2_util/node_utils.hpp>
#include <pluginlib/class_list_macros.hpp>
#include <tf2/utils.hpp>

namespace my_controller {

class FollowTheLine : public nav2_core::Controller {
 public:
  void configure(const rclcpp_lifecycle::LifecycleNode::WeakPtr& parent, std::string name,
                 std::shared_ptr<tf2_ros::Buffer> transforms,
                 std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap) override;
  void cleanup() override {}
  void activate() override {}
  void deactivate() override {}
  void setPlan(const nav_msgs::msg::Path& plan) override { plan_ = plan; }
  void setSpeedLimit(const double&, const bool&) override {}
  geometry_msgs::msg::TwistStamped computeVelocityCommands(const geometry_msgs::msg::PoseStamped& pose,
                                                           const geometry_msgs::msg::Twist& velocity,
                                                           nav2_core::GoalChecker* goal_checker) override;

 private:
  std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap_;
  nav_msgs::msg::Path plan_;
  double speed_ = 0.0, look_ahead_m_ = 0.0;
};

void FollowTheLine::configure(const rclcpp_lifecycle::LifecycleNode::WeakPtr& parent, std::string name,
                              std::shared_ptr<tf2_ros::Buffer>,
                              std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap) {
  const auto node = parent.lock();
  costmap_ = costmap;
  nav2_util::declare_parameter_if_not_declared(node, name + ".speed", rclcpp::ParameterValue(0.4));
  nav2_util::declare_parameter_if_not_declared(node, name + ".look_ahead", rclcpp::ParameterValue(0.6));
  node->get_parameter(name + ".speed", speed_);
  node->get_parameter(name + ".look_ahead", look_ahead_m_);
}

geometry_msgs::msg::TwistStamped FollowTheLine::computeVelocityCommands(const geometry_msgs::msg::PoseStamped& pose,
                                                                        const geometry_msgs::msg::Twist&,
                                                                        nav2_core::GoalChecker*) {
  using nav2_util::geometry_utils::euclidean_distance;
  const auto nearest = nav2_util::geometry_utils::min_by(
      plan_.poses.begin(), plan_.poses.end(),
      [&](const geometry_msgs::msg::PoseStamped& point) { return euclidean_distance(point, pose); });
  const auto carrot = std::find_if(nearest, plan_.poses.end() - 1, [&](const geometry_msgs::msg::PoseStamped& point) {
    return euclidean_distance(point, pose) > look_ahead_m_;
  });

  unsigned int column = 0, row = 0;
  if (costmap_->getCostmap()->worldToMap(carrot->pose.position.x, carrot->pose.position.y, column, row) &&
      costmap_->getCostmap()->getCost(column, row) >= nav2_costmap_2d::INSCRIBED_INFLATED_OBSTACLE)
    throw nav2_core::NoValidControl("something stands on the line");

  const double bearing =
      std::atan2(carrot->pose.position.y - pose.pose.position.y, carrot->pose.position.x - pose.pose.position.x);
  const double error = std::remainder(bearing - tf2::getYaw(pose.pose.orientation), 2.0 * M_PI);
  geometry_msgs::msg::TwistStamped command;
  command.header = pose.header;
  command.twist.angular.z = 2.0 * error;
  command.twist.linear.x = speed_ * std::max(0.0, std::cos(error));
  return command;
}

}  // namespace my_controller

PLUGINLIB_EXPORT_CLASS(my_controller::FollowTheLine, nav2_core::Controller)
