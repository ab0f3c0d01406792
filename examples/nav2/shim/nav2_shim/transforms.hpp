// SPDX-License-Identifier: MIT
// tf2 for a robot in the plane. The frames "map" and "odom" are the world frame of the trial; "base_link" is the robot,
// whose pose the owner of the buffer sets.
#pragma once

#include <chrono>
#include <cmath>
#include <memory>
#include <nav2_shim/node.hpp>
#include <stdexcept>
#include <string>

namespace tf2 {

using Duration = std::chrono::nanoseconds;
using TimePoint = std::chrono::time_point<std::chrono::system_clock, Duration>;
const TimePoint TimePointZero = TimePoint(Duration(0));

inline Duration durationFromSec(double seconds) {
  return Duration(static_cast<Duration::rep>(seconds * 1e9));
}

struct TransformException : std::runtime_error {
  using std::runtime_error::runtime_error;
};
struct LookupException : TransformException {
  using TransformException::TransformException;
};
struct ExtrapolationException : TransformException {
  using TransformException::TransformException;
};

class Transform;  // named by a header, not used

inline double getYaw(const geometry_msgs::msg::Quaternion& q) {
  return std::atan2(2.0 * (q.w * q.z + q.x * q.y), q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z);
}

class Quaternion {
 public:
  void setRPY(double roll, double pitch, double yaw) {
    const double cr = std::cos(roll / 2.0), sr = std::sin(roll / 2.0);
    const double cp = std::cos(pitch / 2.0), sp = std::sin(pitch / 2.0);
    const double cy = std::cos(yaw / 2.0), sy = std::sin(yaw / 2.0);
    q_.x = sr * cp * cy - cr * sp * sy;
    q_.y = cr * sp * cy + sr * cp * sy;
    q_.z = cr * cp * sy - sr * sp * cy;
    q_.w = cr * cp * cy + sr * sp * sy;
  }
  double x() const { return q_.x; }
  double y() const { return q_.y; }
  double z() const { return q_.z; }
  double w() const { return q_.w; }
  const geometry_msgs::msg::Quaternion& message() const { return q_; }

 private:
  geometry_msgs::msg::Quaternion q_;
};

inline geometry_msgs::msg::Quaternion toMsg(const Quaternion& q) {
  return q.message();
}
inline double getYaw(const Quaternion& q) {
  return getYaw(q.message());
}

// In the plane: the pose's own z stays.
inline void doTransform(const geometry_msgs::msg::Pose& in, geometry_msgs::msg::Pose& out,
                        const geometry_msgs::msg::TransformStamped& transform) {
  const geometry_msgs::msg::Vector3& by = transform.transform.translation;
  const double yaw = getYaw(transform.transform.rotation);
  const double x = in.position.x, y = in.position.y;
  Quaternion turned;
  turned.setRPY(0.0, 0.0, yaw + getYaw(in.orientation));
  out.position.x = by.x + std::cos(yaw) * x - std::sin(yaw) * y;
  out.position.y = by.y + std::sin(yaw) * x + std::cos(yaw) * y;
  out.position.z = in.position.z;
  out.orientation = turned.message();
}
inline void doTransform(const geometry_msgs::msg::PoseStamped& in, geometry_msgs::msg::PoseStamped& out,
                        const geometry_msgs::msg::TransformStamped& transform) {
  doTransform(in.pose, out.pose, transform);
  out.header = transform.header;
}

}  // namespace tf2

namespace tf2_ros {

class Buffer {
 public:
  explicit Buffer(rclcpp::Clock::SharedPtr clock) : clock_(std::move(clock)) {}

  void set_robot_pose(double x, double y, double yaw) { x_ = x, y_ = y, yaw_ = yaw; }

  // The transform that takes a pose in `source` to `target`.
  geometry_msgs::msg::TransformStamped lookupTransform(const std::string& target, const std::string& source,
                                                       const tf2::TimePoint&,
                                                       const tf2::Duration& = tf2::Duration(0)) const {
    geometry_msgs::msg::TransformStamped transform;
    transform.header.frame_id = target;
    transform.header.stamp = clock_->now();
    transform.child_frame_id = source;
    const bool from_robot = is_robot(source), to_robot = is_robot(target);
    if (from_robot == to_robot) return transform;
    const double sign = from_robot ? 1.0 : -1.0;
    tf2::Quaternion rotation;
    rotation.setRPY(0.0, 0.0, sign * yaw_);
    transform.transform.rotation = tf2::toMsg(rotation);
    if (from_robot) {
      transform.transform.translation.x = x_;
      transform.transform.translation.y = y_;
    } else {
      transform.transform.translation.x = -std::cos(yaw_) * x_ - std::sin(yaw_) * y_;
      transform.transform.translation.y = std::sin(yaw_) * x_ - std::cos(yaw_) * y_;
    }
    return transform;
  }
  bool canTransform(const std::string& target, const std::string& source, const tf2::TimePoint&,
                    const tf2::Duration& = tf2::Duration(0), std::string* = nullptr) const {
    return known(target) && known(source);
  }

  geometry_msgs::msg::PoseStamped& transform(const geometry_msgs::msg::PoseStamped& in,
                                             geometry_msgs::msg::PoseStamped& out, const std::string& target,
                                             tf2::Duration timeout = tf2::Duration(0)) const {
    const auto by = lookupTransform(target, in.header.frame_id, tf2::TimePointZero, timeout);
    const auto stamp = in.header.stamp;
    if (is_robot(target) == is_robot(in.header.frame_id)) {
      out = in;
      out.header.frame_id = target;
    } else {
      tf2::doTransform(in, out, by);
    }
    out.header.stamp = stamp;
    return out;
  }
  geometry_msgs::msg::PoseStamped transform(const geometry_msgs::msg::PoseStamped& in, const std::string& target,
                                            tf2::Duration timeout = tf2::Duration(0)) const {
    geometry_msgs::msg::PoseStamped out;
    return transform(in, out, target, timeout);
  }

 private:
  static bool known(const std::string& frame) { return frame == "map" || frame == "odom" || frame == "base_link"; }
  static bool is_robot(const std::string& frame) {
    if (!known(frame))
      throw tf2::LookupException("there is no frame '" + frame + "': map, odom and base_link are known");
    return frame == "base_link";
  }

  rclcpp::Clock::SharedPtr clock_;
  double x_ = 0.0, y_ = 0.0, yaw_ = 0.0;
};

struct TransformListener {
  explicit TransformListener(Buffer&) {}
};
struct TransformBroadcaster {
  explicit TransformBroadcaster(const rclcpp::Node::SharedPtr&) {}
  void sendTransform(const geometry_msgs::msg::TransformStamped&) {}
};

}  // namespace tf2_ros
