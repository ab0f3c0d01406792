// SPDX-License-Identifier: MIT
// nav2's costmap node with the interface that controllers use. It subscribes to nothing: its owner fills the map and
// sets the footprint. Map, layers and footprint functions are nav2's own.
#pragma once

#include <memory>
#include <nav2_costmap_2d/costmap_2d.hpp>
#include <nav2_costmap_2d/footprint.hpp>
#include <nav2_costmap_2d/footprint_collision_checker.hpp>
#include <nav2_costmap_2d/layer.hpp>
#include <nav2_costmap_2d/layered_costmap.hpp>
#include <nav2_shim/transforms.hpp>
#include <nav2_util/lifecycle_node.hpp>
#include <string>
#include <vector>

namespace nav2_costmap_2d {

class Costmap2DROS : public nav2_util::LifecycleNode {
 public:
  explicit Costmap2DROS(const rclcpp::NodeOptions& options = rclcpp::NodeOptions());
  explicit Costmap2DROS(const std::string& name, const std::string& space = "/", bool use_sim_time = false);

  // A map of nav2's default size.
  nav2_util::CallbackReturn on_configure(const rclcpp_lifecycle::State&);
  nav2_util::CallbackReturn on_activate(const rclcpp_lifecycle::State&) { return nav2_util::CallbackReturn::SUCCESS; }
  nav2_util::CallbackReturn on_deactivate(const rclcpp_lifecycle::State&) { return nav2_util::CallbackReturn::SUCCESS; }
  nav2_util::CallbackReturn on_cleanup(const rclcpp_lifecycle::State&) { return nav2_util::CallbackReturn::SUCCESS; }

  // What its owner sets, beside the map itself: how costs fall off with the distance from an obstacle, and the robot.
  void set_inflation(double radius_m, double cost_scaling_per_m, double inscribed_radius_m);
  void set_robot_radius(double radius_m);
  void set_robot_polygon(const std::vector<geometry_msgs::msg::Point>& points);
  void setRobotFootprint(const std::vector<geometry_msgs::msg::Point>& points);

  Costmap2D* getCostmap() { return layered_.getCostmap(); }
  LayeredCostmap* getLayeredCostmap() { return &layered_; }
  std::string getName() const { return get_name(); }
  std::string getGlobalFrameID() const { return "odom"; }
  std::string getBaseFrameID() const { return "base_link"; }
  double getTransformTolerance() const { return 0.3; }
  bool isCurrent() const { return true; }
  bool getUseRadius() const { return use_radius_; }
  double getRobotRadius() const { return radius_m_; }
  std::shared_ptr<tf2_ros::Buffer> getTfBuffer() { return transforms_; }
  bool getRobotPose(geometry_msgs::msg::PoseStamped& pose);
  bool transformPoseToGlobalFrame(const geometry_msgs::msg::PoseStamped& in, geometry_msgs::msg::PoseStamped& out);
  const std::vector<geometry_msgs::msg::Point>& getRobotFootprint() const { return padded_; }
  const std::vector<geometry_msgs::msg::Point>& getUnpaddedRobotFootprint() const { return unpadded_; }
  geometry_msgs::msg::Polygon getRobotFootprintPolygon() const { return toPolygon(padded_); }
  void getOrientedFootprint(std::vector<geometry_msgs::msg::Point>& oriented);

 private:
  class Inflated;

  LayeredCostmap layered_;
  std::shared_ptr<Inflated> inflated_;
  std::shared_ptr<tf2_ros::Buffer> transforms_;
  std::vector<geometry_msgs::msg::Point> unpadded_, padded_;
  bool use_radius_ = true;
  double radius_m_ = 0.0;
};

}  // namespace nav2_costmap_2d
