// SPDX-License-Identifier: MIT
#include "host/scenario/read_shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/polygon.hpp>
#include <utility>

#include "host/scenario/scenario_values.hpp"

namespace dmrp::host {
namespace {

core::Shape read_box(const TomlTable& table) {
  table.allow_only(box_keys);
  core::Shape shape;
  const dmrp_vec2 center = point(table.need("center_m"));
  const dmrp_vec2 extent = size(table.need("size_m"));
  const auto angle = table.find("angle_rad");
  const double theta = angle ? angle->number(-max_length_m, max_length_m) : 0.0;
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  for (const auto& [i, j] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
    shape.vertices.push_back(
        {center.x + c * i * extent.x - s * j * extent.y, center.y + s * i * extent.x + c * j * extent.y});
  return shape;
}

core::Shape read_circle(const TomlTable& table) {
  table.allow_only(circle_keys);
  core::Shape shape;
  shape.kind = core::Shape::Kind::circle;
  shape.center = point(table.need("center_m"));
  shape.radius_m = positive(table.need("radius_m"), max_length_m);
  return shape;
}

core::Shape read_polygon(const TomlTable& table) {
  table.allow_only(polygon_keys);
  core::Shape shape;
  const TomlValue vertices = table.need("vertices_m");
  for (const TomlValue& vertex : vertices.array()) shape.vertices.push_back(point(vertex));
  if (shape.vertices.size() < 3) vertices.fail("'vertices_m' must have at least 3 points");
  if (toolkit::signed_area(shape.vertices) < 0.0) std::reverse(shape.vertices.begin(), shape.vertices.end());
  if (!toolkit::is_convex_ccw(shape.vertices)) vertices.fail("'vertices_m' must go round a convex polygon");
  return shape;
}

template <class Read>
void read_kind(const TomlTable& root, const std::string& kind, Read&& read, ScenarioFile& out) {
  for (const TomlTable& table : root.tables(kind)) {
    core::Shape shape = read(table);
    const TomlValue name = table.need("name");
    shape.name = name.line();
    for (const core::Shape& other : out.scenario.shapes)
      if (other.name == shape.name) name.fail(fmt::format("there are two shapes '{}'", shape.name));
    if (const auto height = table.find("height_m")) shape.height_m = positive(*height, max_length_m);
    out.scenario.shapes.push_back(std::move(shape));
  }
}

}  // namespace

void read_shapes(const TomlTable& root, ScenarioFile& out) {
  read_kind(root, "box", read_box, out);
  read_kind(root, "circle", read_circle, out);
  read_kind(root, "polygon", read_polygon, out);
}

}  // namespace dmrp::host
