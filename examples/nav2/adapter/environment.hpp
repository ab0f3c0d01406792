// SPDX-License-Identifier: MIT
// What a controller of nav2 finds around itself: a node with parameters and a clock, transforms, a costmap. There are
// two implementations, of which one is compiled: shim_environment.cpp, and ros_environment.cpp for a ROS installation.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <nav2_core/controller.hpp>
#include <rclcpp/rclcpp.hpp>
#include <string>
#include <vector>

namespace nav2_adapter {

// The robot, and how the costs around it fall off with the distance from an obstacle.
struct Robot {
  double radius_m;                                  // of a disc
  std::vector<geometry_msgs::msg::Point> vertices;  // of a polygon; none: it is a disc
  double inflation_radius_m, cost_scaling, inscribed_radius_m;
};

struct Costs {
  std::uint32_t width, height;
  double resolution_m, origin_x, origin_y;
  const std::uint8_t* cells;
};

// Receives the way that a controller is going to drive, as it publishes it: poses in the frame of the costmap.
using TrajectorySink = std::function<void(const std::vector<geometry_msgs::msg::Pose>& poses, std::int64_t step_ns)>;

class Environment {
 public:
  virtual ~Environment() = default;

  virtual rclcpp_lifecycle::LifecycleNode::SharedPtr node() = 0;
  virtual std::shared_ptr<tf2_ros::Buffer> transforms() = 0;
  virtual std::shared_ptr<nav2_costmap_2d::Costmap2DROS> costmap() = 0;
  // A controller of this class, not configured. Throws if there is none.
  virtual std::shared_ptr<nav2_core::Controller> make(const std::string& class_name) = 0;

  virtual void set_robot(const Robot& robot) = 0;  // once, before anything is asked for
  virtual void set_time(std::int64_t now_ns) = 0;
  virtual void set_robot_pose(double x, double y, double yaw) = 0;
  virtual void set_costs(const Costs& costs) = 0;

  // From now on `sink` gets what controllers publish. Poses of messages without times are 0 ns apart.
  virtual void watch_trajectories(const TrajectorySink& sink) = 0;

  // The parameters that have been declared; for telling which of the file's keys nobody reads.
  virtual std::vector<std::string> declared_parameters() = 0;
};

std::unique_ptr<Environment> make_environment(const std::vector<rclcpp::Parameter>& parameters);

// Where the log lines of this thread go from now on; nullptr: nowhere. `place` is the same for all lines of a statement.
using LogSink = std::function<void(bool is_error, const char* place, const std::string& line)>;
void set_log_sink(const LogSink* sink);

}  // namespace nav2_adapter
