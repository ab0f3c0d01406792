// SPDX-License-Identifier: MIT
#include "controllers/e3mop/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>

namespace dmrp::controllers::e3mop {

namespace {

constexpr double sample_step_m = 0.05;

// The approximate length of long forward motions.
constexpr double long_step_m = 0.45;

// Wide arcs have this multiple of the smallest radius that can be driven at full speed.
constexpr double wide = 1.5;

// Arcs are searched among lattice vectors with components up to this many cells.
constexpr int arc_reach = 12;

// Tighter arcs have no advantage over turning in place.
constexpr double radius_min_m = 0.25;

// Factors on the travel time, as in SBPL's primitives: a turn in place requires stopping, and chains of short steps are
// to be avoided.
constexpr double turn_weight = 2.0;
constexpr double short_step_weight = 2.0;

constexpr double infinity = std::numeric_limits<double>::infinity();

std::array<Direction, direction_count> make_directions() {
  constexpr int vectors[4][2] = {{1, 0}, {2, 1}, {1, 1}, {1, 2}};
  std::array<Direction, direction_count> all{};
  for (int i = 0; i < direction_count; ++i) {
    int dx = vectors[i % 4][0];
    int dy = vectors[i % 4][1];
    for (int quarter = 0; quarter < i / 4; ++quarter) {
      const int old_dx = dx;
      dx = -dy;
      dy = old_dx;
    }
    const double length = std::hypot(dx, dy);
    all[static_cast<std::size_t>(i)] = {dx, dy, toolkit::wrap(std::atan2(dy, dx)), {dx / length, dy / length}};
  }
  return all;
}

const Direction& direction(int index) {
  return directions()[static_cast<std::size_t>(index)];
}

}  // namespace

const std::array<Direction, direction_count>& directions() {
  static const std::array<Direction, direction_count> all = make_directions();
  return all;
}

int nearest_direction(double theta) {
  int nearest = 0;
  double nearest_angle = infinity;
  for (int i = 0; i < direction_count; ++i) {
    const double angle = std::abs(toolkit::difference(theta, direction(i).theta));
    if (angle < nearest_angle) {
      nearest = i;
      nearest_angle = angle;
    }
  }
  return nearest;
}

void MotionSet::build(const Limits& limits, double resolution_m) {
  resolution_m_ = resolution_m;
  v_max_ = limits.v_max;
  omega_max_ = limits.omega_max;
  motions_.clear();
  samples_.clear();
  const double full_speed_radius_m = v_max_ / omega_max_;
  for (int heading = 0; heading < direction_count; ++heading) {
    begins_[static_cast<std::size_t>(heading)] = motions_.size();
    const double step_m = resolution_m * std::hypot(direction(heading).dx, direction(heading).dy);
    add_straight(heading, 1, MotionKind::short_forward);
    add_straight(heading, std::max(2, static_cast<int>(std::lround(long_step_m / step_m))), MotionKind::long_forward);
    for (const int side : {1, -1}) {
      const int to = (heading + side + direction_count) % direction_count;
      add_arc(heading, to, wide * full_speed_radius_m, infinity);
      add_arc(heading, to, full_speed_radius_m, wide * full_speed_radius_m);
      add_arc(heading, to, radius_min_m, full_speed_radius_m);
      add_turn(heading, to);
    }
  }
  begins_[direction_count] = motions_.size();
}

void MotionSet::add_straight(int heading, int steps, MotionKind kind) {
  const Direction& along = direction(heading);
  Motion motion{};
  motion.kind = kind;
  motion.dx = steps * along.dx;
  motion.dy = steps * along.dy;
  motion.to_heading = heading;
  motion.radius_m = infinity;
  add(heading, motion, resolution_m_ * std::hypot(motion.dx, motion.dy), 0.0);
}

void MotionSet::add_turn(int heading, int to_heading) {
  Motion motion{};
  motion.kind = MotionKind::turn;
  motion.to_heading = to_heading;
  motion.radius_m = 0.0;
  add(heading, motion, 0.0, 0.0);
}

// Let u and w be the unit vectors of the two headings. A lattice vector d = p u + q w with p, q > 0 is reached by an
// arc with two tangents of length min(p, q); the rest of p or q is straight. Takes the shortest such motion with a
// radius within the bounds, if there is one.
void MotionSet::add_arc(int heading, int to_heading, double radius_min, double radius_max) {
  const Direction& u = direction(heading);
  const Direction& w = direction(to_heading);
  const double turn = std::abs(toolkit::difference(u.theta, w.theta));
  const double cross = toolkit::cross(u.unit, w.unit);
  Motion best{};
  double best_length_m = infinity;
  double before_m = 0.0;
  double after_m = 0.0;
  for (int dy = -arc_reach; dy <= arc_reach; ++dy) {
    for (int dx = -arc_reach; dx <= arc_reach; ++dx) {
      const Vec2 d = {static_cast<double>(dx), static_cast<double>(dy)};
      const double p_m = resolution_m_ * toolkit::cross(d, w.unit) / cross;
      const double q_m = resolution_m_ * toolkit::cross(u.unit, d) / cross;
      const double tangent_m = std::min(p_m, q_m);
      if (tangent_m < 1e-9) continue;
      const double radius_m = tangent_m / std::tan(0.5 * turn);
      const double length_m = p_m + q_m - 2.0 * tangent_m + radius_m * turn;
      if (radius_m < radius_min - 1e-9 || radius_m >= radius_max - 1e-9 || length_m >= best_length_m - 1e-9) continue;
      best_length_m = length_m;
      best.dx = dx;
      best.dy = dy;
      best.radius_m = radius_m;
      before_m = p_m - tangent_m;
      after_m = q_m - tangent_m;
    }
  }
  if (best_length_m == infinity) return;
  best.kind = MotionKind::arc;
  best.to_heading = to_heading;
  add(heading, best, before_m, after_m);
}

// The weighted travel time. An arc costs at least as much as its two tangents, which are up to 2 % longer than the arc:
// the heuristic's grid measures along them, and must never exceed the cost.
double MotionSet::cost_s(const Motion& motion, double turn, double straight_m) const {
  switch (motion.kind) {
    case MotionKind::short_forward:
      return short_step_weight * straight_m / v_max_;
    case MotionKind::long_forward:
      return straight_m / v_max_;
    case MotionKind::turn:
      return turn_weight * turn / omega_max_;
    case MotionKind::arc:
      break;
  }
  const double tangents_m = 2.0 * motion.radius_m * std::tan(0.5 * turn);
  return (straight_m + tangents_m) / v_max_ + std::max(0.0, turn / omega_max_ - tangents_m / v_max_);
}

void MotionSet::add(int heading, Motion motion, double before_m, double after_m) {
  const Direction& from = direction(heading);
  const double turn = toolkit::difference(from.theta, direction(motion.to_heading).theta);
  const double arc_m = motion.kind == MotionKind::arc ? motion.radius_m * std::abs(turn) : 0.0;
  motion.length_m = before_m + arc_m + after_m;
  motion.cost = static_cast<Ticks>(std::ceil(cost_s(motion, std::abs(turn), before_m + after_m) * ticks_per_s));

  // a turn is sampled half-way and at its end
  motion.first_sample = static_cast<std::uint32_t>(samples_.size());
  const int steps = motion.kind == MotionKind::turn ? 2 : static_cast<int>(std::ceil(motion.length_m / sample_step_m));
  const double side = turn < 0.0 ? -1.0 : 1.0;
  for (int i = 1; i <= steps; ++i) {
    const double at_m = motion.length_m * i / steps;
    const double turned = motion.kind == MotionKind::turn ? turn * i / steps
                          : arc_m > 0.0 ? side * std::clamp(at_m - before_m, 0.0, arc_m) / motion.radius_m
                                        : 0.0;
    double ahead_m = std::min(at_m, before_m);
    double left_m = 0.0;
    if (arc_m > 0.0) {
      const double beyond_m = std::max(0.0, at_m - before_m - arc_m);
      ahead_m += motion.radius_m * std::sin(std::abs(turned)) + beyond_m * std::cos(turned);
      left_m += side * motion.radius_m * (1.0 - std::cos(turned)) + beyond_m * std::sin(turned);
    }
    const double theta = from.theta + turned;
    const auto [c, s] = from.unit;
    samples_.push_back(directed({c * ahead_m - s * left_m, s * ahead_m + c * left_m}, theta));
  }
  motion.sample_count = static_cast<std::uint32_t>(steps);

  if (motion.kind == MotionKind::long_forward || motion.kind == MotionKind::arc) {
    const double beta = std::atan2(motion.dy, motion.dx);
    for (int k = 0; k < direction_count; ++k) {
      const double to_goal = toolkit::difference(from.theta, direction(k).theta);
      const double to_successor = toolkit::difference(from.theta, beta);
      if (std::abs(to_goal - to_successor) > 0.25 * toolkit::pi)
        motion.dropped_for = static_cast<std::uint16_t>(motion.dropped_for | (1u << k));
    }
  }
  motions_.push_back(motion);
}

}  // namespace dmrp::controllers::e3mop
