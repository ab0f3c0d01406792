// SPDX-License-Identifier: MIT
// angle.hpp: angles in radians, counter-clockwise from +x.
#pragma once

#include <cmath>

#include "../values.h"

namespace dmrp::toolkit {

DMRP_LOCAL inline constexpr double pi = 3.14159265358979323846;

// The same direction in (-pi, pi]. NaN and infinities give NaN.
inline double wrap(double angle) {
  if (angle > -pi && angle <= pi) return angle;
  const double turned = std::remainder(angle, 2.0 * pi);  // in [-pi, pi]
  return turned <= -pi ? pi : turned;
}

// The turn from heading `from` to heading `to` in the shorter direction, in (-pi, pi].
inline double difference(double from, double to) {
  return wrap(to - from);
}

// The direction from `from` to `to`, in (-pi, pi]; 0 if both are the same point. Takes any type with x and y:
// dmrp_vec2, dmrp_pose, dmrp_waypoint.
template <class From, class To>
double bearing(const From& from, const To& to) {
  return wrap(std::atan2(to.y - from.y, to.x - from.x));
}

}  // namespace dmrp::toolkit
