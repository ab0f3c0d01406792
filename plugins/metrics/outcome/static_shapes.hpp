// SPDX-License-Identifier: MIT
// static_shapes.hpp: the static shapes of a world, kept from trial to trial, and what is clear among them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/rectangle.hpp>
#include <dmrp/toolkit/shape_distance.hpp>
#include <limits>
#include <vector>

namespace dmrp::metrics {

constexpr double touching_m = 1e-6;  // what is nearer by this touches, and may

// A copy of a world's shapes and border.
class StaticShapes {
 public:
  StaticShapes() = default;
  explicit StaticShapes(const World& world) : border_{world->lower, world->upper} {
    for (const Shape& shape : world.shapes()) shapes_.push_back(shape);
    for (const Shape& shape : shapes_)
      if (shape.kind != DMRP_SHAPE_CIRCLE)
        vertices_.insert(vertices_.end(), shape.vertices, shape.vertices + shape.vertex_count);
    std::size_t first = 0;
    for (Shape& shape : shapes_) {
      shape.name = nullptr;
      if (shape.kind == DMRP_SHAPE_CIRCLE) continue;
      shape.vertices = vertices_.data() + first;
      first += shape.vertex_count;
    }
  }
  StaticShapes(StaticShapes&&) = default;  // a copy would point into the original
  StaticShapes& operator=(StaticShapes&&) = default;

  bool are_those_of(const World& world) const {
    const auto same = [](const Shape& own, const Shape& other) {
      if (own.kind != other.kind) return false;
      if (own.kind == DMRP_SHAPE_CIRCLE) return own.center == other.center && own.radius_m == other.radius_m;
      return std::equal(own.vertices, own.vertices + own.vertex_count, other.vertices,
                        other.vertices + other.vertex_count);
    };
    return border_.lower == world->lower && border_.upper == world->upper && shapes_.size() == world.shapes().size() &&
           std::equal(shapes_.begin(), shapes_.end(), world.shapes().begin(), same);
  }

  const toolkit::Rectangle& border() const { return border_; }
  std::size_t size() const { return shapes_.size(); }
  const Shape& operator[](std::size_t index) const { return shapes_[index]; }

 private:
  toolkit::Rectangle border_;
  std::vector<Shape> shapes_;  // their vertices point into vertices_
  std::vector<Vec2> vertices_;
};

// Knows where the centre of a disc may be among these shapes. Square cells find those near a place.
class FreeSpace {
 public:
  // The shapes must outlive this object.
  FreeSpace(const StaticShapes& shapes, double radius_m) : shapes_(shapes), radius_m_(radius_m) {
    const Vec2 size = shapes.border().upper - shapes.border().lower;
    const double cells = 16.0 + 4.0 * static_cast<double>(shapes.size());
    cell_m_ = std::max({radius_m, std::sqrt(size.x * size.y / cells), (size.x + size.y) / cells});
    columns_ = 1 + static_cast<std::int64_t>(size.x / cell_m_);
    rows_ = 1 + static_cast<std::int64_t>(size.y / cell_m_);
    cells_.resize(static_cast<std::size_t>(columns_ * rows_));
    for (std::uint32_t index = 0; index < shapes.size(); ++index) {
      const toolkit::Rectangle box = widened(toolkit::bounds(shapes[index]));
      boxes_.push_back(box);
      for (std::int64_t row = row_of(box.lower.y); row <= row_of(box.upper.y); ++row)
        for (std::int64_t column = column_of(box.lower.x); column <= column_of(box.upper.x); ++column)
          shapes_in(row, column).push_back(index);
    }
    seen_.assign(shapes.size(), 0);
  }

  double radius_m() const { return radius_m_; }
  const StaticShapes& shapes() const { return shapes_; }

  // The shapes that a disc about this point may reach, ascending.
  const std::vector<std::uint32_t>& near(Vec2 point) const {
    return cells_[static_cast<std::size_t>(row_of(point.y) * columns_ + column_of(point.x))];
  }

