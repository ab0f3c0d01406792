// SPDX-License-Identifier: MIT
// The package angles.
#pragma once

#include <cmath>

namespace angles {

constexpr double pi = 3.14159265358979323846;

inline double normalize_angle(double angle) {
  return std::remainder(angle, 2.0 * pi);
}
inline double normalize_angle_positive(double angle) {
  const double normalized = normalize_angle(angle);
  return normalized < 0.0 ? normalized + 2.0 * pi : normalized;
}
inline double shortest_angular_distance(double from, double to) {
  return normalize_angle(to - from);
}

}  // namespace angles
