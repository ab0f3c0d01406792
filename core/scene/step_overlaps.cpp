// SPDX-License-Identifier: MIT
#include "core/scene/step_overlaps.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/segment.hpp>

#include "core/scene/convex_separation.hpp"
#include "core/scene/footprint.hpp"

namespace dmrp::core {

namespace {

constexpr double touching_tolerance_m = 1e-6;
constexpr std::uint8_t stands_at_any_heading = 8;
constexpr std::uint8_t stands_along_first_axis = 9;
constexpr std::size_t motion_count = 13;

dmrp_vec2 way_of(std::uint8_t motion) {
  if (motion >= stands_at_any_heading) return {0.0, 0.0};
  return {static_cast<double>(toolkit::direction_dx[motion]), static_cast<double>(toolkit::direction_dy[motion])};
}

std::uint8_t direction_of(toolkit::Cell from, toolkit::Cell to) {
  std::uint8_t direction = 0;
  while (toolkit::direction_dx[direction] != to.column - from.column ||
         toolkit::direction_dy[direction] != to.row - from.row)
    ++direction;
  return direction;
}

ConvexPolygon moved(ConvexPolygon polygon, dmrp_vec2 by) {
  for (dmrp_vec2& vertex : polygon) vertex += by;
  return polygon;
}

// Whether the polygon meets the disc around the origin while it moves from `place` by `way`.
bool meets_disc(const ConvexPolygon& polygon, dmrp_vec2 place, dmrp_vec2 way, double radius_m) {
  return separation(swept(moved(polygon, place), way), {0.0, 0.0}, radius_m).distance_m < -touching_tolerance_m;
}

}  // namespace

StepOverlaps::StepOverlaps(double cell_m, const std::vector<Robot>& robots) : cell_m_(cell_m) {
  double largest_m = 0.0;
  double second_m = 0.0;
  for (const Robot& robot : robots) {
    second_m = std::max(second_m, std::min(robot.radius_m, largest_m));
    largest_m = std::max(largest_m, robot.radius_m);
  }
  // of robots that are in no conflict by their cells, those at a right angle come nearest: within cell / sqrt(2)
  if (std::sqrt(2.0) * (largest_m + second_m) <= cell_m_ + touching_tolerance_m) return;
  reach_ = static_cast<std::int32_t>(std::ceil((largest_m + second_m) / cell_m_)) + 2;
  for (const Robot& robot : robots) {
    Body body{robot.radius_m, robot.parts};
    const auto known = std::find(bodies_.begin(), bodies_.end(), body);
    robots_.push_back({static_cast<std::size_t>(known - bodies_.begin()), robot.grid, robot.is_active});
    if (known == bodies_.end()) bodies_.push_back(std::move(body));
  }
  tables_.resize(bodies_.size() * bodies_.size());
}

bool StepOverlaps::overlap(std::uint32_t a, toolkit::Cell at_a, std::uint32_t b, toolkit::Cell at_b) {
  return overlap(a, at_a, at_a, b, at_b, at_b);
}

bool StepOverlaps::overlap(std::uint32_t a, toolkit::Cell a0, toolkit::Cell a1, std::uint32_t b, toolkit::Cell b0,
                           toolkit::Cell b1) {
  assert(a != b && robots_.at(a).grid && robots_.at(b).grid);
  const Member& one = robots_[a];
  const Member& two = robots_[b];
  if (!one.is_active && !two.is_active) return false;
  const Motion one_does = a0 == a1 ? stand(one, a0) : direction_of(a0, a1);
  const Motion two_does = b0 == b1 ? stand(two, b0) : direction_of(b0, b1);
  return look_up(one, a0, one_does, two, b0, two_does) || look_up(one, a1, stand(one, a1), two, b1, stand(two, b1));
}

bool StepOverlaps::Body::operator==(const Body& other) const {
  const auto same_point = [](dmrp_vec2 p, dmrp_vec2 q) { return p.x == q.x && p.y == q.y; };
  const auto same_part = [&](const ConvexPolygon& p, const ConvexPolygon& q) {
    return std::equal(p.begin(), p.end(), q.begin(), q.end(), same_point);
  };
  return radius_m == other.radius_m &&
         std::equal(parts.begin(), parts.end(), other.parts.begin(), other.parts.end(), same_part);
}

StepOverlaps::Cover StepOverlaps::cover_of(const Body& body, Motion motion) {
  Cover cover{body.radius_m, {}};
  if (motion == stands_at_any_heading) return cover;
  const int axis = (motion < stands_at_any_heading ? motion : motion - stands_along_first_axis) % 4;
  for (const int heading : {axis, axis + 4})
    for (const ConvexPolygon& part : body.parts)
      cover.polygons.push_back(toolkit::to_world({0.0, 0.0, heading * toolkit::pi / 4.0}, part));
  return cover;
}

StepOverlaps::Motion StepOverlaps::stand(const Member& robot, toolkit::Cell cell) const {
  const dmrp_grid& grid = *robot.grid;
  const std::size_t index = static_cast<std::size_t>(cell.row) * grid.width + static_cast<std::size_t>(cell.column);
  const Body& body = bodies_[robot.body];
  const unsigned edges = grid.edges[index];
  if (body.parts.empty() || edges == 0 || !(grid.clearance[index] < body.radius_m)) return stands_at_any_heading;
  for (std::uint8_t axis = 0; axis < 4; ++axis)
    if ((edges & ~(0x11u << axis)) == 0) return static_cast<Motion>(stands_along_first_axis + axis);
  return stands_at_any_heading;
}

bool StepOverlaps::look_up(const Member& a, toolkit::Cell at_a, Motion a_does, const Member& b, toolkit::Cell at_b,
                           Motion b_does) {
  const toolkit::Cell offset{at_b.column - at_a.column, at_b.row - at_a.row};
  if (std::abs(offset.column) > reach_ || std::abs(offset.row) > reach_) return false;
  const auto side = static_cast<std::size_t>(2 * reach_ + 1);
  std::vector<Entry>& table = tables_[a.body * bodies_.size() + b.body];
  if (table.empty()) table.assign(side * side * motion_count * motion_count, Entry::unknown);
  const std::size_t place =
      static_cast<std::size_t>(offset.row + reach_) * side + static_cast<std::size_t>(offset.column + reach_);
  Entry& entry = table[(place * motion_count + a_does) * motion_count + b_does];
  if (entry == Entry::unknown)
    entry = bodies_overlap(bodies_[a.body], a_does, bodies_[b.body], b_does, offset) ? Entry::overlap : Entry::apart;
  return entry == Entry::overlap;
}

bool StepOverlaps::bodies_overlap(const Body& a, Motion a_does, const Body& b, Motion b_does,
                                  toolkit::Cell b_from_a) const {
  // a relative to b
  const dmrp_vec2 place = {-cell_m_ * b_from_a.column, -cell_m_ * b_from_a.row};
  const dmrp_vec2 way = cell_m_ * (way_of(a_does) - way_of(b_does));
  if (toolkit::distance(dmrp_segment{place, place + way}, dmrp_vec2{0.0, 0.0}) >=
      a.radius_m + b.radius_m - touching_tolerance_m)
    return false;
  const Cover of_a = cover_of(a, a_does);
  const Cover of_b = cover_of(b, b_does);
  if (of_a.polygons.empty() && of_b.polygons.empty()) return true;
  for (const ConvexPolygon& one : of_a.polygons) {
    if (of_b.polygons.empty() && meets_disc(one, place, way, of_b.radius_m)) return true;
    for (const ConvexPolygon& two : of_b.polygons)
      if (separation(swept(moved(one, place), way), two).distance_m < -touching_tolerance_m) return true;
  }
  for (const ConvexPolygon& two : of_b.polygons)
    if (of_a.polygons.empty() && meets_disc(two, -place, -way, of_a.radius_m)) return true;
  return false;
}

}  // namespace dmrp::core
