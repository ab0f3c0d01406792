// SPDX-License-Identifier: MIT
#include "controllers/motion/footprint_check.hpp"

#include <algorithm>
#include <cassert>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::controllers {

FootprintCheck::FootprintCheck(const CostmapView& map, const Footprint& footprint, double padding_m, const Pose& now)
    : map_(map), footprint_(&footprint), padding_m_(padding_m), start_(toolkit::position(now)) {
  scale(1.0);
  start_collides_ = cost(directed(now)) == in_collision;
  if (start_collides_) start_distance_m_ = map_.distance_to_lethal(start_, footprint.radius_m + padding_m);
}

void FootprintCheck::scale(double factor) {
  factor_ = factor;
  highest_ = map_.highest_cost_at(footprint_->inscribed_radius_m * factor + padding_m_);
}

int FootprintCheck::polygon_cost(const DirectedPoint& robot) const {
  const int center_cost = map_.cost(robot.at);
  if (center_cost > highest_) return tolerated(robot.at, center_cost);
  if (map_.distance_of(static_cast<std::uint8_t>(center_cost)) > footprint_->radius_m * factor_ + padding_m_)
    return center_cost;
  for (const Polygon& part : parts(*footprint_))
    if (!outline_is_clear(part, robot)) return tolerated(robot.at, center_cost);
  return std::min(center_cost, DMRP_COST_INSCRIBED - 1);
}

bool FootprintCheck::outline_is_clear(const Polygon& part, const DirectedPoint& robot) const {
  // moves each vertex outward from the centre: exact padding at the corners, approximate along the sides
  const double growth = factor_ + padding_m_ / footprint_->radius_m;
  const auto vertex = [&](std::uint32_t i) {
    const Vec2 v = part.vertices[i] * growth;
    const auto [c, s] = robot.heading;
    return Vec2{robot.at.x + c * v.x - s * v.y, robot.at.y + s * v.x + c * v.y};
  };
  for (std::uint32_t i = 0; i < part.vertex_count; ++i)
    if (!edge_is_clear(vertex(i), vertex((i + 1) % part.vertex_count))) return false;
  return true;
}

bool FootprintCheck::edge_is_clear(Vec2 from, Vec2 to) const {
  const double length_m = toolkit::distance(from, to);
  const int steps = 1 + static_cast<int>(length_m / (0.5 * map_.resolution_m()));
  for (int i = 0; i <= steps; ++i) {
    if (map_.cost(toolkit::lerp(from, to, static_cast<double>(i) / steps)) >= DMRP_COST_LETHAL) return false;
  }
  return true;
}

int FootprintCheck::tolerated(Vec2 center, int cost) const {
  if (!start_collides_) return in_collision;
  // the distance to the nearest cell's centre varies by this much along a wall
  const double variation_m = 0.05 * map_.resolution_m();
  if (center != start_ &&
      map_.distance_to_lethal(center, footprint_->radius_m + padding_m_) < start_distance_m_ - variation_m)
    return in_collision;
  return std::min(cost, DMRP_COST_INSCRIBED - 1);
}

bool FootprintCheck::is_too_close(const DirectedPoint& robot) const {
  FootprintCheck strict = *this;
  strict.start_collides_ = false;
  return strict.cost(robot) == in_collision;
}

int FootprintCheck::arc_cost(const Pose& from, double v, double omega, double duration_s, int steps) const {
  assert(steps > 0);
  DirectedPoint at = directed(from);
  const ArcStepper stepper(v, omega, duration_s / steps);
  int highest = 0;
  for (int i = 0; i < steps; ++i) {
    stepper.step(at);
    const int here = cost(at);
    if (here == in_collision) return in_collision;
    highest = std::max(highest, here);
  }
  return highest;
}

}  // namespace dmrp::controllers
