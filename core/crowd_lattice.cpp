// SPDX-License-Identifier: MIT
#include "core/crowd_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>
#include <numbers>
#include <utility>

namespace dmrp::core {
namespace {

constexpr double narrowing = 0.98;  // of the lattice, from one try to the next
constexpr int tries_to_move = 8;

// The lattice's points in the rectangle that have room; `phase`: of the first row and column, in [0, 1).
std::vector<dmrp_vec2> lattice_points(const toolkit::Rectangle& where, double spacing_m, dmrp_vec2 phase,
                                      const std::function<bool(dmrp_vec2)>& has_room) {
  const double row_m = 0.5 * std::sqrt(3.0) * spacing_m;
  std::vector<dmrp_vec2> points;
  bool shifted = false;
  for (double y = where.lower.y + phase.y * row_m; y <= where.upper.y; y += row_m, shifted = !shifted) {
    double x = where.lower.x + phase.x * spacing_m - (shifted ? 0.5 * spacing_m : 0.0);
    if (x < where.lower.x) x += spacing_m;
    for (; x <= where.upper.x; x += spacing_m)
      if (has_room({x, y})) points.push_back({x, y});
  }
  return points;
}

void shuffle(std::vector<dmrp_vec2>& points, toolkit::Stream& stream) {
  for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[stream.below(i)]);
}

// Somewhere at most `reach_m` away; the point itself where nothing was found.
dmrp_vec2 moved(dmrp_vec2 point, double reach_m, const toolkit::Rectangle& where, toolkit::Stream& stream,
                const std::function<bool(dmrp_vec2)>& has_room) {
  for (int tries = 0; tries < tries_to_move; ++tries) {
    const double radius_m = reach_m * std::sqrt(stream.uniform());
    const dmrp_vec2 there = point + radius_m * toolkit::from_angle(stream.uniform(0.0, 2.0 * std::numbers::pi));
    if (toolkit::contains(where, there) && has_room(there)) return there;
  }
  return point;
}

}  // namespace

std::vector<dmrp_vec2> spread_on_lattice(const toolkit::Rectangle& where, std::size_t count, double apart_m,
                                         toolkit::Stream& stream, const std::function<bool(dmrp_vec2)>& has_room) {
  if (count == 0) return {};
  const double x_phase = stream.uniform();
  const dmrp_vec2 phase = {x_phase, stream.uniform()};
  const dmrp_vec2 extent = where.upper - where.lower;
  // as many points as people, were the place empty
  double spacing_m =
      std::max(apart_m, std::sqrt(2.0 * extent.x * extent.y / (std::sqrt(3.0) * static_cast<double>(count))));
  std::vector<dmrp_vec2> points = lattice_points(where, spacing_m, phase, has_room);
  while (points.size() < count && spacing_m > apart_m) {
    spacing_m = std::max(apart_m, narrowing * spacing_m);
    points = lattice_points(where, spacing_m, phase, has_room);
  }
  shuffle(points, stream);
  points.resize(std::min(points.size(), count));
  for (dmrp_vec2& point : points) point = moved(point, 0.5 * (spacing_m - apart_m), where, stream, has_room);
  return points;
}

}  // namespace dmrp::core