  // Calls visit(index) for each shape that is nearer to the point than this, and for some that are not, ascending.
  template <class Visit>
  void visit_near(Vec2 point, double distance_m, Visit&& visit) const {
    std::vector<std::uint32_t> found;
    for (std::int64_t row = row_of(point.y - distance_m); row <= row_of(point.y + distance_m); ++row)
      for (std::int64_t column = column_of(point.x - distance_m); column <= column_of(point.x + distance_m); ++column)
        found.insert(found.end(), shapes_in(row, column).begin(), shapes_in(row, column).end());
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    for (const std::uint32_t index : found) visit(index);
  }

  // Gives at most radius_m, since walls farther away do not count.
  double clearance_m(Vec2 point) const {
    double nearest_m = std::min(radius_m_, toolkit::depth(shapes_.border(), point));
    for (const std::uint32_t index : near(point))
      if (toolkit::contains(boxes_[index], point))
        nearest_m = std::min(nearest_m, toolkit::signed_distance(shapes_[index], point));
    return nearest_m;
  }
  bool is_clear(Vec2 point) const { return clearance_m(point) >= radius_m_ - touching_m; }

  // Whether a disc of at most radius_m stays clear along the leg; its ends keep clear of the border.
  bool is_clear(const Segment& leg, double radius_m) const {
    ++search_;
    const double least_m = radius_m - touching_m;
    const bool up = leg.from.y <= leg.to.y;
    const Vec2 low = up ? leg.from : leg.to;
    const Vec2 high = up ? leg.to : leg.from;
    for (std::int64_t row = row_of(low.y), last = row_of(high.y); row <= last; ++row) {
      const double from_x = x_at(low, high, bottom_of(row) - touching_m);
      const double to_x = x_at(low, high, bottom_of(row + 1) + touching_m);
      const std::int64_t last_column = column_of(std::max(from_x, to_x) + touching_m);
      for (std::int64_t column = column_of(std::min(from_x, to_x) - touching_m); column <= last_column; ++column)
        for (const std::uint32_t index : shapes_in(row, column)) {
          if (seen_[index] == search_) continue;
          seen_[index] = search_;
          if (!passes(index, leg, least_m)) return false;
        }
    }
    return true;
  }
  bool is_clear(const Segment& leg) const { return is_clear(leg, radius_m_); }

  // The free point to which a disc that is too near to walls moves away, each time from the nearest; false if it finds
  // none.
  bool move_clear(Vec2& point) const {
    constexpr int most_moves = 64;
    for (int moves = 0; moves < most_moves; ++moves) {
      if (is_clear(point)) return true;
      point = toolkit::closest_point(inner(), point);
      double nearest_m = radius_m_ - touching_m;
      const Shape* nearest = nullptr;
      for (const std::uint32_t index : near(point)) {
        const double distance_m = toolkit::signed_distance(shapes_[index], point);
        if (distance_m >= nearest_m) continue;
        nearest_m = distance_m;
        nearest = &shapes_[index];
      }
      if (nearest != nullptr) point = moved_out(*nearest, nearest_m, point);
    }
    return false;
  }

  // The border's rectangle for the centre of the disc; a point or a line if the world is too narrow.
  toolkit::Rectangle inner() const {
    const toolkit::Rectangle& border = shapes_.border();
    const Vec2 middle = 0.5 * (border.lower + border.upper);
    return {{std::min(border.lower.x + radius_m_, middle.x), std::min(border.lower.y + radius_m_, middle.y)},
            {std::max(border.upper.x - radius_m_, middle.x), std::max(border.upper.y - radius_m_, middle.y)}};
  }

 private:
  toolkit::Rectangle widened(const toolkit::Rectangle& box) const {
    const Vec2 reach = {radius_m_ + touching_m, radius_m_ + touching_m};
    return {box.lower - reach, box.upper + reach};
  }

