// SPDX-License-Identifier: MIT
// free_arcs.hpp: the arcs on which the centre of a disc can turn round the corners of static shapes.
//
// A corner of a polygon gives an arc of the disc's radius, from the normal of one side to that of the next; a circle
// gives a whole circle. What lies within the disc's radius of another shape is cut off: so the corners between the boxes
// of one wall have no arc.
#pragma once

#include <algorithm>
#include <cstdint>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/shape_distance.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

#include "metrics/outcome/static_shapes.hpp"

namespace dmrp::metrics {

constexpr std::uint32_t no_arc = static_cast<std::uint32_t>(-1);

// A piece of at most a third of a circle, counter-clockwise.
struct Arc {
  Vec2 center;
  double radius_m;
  Vec2 from, to;  // unit vectors
  double width_rad;
  std::uint32_t previous, next;  // pieces of the same circle that go on at either end; no_arc if none does

  bool contains(Vec2 direction) const {
    constexpr double rounding = 1e-9;
    return toolkit::cross(from, direction) >= -rounding && toolkit::cross(direction, to) >= -rounding &&
           toolkit::dot(from + to, direction) > 0.0;
  }
  // Measures radians from `from` to a direction that it contains.
  double angle_to(Vec2 direction) const {
    return std::clamp(std::atan2(toolkit::cross(from, direction), toolkit::dot(from, direction)), 0.0, width_rad);
  }
};

class FreeArcs {
 public:
  explicit FreeArcs(const FreeSpace& space) : space_(space) {
    for (std::size_t index = 0; index < space.shapes().size(); ++index) {
      const Shape& shape = space.shapes()[index];
      if (shape.kind == DMRP_SHAPE_CIRCLE) {
        add(shape.center, shape.radius_m + space.radius_m(), 0.0, 2.0 * toolkit::pi);
      } else {
        add_corners(toolkit::polygon_of(shape));
      }
    }
  }

  std::vector<Arc> take() { return std::move(arcs_); }

 private:
  static constexpr double least_rad = 1e-6;  // narrower is rounding

  void add_corners(toolkit::PolygonView polygon) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Segment before = polygon.edge(i == 0 ? polygon.size() - 1 : i - 1);
      const Segment after = polygon.edge(i);
      const Vec2 normal = -toolkit::perpendicular(before.to - before.from);
      const double begin = std::atan2(normal.y, normal.x);
      const Vec2 along = before.to - before.from, on = after.to - after.from;
      add(polygon[i], space_.radius_m(), begin, begin + std::atan2(toolkit::cross(along, on), toolkit::dot(along, on)));
    }
  }

  // Adds what is free of a circle from one angle to another.
  void add(Vec2 center, double radius_m, double begin, double end) {
    if (!(end - begin > least_rad)) return;
    find_cuts(center, radius_m, begin, end);
    const std::size_t first = arcs_.size();
    double from = begin;  // of the free part so far
    for (std::size_t i = 0; i + 1 < cuts_.size(); ++i) {
      const double middle = 0.5 * (cuts_[i] + cuts_[i + 1]);
      if (space_.is_clear(center + radius_m * toolkit::from_angle(middle))) continue;
      add_free(center, radius_m, from, cuts_[i]);
      from = cuts_[i + 1];
    }
    add_free(center, radius_m, from, end);
    const bool whole = end - begin > 2.0 * toolkit::pi - least_rad;
    if (!whole || arcs_.size() == first || !continues(arcs_.back().to, arcs_[first].from)) return;
    arcs_.back().next = static_cast<std::uint32_t>(first);
    arcs_[first].previous = static_cast<std::uint32_t>(arcs_.size() - 1);
  }

  void add_free(Vec2 center, double radius_m, double from, double to) {
    if (!(to - from > least_rad)) return;
    const int pieces = 1 + static_cast<int>((to - from) / (2.0 * toolkit::pi / 3.0));
    for (int piece = 0; piece < pieces; ++piece) {
      const double width_rad = (to - from) / pieces;
      const auto index = static_cast<std::uint32_t>(arcs_.size());
      arcs_.push_back({center, radius_m, toolkit::from_angle(from + piece * width_rad),
                       toolkit::from_angle(from + (piece + 1) * width_rad), width_rad, piece > 0 ? index - 1 : no_arc,
                       piece + 1 < pieces ? index + 1 : no_arc});
    }
  }

  static bool continues(Vec2 to, Vec2 from) { return toolkit::squared_distance(to, from) < least_rad * least_rad; }

  // The angles at which the circle may cross the outline of what a shape or the border keeps the disc from, in order,
  // with both ends.
  void find_cuts(Vec2 center, double radius_m, double begin, double end) {
    cuts_ = {begin, end};
    const double reach_m = radius_m + space_.radius_m();
    space_.visit_near(center, reach_m, [&](std::uint32_t index) {
      const Shape& shape = space_.shapes()[index];
      if (shape.kind == DMRP_SHAPE_CIRCLE) {
        cut_by_circle(center, radius_m, shape.center, shape.radius_m + space_.radius_m());
        return;
      }
      const toolkit::PolygonView polygon = toolkit::polygon_of(shape);
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Segment edge = polygon.edge(i);
        const Vec2 outward = -toolkit::perpendicular(toolkit::normalized(edge.to - edge.from));
        cut_by_circle(center, radius_m, edge.from, space_.radius_m());
        cut_by_line(center, radius_m, outward, toolkit::dot(outward, edge.from) + space_.radius_m());
      }
    });
    const toolkit::Rectangle inner = space_.inner();
    cut_by_line(center, radius_m, {1.0, 0.0}, inner.lower.x);
    cut_by_line(center, radius_m, {1.0, 0.0}, inner.upper.x);
    cut_by_line(center, radius_m, {0.0, 1.0}, inner.lower.y);
    cut_by_line(center, radius_m, {0.0, 1.0}, inner.upper.y);
    std::sort(cuts_.begin(), cuts_.end());
  }

  void cut_by_circle(Vec2 center, double radius_m, Vec2 other, double other_radius_m) {
    const Vec2 apart = other - center;
    const double squared = toolkit::squared_norm(apart);
    if (!(squared > 0.0)) return;
    // where both circles meet is on this line
    const double offset_m =
        0.5 * (squared + radius_m * radius_m - other_radius_m * other_radius_m) / std::sqrt(squared);
    const Vec2 normal = apart / std::sqrt(squared);
    cut_by_line(center, radius_m, normal, toolkit::dot(normal, center) + offset_m);
  }

  // The line of all points whose product with `normal`, a unit vector, is `offset_m`.
  void cut_by_line(Vec2 center, double radius_m, Vec2 normal, double offset_m) {
    const double cosine = (offset_m - toolkit::dot(normal, center)) / radius_m;
    if (!(std::abs(cosine) < 1.0)) return;
    const double middle = std::atan2(normal.y, normal.x);
    cut_at(middle - std::acos(cosine));
    cut_at(middle + std::acos(cosine));
  }

  void cut_at(double angle) {
    const double begin = cuts_[0];
    const double turns = std::floor((angle - begin) / (2.0 * toolkit::pi));
    const double at = angle - turns * 2.0 * toolkit::pi;
    if (at > begin && at < cuts_[1]) cuts_.push_back(at);
  }

  const FreeSpace& space_;
  std::vector<Arc> arcs_;
  std::vector<double> cuts_;  // begin, end, then others until they are sorted
};

}  // namespace dmrp::metrics
