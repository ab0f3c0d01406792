// SPDX-License-Identifier: MIT
#include "core/scene/static_geometry.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/segment.hpp>
#include <dmrp/toolkit/shape_distance.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/scene/cell_map.hpp"
#include "core/scene/convex_separation.hpp"
#include "core/scene/touching.hpp"

namespace dmrp::core {
namespace {

constexpr std::size_t circle_sides = 24;

void append_outline(toolkit::PolygonView polygon, std::vector<dmrp_segment>& segments) {
  for (std::size_t i = 0; i < polygon.size(); ++i) segments.push_back(polygon.edge(i));
}

std::vector<dmrp_segment> outlines(const std::vector<Shape>& shapes, const toolkit::Rectangle& border) {
  std::vector<dmrp_segment> segments;
  for (const Shape& shape : shapes) {
    if (shape.kind == Shape::Kind::circle) {
      // The polygon encloses the circle, so that nobody comes closer to it than its surface.
      const double corner_radius_m = shape.radius_m / std::cos(toolkit::pi / circle_sides);
      append_outline(toolkit::polygon_of_circle(shape.center, corner_radius_m, circle_sides), segments);
    } else {
      append_outline(shape.vertices, segments);
    }
  }
  const std::vector<dmrp_vec2> corners = {
      border.lower, {border.upper.x, border.lower.y}, border.upper, {border.lower.x, border.upper.y}};
  append_outline(corners, segments);
  return segments;
}

Shape shape_of(const dmrp_shape& shape) {
  const bool is_circle = shape.kind == DMRP_SHAPE_CIRCLE;
  const bool is_polygon = shape.kind == DMRP_SHAPE_POLYGON && shape.vertex_count >= 3;
  if (!is_circle && !is_polygon)
    throw std::invalid_argument("the shape " + std::string(shape.name) + " is neither a circle nor a polygon");
  Shape copy;
  copy.name = shape.name;
  copy.kind = is_circle ? Shape::Kind::circle : Shape::Kind::polygon;
  copy.center = shape.center;
  copy.radius_m = shape.radius_m;
  copy.vertices.assign(shape.vertices, shape.vertices + shape.vertex_count);
  copy.height_m = shape.height_m;
  return copy;
}

std::vector<Shape> shapes_of(const dmrp_world& world) {
  std::vector<Shape> shapes;
  for (std::uint32_t i = 0; i < world.shape_count; ++i)
    shapes.push_back(shape_of(*DMRP_AT(dmrp_shape, world.shapes, world.shape_stride, i)));
  return shapes;
}

BoxTree tree_of(const std::vector<dmrp_shape>& shapes) {
  std::vector<toolkit::Rectangle> boxes;
  for (const dmrp_shape& shape : shapes) boxes.push_back(toolkit::bounds(shape));
  return BoxTree(boxes);
}

toolkit::Rectangle box_around(dmrp_vec2 a, dmrp_vec2 b, double margin_m) {
  return {{std::min(a.x, b.x) - margin_m, std::min(a.y, b.y) - margin_m},
          {std::max(a.x, b.x) + margin_m, std::max(a.y, b.y) + margin_m}};
}

}  // namespace

std::vector<dmrp_shape> sdk_shapes_of(const std::vector<Shape>& shapes) {
  std::vector<dmrp_shape> sdk_shapes;
  for (const Shape& shape : shapes) {
    dmrp_shape view{};
    view.name = shape.name.c_str();
    view.kind = shape.kind == Shape::Kind::circle ? DMRP_SHAPE_CIRCLE : DMRP_SHAPE_POLYGON;
    view.vertex_count = static_cast<std::uint32_t>(shape.vertices.size());
    view.center = shape.center;
    view.radius_m = shape.radius_m;
    view.vertices = shape.vertices.data();
    view.height_m = shape.height_m;
    sdk_shapes.push_back(view);
  }
  return sdk_shapes;
}

StaticGeometry::StaticGeometry(const Scenario& scenario)
    : StaticGeometry({scenario.lower, scenario.upper}, scenario.shapes) {
  has_open_edge_ = scenario.edge_is_open;
}

StaticGeometry::StaticGeometry(const dmrp_world& world)
    : StaticGeometry({world.lower, world.upper}, shapes_of(world)) {}

StaticGeometry::StaticGeometry(const toolkit::Rectangle& rectangle, std::vector<Shape> shapes)
    : lower_(rectangle.lower),
      upper_(rectangle.upper),
      shapes_(std::move(shapes)),
      sdk_shapes_(sdk_shapes_of(shapes_)),
      segments_(outlines(shapes_, {lower_, upper_})),
      tree_(tree_of(sdk_shapes_)) {}

std::string_view StaticGeometry::shape_name(std::uint32_t shape) const {
  assert(shape <= border());
  return shape < shapes_.size() ? std::string_view(shapes_[shape].name) : "the border";
}

bool StaticGeometry::is_open_edge(std::uint32_t shape) const {
  return has_open_edge_ && (shape == border() || shape_name(shape).starts_with(beyond_map));
}

bool StaticGeometry::inside_world(dmrp_vec2 point) const {
  return toolkit::contains(rectangle(), point);
}

NearestShape StaticGeometry::nearest(dmrp_vec2 point) const {
  const double to_border = std::max(0.0, toolkit::depth(rectangle(), point));
  const auto [to_shape, shape] =
      tree_.nearest(point, [&](std::uint32_t index) { return toolkit::distance(sdk_shapes_[index], point); });
  if (to_shape <= to_border) return {to_shape, shape};
  return {to_border, border()};
}

bool StaticGeometry::disc_is_free(dmrp_vec2 center, double radius_m) const {
  return sweep_is_free(center, center, radius_m);
}

bool StaticGeometry::sweep_is_free(dmrp_vec2 from, dmrp_vec2 to, double radius_m) const {
  // The border is convex: it contains the motion if it contains both ends.
  const double least_m = radius_m - touching_m;
  if (toolkit::depth(rectangle(), from) < least_m || toolkit::depth(rectangle(), to) < least_m) return false;
  std::vector<std::uint32_t> near;
  tree_.touching(box_around(from, to, radius_m), near);
  return std::all_of(near.begin(), near.end(), [&](std::uint32_t shape) {
    const double distance = toolkit::distance(sdk_shapes_[shape], dmrp_segment{from, to});
    // Even a point must not pass through a shape.
    return distance >= least_m && distance > 0.0;
  });
}

double StaticGeometry::clearance(toolkit::PolygonView polygon, double at_most_m) const {
  double nearest_m = at_most_m;
  for (const dmrp_vec2 vertex : polygon) nearest_m = std::min(nearest_m, toolkit::depth(rectangle(), vertex));
  const toolkit::Rectangle box = toolkit::bounds(polygon);
  std::vector<std::uint32_t> near;
  tree_.touching(box_around(box.lower, box.upper, at_most_m), near);
  for (const std::uint32_t shape : near) {
    const dmrp_shape& body = sdk_shapes_[shape];
    const Separation apart = body.kind == DMRP_SHAPE_CIRCLE ? separation(polygon, body.center, body.radius_m)
                                                            : separation(polygon, toolkit::polygon_of(body));
    nearest_m = std::min(nearest_m, apart.distance_m);
  }
  return nearest_m;
}

bool StaticGeometry::line_of_sight(dmrp_vec2 a, dmrp_vec2 b) const {
  std::vector<std::uint32_t> near;
  tree_.touching(box_around(a, b, 0.0), near);
  return std::all_of(near.begin(), near.end(), [&](std::uint32_t shape) {
    return toolkit::distance(sdk_shapes_[shape], dmrp_segment{a, b}) > 0.0;
  });
}

void StaticGeometry::shapes_near(const toolkit::Rectangle& box, std::vector<std::uint32_t>& found) const {
  tree_.touching(box, found);
}

SurfaceDistance StaticGeometry::distance_to(std::uint32_t shape, dmrp_vec2 point) const {
  assert(shape < border());
  const dmrp_shape& body = sdk_shapes_[shape];
  if (body.kind == DMRP_SHAPE_CIRCLE) {
    const dmrp_vec2 away = point - body.center;
    const double distance = toolkit::norm(away);
    const dmrp_vec2 outward = distance > 0.0 ? away / distance : dmrp_vec2{1.0, 0.0};
    return {distance - body.radius_m, outward};
  }
  const toolkit::PolygonView polygon = toolkit::polygon_of(body);
  const dmrp_vec2 away = point - toolkit::closest_border_point(polygon, point);
  const double distance = toolkit::norm(away);
  const bool inside = toolkit::contains(polygon, point);
  if (distance > 1e-12) return {inside ? -distance : distance, inside ? -(away / distance) : away / distance};
  // On the outline: the normal of the nearest edge.
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < polygon.size(); ++i)
    if (toolkit::distance(polygon.edge(i), point) < toolkit::distance(polygon.edge(nearest), point)) nearest = i;
  const dmrp_segment edge = polygon.edge(nearest);
  return {0.0, -toolkit::perpendicular(toolkit::normalized(edge.to - edge.from))};
}

}  // namespace dmrp::core
