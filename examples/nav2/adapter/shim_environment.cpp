// SPDX-License-Identifier: MIT
#include <adapter/environment.hpp>
#include <algorithm>
#include <pluginlib/class_loader.hpp>

namespace nav2_adapter {

namespace {

class ShimEnvironment final : public Environment {
 public:
  explicit ShimEnvironment(const std::vector<rclcpp::Parameter>& parameters)
      : node_(std::make_shared<rclcpp_lifecycle::LifecycleNode>("controller_server",
                                                                rclcpp::NodeOptions().parameter_overrides(parameters))),
        costmap_(std::make_shared<nav2_costmap_2d::Costmap2DROS>()) {}

  rclcpp_lifecycle::LifecycleNode::SharedPtr node() override { return node_; }
  std::shared_ptr<tf2_ros::Buffer> transforms() override { return costmap_->getTfBuffer(); }
  std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap() override { return costmap_; }
  std::shared_ptr<nav2_core::Controller> make(const std::string& class_name) override {
    return loader_.createSharedInstance(class_name);
  }

  void set_robot(const Robot& robot) override {
    costmap_->set_inflation(robot.inflation_radius_m, robot.cost_scaling, robot.inscribed_radius_m);
    if (robot.vertices.empty()) {
      costmap_->set_robot_radius(robot.radius_m);
    } else {
      costmap_->set_robot_polygon(robot.vertices);
    }
  }
  void set_time(std::int64_t now_ns) override {
    node_->get_clock()->set(now_ns);
    costmap_->get_clock()->set(now_ns);
  }
  void set_robot_pose(double x, double y, double yaw) override { transforms()->set_robot_pose(x, y, yaw); }
  void set_costs(const Costs& costs) override {
    nav2_costmap_2d::LayeredCostmap& layers = *costmap_->getLayeredCostmap();
    layers.resizeMap(costs.width, costs.height, costs.resolution_m, costs.origin_x, costs.origin_y);
    std::copy_n(costs.cells, std::size_t{costs.width} * costs.height, layers.getCostmap()->getCharMap());
  }

  void watch_trajectories(const TrajectorySink& sink) override {
    const auto take_path = [this, sink](const nav_msgs::msg::Path& path) {
      std::vector<geometry_msgs::msg::Pose> poses;
      for (const auto& pose : path.poses) poses.push_back(in_costmap(pose, path.header.frame_id));
      sink(poses, 0);
    };
    for (const char* topic : {"local_plan", "lookahead_collision_arc"})  // of DWB and Graceful, of RPP
      node_->create_subscription<nav_msgs::msg::Path>(topic, 1, take_path);
    const auto take_trajectory = [sink](const nav2_msgs::msg::Trajectory& trajectory) {
      std::vector<geometry_msgs::msg::Pose> poses;
      for (const auto& point : trajectory.points) poses.push_back(point.pose);
      if (poses.size() < 2) return;
      const auto& step = trajectory.points[1].time_from_start;
      sink(poses, std::int64_t{step.sec} * 1'000'000'000 + step.nanosec);
    };
    node_->create_subscription<nav2_msgs::msg::Trajectory>("~/optimal_trajectory", 1, take_trajectory);  // of MPPI
  }

  std::vector<std::string> declared_parameters() override {
    std::vector<std::string> names;
    for (const auto& [name, value] : node_->declared_parameters()) names.push_back(name);
    return names;
  }

 private:
  geometry_msgs::msg::Pose in_costmap(const geometry_msgs::msg::PoseStamped& pose, const std::string& frame) {
    if (frame != costmap_->getBaseFrameID()) return pose.pose;
    geometry_msgs::msg::PoseStamped out;
    tf2::doTransform(pose, out, transforms()->lookupTransform(costmap_->getGlobalFrameID(), frame, tf2::TimePointZero));
    return out.pose;
  }

  rclcpp_lifecycle::LifecycleNode::SharedPtr node_;
  std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap_;
  pluginlib::ClassLoader<nav2_core::Controller> loader_{"nav2_core", "nav2_core::Controller"};
};

}  // namespace

std::unique_ptr<Environment> make_environment(const std::vector<rclcpp::Parameter>& parameters) {
  return std::make_unique<ShimEnvironment>(parameters);
}

void set_log_sink(const LogSink* sink) {
  nav2_shim::log_sink() = sink;
}

}  // namespace nav2_adapter