  std::int64_t row_of(double y) const { return line(y - shapes_.border().lower.y, rows_); }
  std::int64_t column_of(double x) const { return line(x - shapes_.border().lower.x, columns_); }
  std::int64_t line(double from_border_m, std::int64_t count) const {
    const double last = static_cast<double>(count - 1);
    return static_cast<std::int64_t>(std::clamp(from_border_m / cell_m_, 0.0, last));
  }
  double bottom_of(std::int64_t row) const { return shapes_.border().lower.y + static_cast<double>(row) * cell_m_; }
  std::vector<std::uint32_t>& shapes_in(std::int64_t row, std::int64_t column) {
    return cells_[static_cast<std::size_t>(row * columns_ + column)];
  }
  const std::vector<std::uint32_t>& shapes_in(std::int64_t row, std::int64_t column) const {
    return cells_[static_cast<std::size_t>(row * columns_ + column)];
  }

  // Gives the x at which a leg from `low` to `high` has this y, or that of its nearer end.
  static double x_at(Vec2 low, Vec2 high, double y) {
    if (y <= low.y) return low.x;
    if (y >= high.y) return high.x;
    return low.x + (high.x - low.x) * ((y - low.y) / (high.y - low.y));
  }

  bool passes(std::uint32_t index, const Segment& leg, double least_m) const {
    const Shape& shape = shapes_[index];
    const toolkit::Rectangle& box = boxes_[index];
    if (std::max(leg.from.x, leg.to.x) < box.lower.x || std::min(leg.from.x, leg.to.x) > box.upper.x ||
        std::max(leg.from.y, leg.to.y) < box.lower.y || std::min(leg.from.y, leg.to.y) > box.upper.y)
      return true;
    if (shape.kind != DMRP_SHAPE_CIRCLE && lies_beside(shape, leg, least_m)) return true;
    return toolkit::distance(shape, leg) >= least_m;
  }

  // Whether the line of the leg already keeps clear of the polygon, which is most often so.
  static bool lies_beside(const Shape& polygon, const Segment& leg, double least_m) {
    const Vec2 along = leg.to - leg.from;
    const double least = least_m * toolkit::norm(along);
    double left = std::numeric_limits<double>::infinity();
    double right = -left;
    for (const Vec2 vertex : toolkit::polygon_of(polygon)) {
      const double side = toolkit::cross(along, vertex - leg.from);
      left = std::min(left, side);
      right = std::max(right, side);
    }
    return left >= least || right <= -least;
  }

  Vec2 moved_out(const Shape& shape, double distance_m, Vec2 point) const {
    if (shape.kind == DMRP_SHAPE_CIRCLE) {
      const Vec2 outward = toolkit::normalized(point - shape.center);
      return shape.center + (shape.radius_m + radius_m_) * (outward == Vec2{0.0, 0.0} ? Vec2{1.0, 0.0} : outward);
    }
    const toolkit::PolygonView polygon = toolkit::polygon_of(shape);
    const Vec2 on_border = toolkit::closest_border_point(polygon, point);
    if (std::abs(distance_m) > touching_m)
      return on_border + (radius_m_ / distance_m) * (point - on_border);  // distance_m is negative inside
    std::size_t nearest = 0;                                              // edge
    for (std::size_t edge = 1; edge < polygon.size(); ++edge)
      if (toolkit::distance(polygon.edge(edge), point) < toolkit::distance(polygon.edge(nearest), point))
        nearest = edge;
    const Segment edge = polygon.edge(nearest);
    return on_border - radius_m_ * toolkit::perpendicular(toolkit::normalized(edge.to - edge.from));
  }

  const StaticShapes& shapes_;
  double radius_m_;
  double cell_m_ = 1.0;
  std::int64_t columns_ = 1;
  std::int64_t rows_ = 1;
  std::vector<std::vector<std::uint32_t>> cells_;  // by row and column: shapes whose widened box reaches into it
  std::vector<toolkit::Rectangle> boxes_;          // by shape: widened by the radius
  mutable std::vector<std::uint64_t> seen_;        // by shape: the last search that looked at it
  mutable std::uint64_t search_ = 0;
};

}  // namespace dmrp::metrics
