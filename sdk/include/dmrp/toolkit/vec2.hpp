// SPDX-License-Identifier: MIT
// vec2.hpp: arithmetic on dmrp_vec2.
//
// dmrp_vec2 is a C type in the global namespace; its operators are there too, so that argument-dependent lookup finds
// them. They take no other type, so they cannot clash with the operators of other vector types.
#pragma once

#include <cmath>

#include "../values.h"

constexpr dmrp_vec2 operator+(dmrp_vec2 a, dmrp_vec2 b) {
  return {a.x + b.x, a.y + b.y};
}
constexpr dmrp_vec2 operator-(dmrp_vec2 a, dmrp_vec2 b) {
  return {a.x - b.x, a.y - b.y};
}
constexpr dmrp_vec2 operator-(dmrp_vec2 a) {
  return {-a.x, -a.y};
}
constexpr dmrp_vec2 operator*(dmrp_vec2 a, double scale) {
  return {a.x * scale, a.y * scale};
}
constexpr dmrp_vec2 operator*(double scale, dmrp_vec2 a) {
  return {scale * a.x, scale * a.y};
}
constexpr dmrp_vec2 operator/(dmrp_vec2 a, double divisor) {
  return {a.x / divisor, a.y / divisor};
}
constexpr bool operator==(dmrp_vec2 a, dmrp_vec2 b) {
  return a.x == b.x && a.y == b.y;
}
constexpr bool operator!=(dmrp_vec2 a, dmrp_vec2 b) {
  return !(a == b);
}
constexpr dmrp_vec2& operator+=(dmrp_vec2& a, dmrp_vec2 b) {
  return a = a + b;
}
constexpr dmrp_vec2& operator-=(dmrp_vec2& a, dmrp_vec2 b) {
  return a = a - b;
}
constexpr dmrp_vec2& operator*=(dmrp_vec2& a, double scale) {
  return a = a * scale;
}
constexpr dmrp_vec2& operator/=(dmrp_vec2& a, double divisor) {
  return a = a / divisor;
}

namespace dmrp::toolkit {

// The position of any type with x and y: a pose, a waypoint.
template <class Point>
constexpr dmrp_vec2 position(const Point& at) {
  return {at.x, at.y};
}

constexpr double dot(dmrp_vec2 a, dmrp_vec2 b) {
  return a.x * b.x + a.y * b.y;
}

// The z component of a x b: positive if b lies to the left of a.
constexpr double cross(dmrp_vec2 a, dmrp_vec2 b) {
  return a.x * b.y - a.y * b.x;
}

constexpr double squared_norm(dmrp_vec2 a) {
  return dot(a, a);
}
inline double norm(dmrp_vec2 a) {
  return std::sqrt(squared_norm(a));
}

constexpr double squared_distance(dmrp_vec2 a, dmrp_vec2 b) {
  return squared_norm(b - a);
}
inline double distance(dmrp_vec2 a, dmrp_vec2 b) {
  return norm(b - a);
}

inline bool is_finite(dmrp_vec2 a) {
  return std::isfinite(a.x) && std::isfinite(a.y);
}

// Whether its length is 1, within rounding.
constexpr bool is_unit(dmrp_vec2 a) {
  return squared_norm(a) > 1.0 - 1e-6 && squared_norm(a) < 1.0 + 1e-6;
}

// The unit vector along `a`; zero for the zero vector.
inline dmrp_vec2 normalized(dmrp_vec2 a) {
  const double length = norm(a);
  return length > 0.0 ? a / length : dmrp_vec2{0.0, 0.0};
}

// `a` rotated by 90 degrees counter-clockwise.
constexpr dmrp_vec2 perpendicular(dmrp_vec2 a) {
  return {-a.y, a.x};
}

// `a` rotated by `angle` radians counter-clockwise.
inline dmrp_vec2 rotate(dmrp_vec2 a, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * a.x - s * a.y, s * a.x + c * a.y};
}

// The unit vector of a heading.
inline dmrp_vec2 from_angle(double heading) {
  return {std::cos(heading), std::sin(heading)};
}

// `a` at fraction 0, `b` at fraction 1, exact at both ends.
constexpr dmrp_vec2 lerp(dmrp_vec2 a, dmrp_vec2 b, double fraction) {
  return (1.0 - fraction) * a + fraction * b;
}

// A point given in the frame of `frame`, in world coordinates.
inline dmrp_vec2 to_world(const dmrp_pose& frame, dmrp_vec2 local) {
  return position(frame) + rotate(local, frame.theta);
}

// A world point in the frame of `frame`: x ahead, y to the left.
inline dmrp_vec2 to_local(const dmrp_pose& frame, dmrp_vec2 world) {
  return rotate(world - position(frame), -frame.theta);
}

}  // namespace dmrp::toolkit
