// SPDX-License-Identifier: MIT
#include "host/scenario/scenario_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/scene/scenario.hpp"
#include "host/toml/setting.hpp"

namespace dmrp::host {
namespace {

std::vector<double> numbers(const TomlValue& value, std::size_t least, std::size_t most) {
  std::vector<double> out;
  for (const TomlValue& element : value.array())
    out.push_back(most == 3 && out.size() == 2 ? angle(element) : element.number(-max_coordinate_m, max_coordinate_m));
  if (out.size() < least || out.size() > most)
    value.fail(fmt::format("'{}' must be {}, not {} number{}", value.key(),
                           least == most ? "[x, y]" : "[x, y] or [x, y, theta]", out.size(),
                           out.size() == 1 ? "" : "s"));
  return out;
}

}  // namespace

std::string point_range() {
  return "each " + range_text(-max_coordinate_m, max_coordinate_m);
}

std::string pose_range() {
  return fmt::format("x, y: {}, theta: {}", range_text(-max_coordinate_m, max_coordinate_m),
                     range_text(-max_angle_rad, max_angle_rad));
}

std::string size_range() {
  return "each " + positive_text(max_coordinate_m);
}

dmrp_vec2 point(const TomlValue& value) {
  const auto xy = numbers(value, 2, 2);
  return {xy[0], xy[1]};
}

dmrp_vec2 size(const TomlValue& value) {
  const dmrp_vec2 out = point(value);
  if (out.x <= 0.0 || out.y <= 0.0)
    value.fail(fmt::format("'{}' must be positive, not [{}, {}]", value.key(), out.x, out.y));
  return out;
}

double angle(const TomlValue& value) {
  const double given = value.number();
  if (std::abs(given) > max_angle_rad)
    value.fail(fmt::format("'{}' has the angle {}, more than a turn: angles are in radians, {} degrees are {:.5g}",
                           value.key(), given, given, given * std::numbers::pi / 180.0));
  return given;
}

dmrp_pose pose(const TomlValue& value) {
  const auto xyt = numbers(value, 2, 3);
  return {xyt[0], xyt[1], xyt.size() == 3 ? xyt[2] : core::free_heading};
}

double positive(const TomlValue& value, double maximum) {
  value.positive();
  return value.number(0.0, maximum);
}

void refuse_twice(const TomlValue& name, const char* what, const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), name.text()) != names.end())
    name.fail(fmt::format("there are two {} '{}'", what, name.text()));
}

}  // namespace dmrp::host
