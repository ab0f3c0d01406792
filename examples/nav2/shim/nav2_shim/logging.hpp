// SPDX-License-Identifier: MIT
// rclcpp's logging. Lines go to the sink of the thread, which the adapter sets for each call; without a sink they are
// dropped. Debug and info lines are dropped always.
#pragma once

#include <cstdio>
#include <functional>
#include <sstream>
#include <string>
#include <utility>

namespace nav2_shim {

// `place` is the same for all lines that one statement of a source writes.
using LogSink = std::function<void(bool is_error, const char* place, const std::string& line)>;

inline const LogSink*& log_sink() {
  thread_local const LogSink* sink = nullptr;
  return sink;
}

template <class... Values>
std::string formatted(const char* format, Values... values) {
  if constexpr (sizeof...(Values) == 0) {
    return format;
  } else {
    char line[1024];
    std::snprintf(line, sizeof(line), format, values...);
    return line;
  }
}

inline void log(bool is_error, const char* place, const std::string& name, const std::string& text) {
  if (const LogSink* sink = log_sink()) (*sink)(is_error, place, name + ": " + text);
}

}  // namespace nav2_shim

namespace rclcpp {

class Logger {
 public:
  explicit Logger(std::string name) : name_(std::move(name)) {}
  const char* get_name() const { return name_.c_str(); }

 private:
  std::string name_;
};

inline Logger get_logger(const std::string& name) {
  return Logger(name);
}

}  // namespace rclcpp

#define NAV2_SHIM_TEXT_(line) #line
#define NAV2_SHIM_TEXT(line) NAV2_SHIM_TEXT_(line)
#define NAV2_SHIM_PLACE __FILE__ ":" NAV2_SHIM_TEXT(__LINE__)
#define NAV2_SHIM_LOG(is_error, logger, ...) \
  nav2_shim::log(is_error, NAV2_SHIM_PLACE, (logger).get_name(), nav2_shim::formatted(__VA_ARGS__))
#define NAV2_SHIM_LOG_STREAM(is_error, logger, text)                                      \
  do {                                                                                    \
    std::ostringstream nav2_shim_text;                                                    \
    nav2_shim_text << text;                                                               \
    nav2_shim::log(is_error, NAV2_SHIM_PLACE, (logger).get_name(), nav2_shim_text.str()); \
  } while (false)
#define NAV2_SHIM_DROP(logger, ...) static_cast<void>(logger)

#define RCLCPP_DEBUG NAV2_SHIM_DROP
#define RCLCPP_INFO NAV2_SHIM_DROP
#define RCLCPP_DEBUG_STREAM NAV2_SHIM_DROP
#define RCLCPP_INFO_STREAM NAV2_SHIM_DROP
#define RCLCPP_INFO_THROTTLE NAV2_SHIM_DROP
#define RCLCPP_DEBUG_THROTTLE NAV2_SHIM_DROP
#define RCLCPP_WARN(logger, ...) NAV2_SHIM_LOG(false, logger, __VA_ARGS__)
#define RCLCPP_ERROR(logger, ...) NAV2_SHIM_LOG(true, logger, __VA_ARGS__)
#define RCLCPP_FATAL(logger, ...) NAV2_SHIM_LOG(true, logger, __VA_ARGS__)
#define RCLCPP_WARN_STREAM(logger, text) NAV2_SHIM_LOG_STREAM(false, logger, text)
#define RCLCPP_ERROR_STREAM(logger, text) NAV2_SHIM_LOG_STREAM(true, logger, text)
// The adapter logs each place once a trial: that throttles enough.
#define RCLCPP_WARN_THROTTLE(logger, clock, period_ms, ...) (static_cast<void>(clock), RCLCPP_WARN(logger, __VA_ARGS__))
#define RCLCPP_ERROR_THROTTLE(logger, clock, period_ms, ...) \
  (static_cast<void>(clock), RCLCPP_ERROR(logger, __VA_ARGS__))
#define RCLCPP_WARN_ONCE RCLCPP_WARN
#define RCLCPP_ERROR_ONCE RCLCPP_ERROR
#define RCLCPP_INFO_ONCE RCLCPP_INFO
