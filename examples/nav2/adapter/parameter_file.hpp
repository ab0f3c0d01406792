// SPDX-License-Identifier: MIT
// A parameter file of nav2, as a ROS system loads it.
#pragma once

#include <map>
#include <rclcpp/rclcpp.hpp>
#include <string>
#include <vector>

namespace nav2_adapter {

// The controller's section of the file.
inline const std::string section = "FollowPath";

struct ParameterFile {
  std::vector<rclcpp::Parameter> parameters;  // of the controller server: "FollowPath.vx_max"
  std::map<std::string, std::string> places;  // of each: "file:line:column"
  std::string plugin;                         // the class that the section names; "" if it names none
};

// Throws std::runtime_error with one line, "file:line:column: what was expected".
ParameterFile read_parameter_file(const std::string& path);

}  // namespace nav2_adapter
