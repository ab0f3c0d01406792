// SPDX-License-Identifier: MIT
#include "controllers/motion/footprint_check.hpp"

#include <algorithm>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::controllers {

FootprintCheck::FootprintCheck(const CostmapView& map, const Footprint& footprint, double padding_m, const Pose& now)
    : map_(map), footprint_(&footprint), padding_m_(padding_m), start_(toolkit::position(now)) {
  scale(1.0);
  start_collides_ = cost(arc_state(now)) == in_collision;
  if (start_collides_) start_distance_m_ = map_.distance_to_lethal(start_, footprint.radius_m + padding_m);
}

void FootprintCheck::scale(double factor) {
  factor_ = factor;
  highest_ = map_.highest_cost_at(footprint_->inscribed_radius_m * factor + padding_m_);
}

int FootprintCheck::polygon_cost(const ArcState& at) const {
  const int center_cost = map_.cost(at.x, at.y);
  if (center_cost > highest_) return tolerated(at, center_cost);
  if (map_.distance_of(static_cast<std::uint8_t>(center_cost)) > footprint_->radius_m * factor_ + padding_m_)
    return center_cost;
  // the vertices move outward along their own direction: the padding at the corners, about that at the sides
  const double growth = factor_ + padding_m_ / footprint_->radius_m;
  const auto vertex = [&](std::uint32_t i) {
    const Vec2 v = footprint_->vertices[i] * growth;
    return Vec2{at.x + at.cos_theta * v.x - at.sin_theta * v.y, at.y + at.sin_theta * v.x + at.cos_theta * v.y};
  };
  for (std::uint32_t i = 0; i < footprint_->vertex_count; ++i)
    if (!edge_is_clear(vertex(i), vertex((i + 1) % footprint_->vertex_count))) return tolerated(at, center_cost);
  return std::min(center_cost, DMRP_COST_INSCRIBED - 1);
}

bool FootprintCheck::edge_is_clear(Vec2 from, Vec2 to) const {
  const double length_m = toolkit::distance(from, to);
  const int steps = 1 + static_cast<int>(length_m / (0.5 * map_.resolution_m()));
  for (int i = 0; i <= steps; ++i) {
    const Vec2 point = toolkit::lerp(from, to, static_cast<double>(i) / steps);
    if (map_.cost(point.x, point.y) >= DMRP_COST_LETHAL) return false;
  }
  return true;
}

int FootprintCheck::tolerated(const ArcState& at, int cost) const {
  if (!start_collides_) return in_collision;
  const Vec2 point = {at.x, at.y};
  // beside a wall the distance to the nearest cell's centre wavers by so much
  const double waver_m = 0.05 * map_.resolution_m();
  if (point != start_ &&
      map_.distance_to_lethal(point, footprint_->radius_m + padding_m_) < start_distance_m_ - waver_m)
    return in_collision;
  return std::min(cost, DMRP_COST_INSCRIBED - 1);
}

int FootprintCheck::arc_cost(const Pose& from, double v, double omega, double duration_s, int steps) const {
  ArcState at = arc_state(from);
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
