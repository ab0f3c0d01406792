// SPDX-License-Identifier: MIT
// For a ROS installation (NAV2_FROM_ROS): the real node, transforms, costmap and class loader. Untested: see README.md.
#include <tf2_ros/buffer.h>

#include <adapter/environment.hpp>
#include <algorithm>
#include <nav2_util/geometry_utils.hpp>
#include <pluginlib/class_loader.hpp>
#include <stdexcept>

namespace nav2_adapter {

namespace {

class RosEnvironment final : public Environment {
 public:
  explicit RosEnvironment(const std::vector<rclcpp::Parameter>& parameters)
      : node_(std::make_shared<rclcpp_lifecycle::LifecycleNode>(
            "controller_server", rclcpp::NodeOptions().use_global_arguments(false).parameter_overrides(parameters))),
        transforms_(std::make_shared<tf2_ros::Buffer>(node_->get_clock())),
        costmap_(std::make_shared<nav2_costmap_2d::Costmap2DROS>("local_costmap")) {
    transforms_->setUsingDedicatedThread(true);
    set_transform("map", "odom", 0.0, 0.0, 0.0);
  }

  rclcpp_lifecycle::LifecycleNode::SharedPtr node() override { return node_; }
  std::shared_ptr<tf2_ros::Buffer> transforms() override { return transforms_; }
  std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap() override { return costmap_; }
  std::shared_ptr<nav2_core::Controller> make(const std::string& class_name) override {
    return loader_.createSharedInstance(class_name);
  }

  void set_time(std::int64_t now_ns) override {
    const auto clock = node_->get_clock();
    if (rcl_enable_ros_time_override(clock->get_clock_handle()) != RCL_RET_OK ||
        rcl_set_ros_time_override(clock->get_clock_handle(), now_ns) != RCL_RET_OK)
      throw std::runtime_error("the clock of the node cannot be set");
  }
  void set_robot_pose(double x, double y, double yaw) override { set_transform("odom", "base_link", x, y, yaw); }
  void set_costs(const Costs& costs) override {
    nav2_costmap_2d::Costmap2D& map = *costmap_->getCostmap();
    map.resizeMap(costs.width, costs.height, costs.resolution_m, costs.origin_x, costs.origin_y);
    std::copy_n(costs.cells, std::size_t{costs.width} * costs.height, map.getCharMap());
  }
  void set_robot(const Robot& robot) override {
    costmap_->declare_parameter("inflation_layer.plugin", rclcpp::ParameterValue("nav2_costmap_2d::InflationLayer"));
    costmap_->declare_parameter("inflation_layer.inflation_radius", rclcpp::ParameterValue(robot.inflation_radius_m));
    costmap_->declare_parameter("inflation_layer.cost_scaling_factor", rclcpp::ParameterValue(robot.cost_scaling));
    costmap_->set_parameters({rclcpp::Parameter("plugins", std::vector<std::string>{"inflation_layer"}),
                              rclcpp::Parameter("global_frame", "odom"), rclcpp::Parameter("rolling_window", true),
                              rclcpp::Parameter("robot_radius", robot.radius_m)});
    if (!robot.vertices.empty()) costmap_->set_parameter(rclcpp::Parameter("footprint", text(robot.vertices)));
    costmap_->on_configure(rclcpp_lifecycle::State());
  }

  void watch_trajectories(const TrajectorySink&) override {}  // ROS's own tools show them

  std::vector<std::string> declared_parameters() override { return node_->list_parameters({}, 0).names; }

 private:
  static std::string text(const std::vector<geometry_msgs::msg::Point>& vertices) {
    std::string out = "[";
    for (const auto& vertex : vertices)
      out += (out == "[" ? "[" : ", [") + std::to_string(vertex.x) + ", " + std::to_string(vertex.y) + "]";
    return out + "]";
  }
  void set_transform(const char* parent, const char* child, double x, double y, double yaw) {
    geometry_msgs::msg::TransformStamped transform;
    transform.header.frame_id = parent;
    transform.child_frame_id = child;
    transform.transform.translation.x = x;
    transform.transform.translation.y = y;
    transform.transform.rotation = nav2_util::geometry_utils::orientationAroundZAxis(yaw);
    transforms_->setTransform(transform, "dmrp", true);  // the latest alone counts
  }

  rclcpp_lifecycle::LifecycleNode::SharedPtr node_;
  std::shared_ptr<tf2_ros::Buffer> transforms_;
  std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap_;
  pluginlib::ClassLoader<nav2_core::Controller> loader_{"nav2_core", "nav2_core::Controller"};
};

}  // namespace

std::unique_ptr<Environment> make_environment(const std::vector<rclcpp::Parameter>& parameters) {
  if (!rclcpp::ok()) rclcpp::init(0, nullptr);
  return std::make_unique<RosEnvironment>(parameters);
}

void set_log_sink(const LogSink*) {}  // ROS logs itself

}  // namespace nav2_adapter
