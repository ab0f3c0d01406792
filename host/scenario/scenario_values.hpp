// SPDX-License-Identifier: MIT
// scenario_values.hpp: the kinds of value that scenario.toml has beside those of TOML. Each function throws InputError for
// another value.
#pragma once

#include <dmrp/values.h>

#include <string>
#include <vector>

#include "host/toml/toml_document.hpp"

namespace dmrp::host {

inline constexpr double max_coordinate_m = 1e6;
inline constexpr double max_angle_rad = 6.3;  // a turn; more is meant in degrees

dmrp_vec2 point(const TomlValue& value);                  // [x, y]
dmrp_vec2 size(const TomlValue& value);                   // [x, y], both above 0
double angle(const TomlValue& value);                     // in radians
dmrp_pose pose(const TomlValue& value);                   // [x, y] or [x, y, theta]; a heading that is not given is NaN
double positive(const TomlValue& value, double maximum);  // a number above 0

// Ranges in words.
std::string point_range();
std::string pose_range();
std::string size_range();

void refuse_twice(const TomlValue& name, const char* what, const std::vector<std::string>& names);

}  // namespace dmrp::host
