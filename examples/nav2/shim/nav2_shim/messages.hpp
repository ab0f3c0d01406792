// SPDX-License-Identifier: MIT
// The messages that nav2's controllers read and write, with the fields that they use. As in ROS, numbers are zero and a
// quaternion is no rotation until they are set.
#pragma once

// nav2 calls abs() without std: these two headers bring its overloads for floating-point numbers.
#include <math.h>
#include <stdlib.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace nav2_shim {

// The pointer types of every message.
template <class Message>
struct Pointers {
  using SharedPtr = std::shared_ptr<Message>;
  using ConstSharedPtr = std::shared_ptr<const Message>;
  using UniquePtr = std::unique_ptr<Message>;
};

}  // namespace nav2_shim

namespace builtin_interfaces::msg {

struct Time {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  bool operator==(const Time& b) const { return sec == b.sec && nanosec == b.nanosec; }
};
struct Duration {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  bool operator==(const Duration& b) const { return sec == b.sec && nanosec == b.nanosec; }
};

}  // namespace builtin_interfaces::msg

namespace std_msgs::msg {

struct Header {
  builtin_interfaces::msg::Time stamp;
  std::string frame_id;
  bool operator==(const Header& b) const { return stamp == b.stamp && frame_id == b.frame_id; }
};
struct Bool : nav2_shim::Pointers<Bool> {
  bool data = false;
};
struct ColorRGBA {
  float r = 0.0F, g = 0.0F, b = 0.0F, a = 0.0F;
  bool operator==(const ColorRGBA& o) const { return r == o.r && g == o.g && b == o.b && a == o.a; }
};

}  // namespace std_msgs::msg

namespace geometry_msgs::msg {

struct Point {
  double x = 0.0, y = 0.0, z = 0.0;
  bool operator==(const Point& b) const { return x == b.x && y == b.y && z == b.z; }
  bool operator!=(const Point& b) const { return !(*this == b); }
};
struct Point32 {
  float x = 0.0F, y = 0.0F, z = 0.0F;
};
struct Vector3 {
  double x = 0.0, y = 0.0, z = 0.0;
  bool operator==(const Vector3& b) const { return x == b.x && y == b.y && z == b.z; }
};
struct Quaternion {
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
  bool operator==(const Quaternion& b) const { return x == b.x && y == b.y && z == b.z && w == b.w; }
  bool operator!=(const Quaternion& b) const { return !(*this == b); }
};
struct Pose : nav2_shim::Pointers<Pose> {
  Point position;
  Quaternion orientation;
  bool operator==(const Pose& b) const { return position == b.position && orientation == b.orientation; }
  bool operator!=(const Pose& b) const { return !(*this == b); }
};
struct Pose2D {
  double x = 0.0, y = 0.0, theta = 0.0;
};
struct PoseStamped : nav2_shim::Pointers<PoseStamped> {
  std_msgs::msg::Header header;
  Pose pose;
  bool operator==(const PoseStamped& b) const { return header == b.header && pose == b.pose; }
  bool operator!=(const PoseStamped& b) const { return !(*this == b); }
};
struct PointStamped : nav2_shim::Pointers<PointStamped> {
  std_msgs::msg::Header header;
  Point point;
};
struct Twist : nav2_shim::Pointers<Twist> {
  Vector3 linear;
  Vector3 angular;
};
struct TwistStamped : nav2_shim::Pointers<TwistStamped> {
  std_msgs::msg::Header header;
  Twist twist;
};
struct Transform {
  Vector3 translation;
  Quaternion rotation;
};
struct TransformStamped {
  std_msgs::msg::Header header;
  std::string child_frame_id;
  Transform transform;
};
struct Polygon : nav2_shim::Pointers<Polygon> {
  std::vector<Point32> points;
};
struct PolygonStamped : nav2_shim::Pointers<PolygonStamped> {
  std_msgs::msg::Header header;
  Polygon polygon;
};
struct PoseWithCovariance {
  Pose pose;
  std::array<double, 36> covariance{};
};
struct TwistWithCovariance {
  Twist twist;
  std::array<double, 36> covariance{};
};

}  // namespace geometry_msgs::msg

namespace nav_msgs::msg {

struct Path : nav2_shim::Pointers<Path> {
  std_msgs::msg::Header header;
  std::vector<geometry_msgs::msg::PoseStamped> poses;
};
struct Odometry : nav2_shim::Pointers<Odometry> {
  std_msgs::msg::Header header;
  std::string child_frame_id;
  geometry_msgs::msg::PoseWithCovariance pose;
  geometry_msgs::msg::TwistWithCovariance twist;
};
struct MapMetaData {
  builtin_interfaces::msg::Time map_load_time;
  float resolution = 0.0F;
  std::uint32_t width = 0, height = 0;
  geometry_msgs::msg::Pose origin;
};
struct OccupancyGrid : nav2_shim::Pointers<OccupancyGrid> {
  std_msgs::msg::Header header;
  MapMetaData info;
  std::vector<std::int8_t> data;
};

}  // namespace nav_msgs::msg

