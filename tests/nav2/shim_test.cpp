// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <memory>
#include <nav2_shim/angles.hpp>
#include <nav2_shim/node.hpp>
#include <nav2_shim/pluginlib.hpp>
#include <nav2_shim/transforms.hpp>
#include <string>
#include <type_traits>
#include <vector>

// nav2's sources say abs() of floating-point numbers: it must not be that of integers.
static_assert(std::is_same_v<decltype(abs(1.5)), double>);
static_assert(std::is_same_v<decltype(abs(1.5F)), float>);

namespace {

struct Shape {
  virtual ~Shape() = default;
  virtual int corners() const = 0;
};
struct Triangle : Shape {
  int corners() const override { return 3; }
};
PLUGINLIB_EXPORT_CLASS(Triangle, Shape)

rclcpp::Node::SharedPtr node_with(const std::vector<rclcpp::Parameter>& overrides) {
  return std::make_shared<rclcpp::Node>("node", rclcpp::NodeOptions().parameter_overrides(overrides));
}

}  // namespace

TEST_CASE("A parameter has its default, or the value that overrides it") {
  const auto node = node_with({{"speed", 0.8}, {"names", std::vector<std::string>{"a", "b"}}});
  double speed = 0.0;
  CHECK_FALSE(node->get_parameter("speed", speed));  // not declared yet
  node->declare_parameter("speed", rclcpp::ParameterValue(0.5));
  node->declare_parameter("samples", rclcpp::ParameterValue(20));
  node->declare_parameter("names", rclcpp::PARAMETER_STRING_ARRAY);
  node->declare_parameter("nothing", rclcpp::PARAMETER_DOUBLE);

  REQUIRE(node->get_parameter("speed", speed));
  CHECK(speed == 0.8);
  CHECK(node->get_parameter("samples").as_int() == 20);
  CHECK(node->get_parameter("names").as_string_array() == std::vector<std::string>{"a", "b"});
  CHECK_FALSE(node->get_parameter("nothing", speed));
  CHECK_THROWS_AS(node->get_parameter("nothing"), rclcpp::exceptions::ParameterUninitializedException);
  CHECK_THROWS_AS(node->get_parameter("other"), rclcpp::exceptions::ParameterNotDeclaredException);
}

TEST_CASE("A parameter of another type or out of its range is an error that names it") {
  const auto node = node_with({{"speed", 1}, {"share", 1.5}});
  CHECK_THROWS_WITH(node->declare_parameter("speed", rclcpp::ParameterValue(0.5)),
                    "parameter 'speed' has invalid type: expected [double] got [integer]");
  rcl_interfaces::msg::ParameterDescriptor descriptor;
  descriptor.floating_point_range.resize(1);
  descriptor.floating_point_range[0].to_value = 1.0;
  CHECK_THROWS_WITH(node->declare_parameter("share", rclcpp::ParameterValue(0.5), descriptor),
                    "parameter 'share' is out of its range: 1.5");
}

TEST_CASE("A callback can refuse a change of parameters until it is removed") {
  const auto node = node_with({});
  node->declare_parameter("speed", 0.5);
  const auto refusal = node->add_on_set_parameters_callback([](const std::vector<rclcpp::Parameter>&) {
    rcl_interfaces::msg::SetParametersResult result;
    result.reason = "no";
    return result;
  });
  CHECK(node->set_parameter({"speed", 0.7}).reason == "no");
  CHECK(node->get_parameter("speed").as_double() == 0.5);
  node->remove_on_set_parameters_callback(refusal.get());
  CHECK(node->set_parameter({"speed", 0.7}).successful);
  CHECK(node->get_parameter("speed").as_double() == 0.7);
}

TEST_CASE("A message reaches the node's own subscriptions") {
  const auto node = std::make_shared<rclcpp_lifecycle::LifecycleNode>("node");
  const auto publisher = node->create_publisher<nav_msgs::msg::Path>("plan", 1);
  CHECK(publisher->get_subscription_count() == 0);
  std::size_t poses = 0;
  const auto subscription = node->create_subscription<nav_msgs::msg::Path>(
      "plan", 1, [&](const nav_msgs::msg::Path& path) { poses = path.poses.size(); });
  nav_msgs::msg::Path path;
  path.poses.resize(3);
  publisher->publish(path);
  CHECK(publisher->get_subscription_count() == 1);
  CHECK(poses == 3);
}

TEST_CASE("A pose goes to the robot's frame and back") {
  tf2_ros::Buffer transforms(std::make_shared<rclcpp::Clock>());
  transforms.set_robot_pose(2.0, 1.0, angles::pi / 2.0);
  geometry_msgs::msg::PoseStamped ahead;
  ahead.header.frame_id = "map";
  ahead.pose.position.x = 2.0;
  ahead.pose.position.y = 4.0;

  const auto seen = transforms.transform(ahead, "base_link");
  CHECK(seen.header.frame_id == "base_link");
  CHECK(seen.pose.position.x == Approx(3.0));
  CHECK(seen.pose.position.y == Approx(0.0).margin(1e-12));
  CHECK(tf2::getYaw(seen.pose.orientation) == Approx(-angles::pi / 2.0));

  const auto back = transforms.transform(seen, "odom");
  CHECK(back.pose.position.x == Approx(2.0));
  CHECK(back.pose.position.y == Approx(4.0));
  CHECK(tf2::getYaw(back.pose.orientation) == Approx(0.0).margin(1e-12));
  CHECK(transforms.transform(ahead, "odom").pose == ahead.pose);  // the same frame: not a bit differs
  CHECK_THROWS_AS(transforms.transform(ahead, "laser"), tf2::TransformException);
}

TEST_CASE("Times and durations become messages and come back") {
  const rclcpp::Time time(3, 500'000'000);
  const builtin_interfaces::msg::Time message = time;
  CHECK(rclcpp::Time(message) == time);
  CHECK((time - rclcpp::Time(1, 0)).seconds() == 2.5);
  const builtin_interfaces::msg::Duration before = rclcpp::Duration::from_seconds(-0.25);
  CHECK(before.sec == -1);
  CHECK(before.nanosec == 750'000'000);
}

TEST_CASE("A class is found by its name") {
  const pluginlib::ClassLoader<Shape> shapes("package", "Shape");
  CHECK(shapes.createUniqueInstance("Triangle")->corners() == 3);
  CHECK_THROWS_WITH(shapes.createSharedInstance("Square"), Catch::Contains("it has Triangle"));
}

TEST_CASE("Angles are normalized") {
  CHECK(angles::shortest_angular_distance(3.0, -3.0) == Approx(2.0 * angles::pi - 6.0));
  CHECK(angles::normalize_angle_positive(-1.0) == Approx(2.0 * angles::pi - 1.0));
}
