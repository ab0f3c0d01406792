// SPDX-License-Identifier: MIT
// rclcpp's points in time, durations and clock, in nanoseconds. A clock stands still until its owner sets it: in a
// trial the simulated time.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <nav2_shim/messages.hpp>

enum rcl_clock_type_t { RCL_CLOCK_UNINITIALIZED, RCL_ROS_TIME, RCL_SYSTEM_TIME, RCL_STEADY_TIME };

namespace nav2_shim {

constexpr std::int64_t second_ns = 1'000'000'000;

template <class Message>
Message in_seconds(std::int64_t ns) {
  Message message;
  const std::int64_t below_s = ((ns % second_ns) + second_ns) % second_ns;
  message.nanosec = static_cast<std::uint32_t>(below_s);
  message.sec = static_cast<std::int32_t>((ns - below_s) / second_ns);
  return message;
}

}  // namespace nav2_shim

namespace rclcpp {

class Duration {
 public:
  Duration(std::int32_t sec, std::uint32_t nanosec) : ns_(sec * nav2_shim::second_ns + nanosec) {}
  Duration(const builtin_interfaces::msg::Duration& message) : Duration(message.sec, message.nanosec) {}
  template <class Count, class Period>
  Duration(const std::chrono::duration<Count, Period>& duration)
      : ns_(std::chrono::duration_cast<std::chrono::nanoseconds>(duration).count()) {}

  static Duration from_nanoseconds(std::int64_t ns) { return std::chrono::nanoseconds(ns); }
  static Duration from_seconds(double seconds) { return from_nanoseconds(static_cast<std::int64_t>(seconds * 1e9)); }
  std::int64_t nanoseconds() const { return ns_; }
  double seconds() const { return static_cast<double>(ns_) * 1e-9; }

  operator builtin_interfaces::msg::Duration() const {
    return nav2_shim::in_seconds<builtin_interfaces::msg::Duration>(ns_);
  }
  bool operator==(const Duration& b) const { return ns_ == b.ns_; }
  bool operator!=(const Duration& b) const { return ns_ != b.ns_; }
  bool operator<(const Duration& b) const { return ns_ < b.ns_; }
  bool operator<=(const Duration& b) const { return ns_ <= b.ns_; }
  bool operator>(const Duration& b) const { return ns_ > b.ns_; }
  bool operator>=(const Duration& b) const { return ns_ >= b.ns_; }
  Duration operator+(const Duration& b) const { return from_nanoseconds(ns_ + b.ns_); }
  Duration operator-(const Duration& b) const { return from_nanoseconds(ns_ - b.ns_); }

 private:
  std::int64_t ns_;
};

class Time {
 public:
  Time(std::int32_t sec, std::uint32_t nanosec, rcl_clock_type_t = RCL_SYSTEM_TIME)
      : ns_(sec * nav2_shim::second_ns + nanosec) {}
  explicit Time(std::int64_t ns = 0, rcl_clock_type_t = RCL_SYSTEM_TIME) : ns_(ns) {}
  Time(const builtin_interfaces::msg::Time& message, rcl_clock_type_t = RCL_ROS_TIME)
      : Time(message.sec, message.nanosec) {}

  std::int64_t nanoseconds() const { return ns_; }
  double seconds() const { return static_cast<double>(ns_) * 1e-9; }

  operator builtin_interfaces::msg::Time() const { return nav2_shim::in_seconds<builtin_interfaces::msg::Time>(ns_); }
  bool operator==(const Time& b) const { return ns_ == b.ns_; }
  bool operator!=(const Time& b) const { return ns_ != b.ns_; }
  bool operator<(const Time& b) const { return ns_ < b.ns_; }
  bool operator<=(const Time& b) const { return ns_ <= b.ns_; }
  bool operator>(const Time& b) const { return ns_ > b.ns_; }
  bool operator>=(const Time& b) const { return ns_ >= b.ns_; }
  Duration operator-(const Time& b) const { return Duration::from_nanoseconds(ns_ - b.ns_); }
  Time operator-(const Duration& b) const { return Time(ns_ - b.nanoseconds()); }
  Time operator+(const Duration& b) const { return Time(ns_ + b.nanoseconds()); }

 private:
  std::int64_t ns_;
};

class Clock {
 public:
  using SharedPtr = std::shared_ptr<Clock>;

  explicit Clock(rcl_clock_type_t = RCL_SYSTEM_TIME) {}
  Time now() const { return Time(now_ns_); }
  void set(std::int64_t now_ns) { now_ns_ = now_ns; }

 private:
  std::int64_t now_ns_ = 0;
};

}  // namespace rclcpp