namespace nav2_msgs::msg {

struct TrajectoryPoint {
  builtin_interfaces::msg::Duration time_from_start;
  geometry_msgs::msg::Pose pose;
  geometry_msgs::msg::Twist velocity;
};
struct Trajectory : nav2_shim::Pointers<Trajectory> {
  std_msgs::msg::Header header;
  std::vector<TrajectoryPoint> points;
};
struct CriticsStats : nav2_shim::Pointers<CriticsStats> {
  builtin_interfaces::msg::Time stamp;
  std::vector<std::string> critics;
  std::vector<bool> changed;
  std::vector<float> costs_sum;
};
struct WaypointStatus {
  static constexpr std::uint8_t PENDING = 0;
  std::uint8_t waypoint_status = PENDING;
  std::uint32_t waypoint_index = 0;
  geometry_msgs::msg::PoseStamped waypoint_pose;
};

}  // namespace nav2_msgs::msg

namespace nav_2d_msgs::msg {

struct Twist2D {
  double x = 0.0, y = 0.0, theta = 0.0;
};
struct Twist2DStamped {
  std_msgs::msg::Header header;
  Twist2D velocity;
};
struct Pose2DStamped {
  std_msgs::msg::Header header;
  geometry_msgs::msg::Pose2D pose;
};
struct Path2D {
  std_msgs::msg::Header header;
  std::vector<geometry_msgs::msg::Pose2D> poses;
};

}  // namespace nav_2d_msgs::msg

namespace dwb_msgs::msg {

struct CriticScore {
  std::string name;
  float raw_score = 0.0F, scale = 0.0F;
};
struct Trajectory2D {
  nav_2d_msgs::msg::Twist2D velocity;
  std::vector<builtin_interfaces::msg::Duration> time_offsets;
  std::vector<geometry_msgs::msg::Pose2D> poses;
};
struct TrajectoryScore {
  Trajectory2D traj;
  std::vector<CriticScore> scores;
  float total = 0.0F;
};
struct LocalPlanEvaluation : nav2_shim::Pointers<LocalPlanEvaluation> {
  std_msgs::msg::Header header;
  std::vector<TrajectoryScore> twists;
  std::uint16_t best_index = 0, worst_index = 0;
};

}  // namespace dwb_msgs::msg

namespace visualization_msgs::msg {

struct Marker : nav2_shim::Pointers<Marker> {
  static constexpr std::int32_t SPHERE = 2, LINE_STRIP = 4, ADD = 0;
  std_msgs::msg::Header header;
  std::string ns;
  std::int32_t id = 0, type = 0, action = 0;
  geometry_msgs::msg::Pose pose;
  geometry_msgs::msg::Vector3 scale;
  std_msgs::msg::ColorRGBA color;
  builtin_interfaces::msg::Duration lifetime;
  std::vector<geometry_msgs::msg::Point> points;
};
struct MarkerArray : nav2_shim::Pointers<MarkerArray> {
  std::vector<Marker> markers;
};

}  // namespace visualization_msgs::msg

namespace sensor_msgs {
namespace msg {

struct PointField {
  static constexpr std::uint8_t FLOAT32 = 7;
  std::string name;
  std::uint32_t offset = 0, count = 0;
  std::uint8_t datatype = 0;
};
struct PointCloud2 : nav2_shim::Pointers<PointCloud2> {
  std_msgs::msg::Header header;
  std::uint32_t height = 0, width = 0, point_step = 0, row_step = 0;
  std::vector<PointField> fields;
  bool is_bigendian = false, is_dense = false;
  std::vector<std::uint8_t> data;
};

}  // namespace msg

// Steps from point to point through one field of a cloud.
template <class Value>
class PointCloud2Iterator {
 public:
  PointCloud2Iterator(msg::PointCloud2& cloud, const std::string& field) : step_(cloud.point_step) {
    for (const msg::PointField& candidate : cloud.fields)
      if (candidate.name == field) at_ = cloud.data.data() + candidate.offset;
  }
  Value& operator*() const { return *reinterpret_cast<Value*>(at_); }
  PointCloud2Iterator& operator++() { return at_ += step_, *this; }

 private:
  std::uint8_t* at_ = nullptr;
  std::uint32_t step_;
};

}  // namespace sensor_msgs

namespace rcl_interfaces::msg {

struct ParameterType {
  static constexpr std::uint8_t PARAMETER_NOT_SET = 0, PARAMETER_BOOL = 1, PARAMETER_INTEGER = 2, PARAMETER_DOUBLE = 3,
                                PARAMETER_STRING = 4, PARAMETER_BYTE_ARRAY = 5, PARAMETER_BOOL_ARRAY = 6,
                                PARAMETER_INTEGER_ARRAY = 7, PARAMETER_DOUBLE_ARRAY = 8, PARAMETER_STRING_ARRAY = 9;
};
struct SetParametersResult {
  bool successful = false;
  std::string reason;
};
struct FloatingPointRange {
  double from_value = 0.0, to_value = 0.0, step = 0.0;
};
struct IntegerRange {
  std::int64_t from_value = 0, to_value = 0;
  std::uint64_t step = 0;
};
struct ParameterDescriptor {
  std::string name, description, additional_constraints;
  std::uint8_t type = 0;
  bool read_only = false, dynamic_typing = false;
  std::vector<FloatingPointRange> floating_point_range;
  std::vector<IntegerRange> integer_range;
};

}  // namespace rcl_interfaces::msg
