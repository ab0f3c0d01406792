// SPDX-License-Identifier: MIT
#include "host/scenario/read_shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/polygon.hpp>
#include <utility>

#include "host/errors/mistakes.hpp"
#include "host/scenario/scenario_values.hpp"
#include "host/toml/setting.hpp"

namespace dmrp::host {
namespace {

core::Shape read_box(const TomlTable& table) {
  Mistakes mistakes;
  mistakes.attempt([&] { table.allow_only_keys(box_keys()); });
  core::Shape shape;
  dmrp_vec2 center = {};
  mistakes.attempt([&] { center = point(table.need("center_m")); });
  dmrp_vec2 extent = {};
  mistakes.attempt([&] { extent = size(table.need("size_m")); });
  double theta = 0.0;
  mistakes.attempt([&] {
    if (const auto turned = table.find("angle_rad")) theta = angle(*turned);
  });
  mistakes.end();
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  for (const auto& [i, j] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
    shape.vertices.push_back(
        {center.x + c * i * extent.x - s * j * extent.y, center.y + s * i * extent.x + c * j * extent.y});
  return shape;
}

core::Shape read_circle(const TomlTable& table) {
  Mistakes mistakes;
  mistakes.attempt([&] { table.allow_only_keys(circle_keys()); });
  core::Shape shape;
  shape.kind = core::Shape::Kind::circle;
  mistakes.attempt([&] { shape.center = point(table.need("center_m")); });
  mistakes.attempt([&] { shape.radius_m = positive(table.need("radius_m"), max_coordinate_m); });
  mistakes.end();
  return shape;
}

std::vector<dmrp_vec2> read_vertices(const TomlValue& value) {
  std::vector<dmrp_vec2> vertices;
  for (const TomlValue& vertex : value.array()) vertices.push_back(point(vertex));
  if (vertices.size() < 3) value.fail("'vertices_m' must have at least 3 points");
  if (toolkit::signed_area(vertices) < 0.0) std::reverse(vertices.begin(), vertices.end());
  if (!toolkit::is_convex_ccw(vertices)) value.fail("'vertices_m' must go round a convex polygon");
  return vertices;
}

core::Shape read_polygon(const TomlTable& table) {
  Mistakes mistakes;
  mistakes.attempt([&] { table.allow_only_keys(polygon_keys()); });
  core::Shape shape;
  mistakes.attempt([&] { shape.vertices = read_vertices(table.need("vertices_m")); });
  mistakes.end();
  return shape;
}

template <class Read>
void read_kind(const TomlTable& root, const std::string& kind, Read&& read, ScenarioFile& out) {
  root.read_tables(kind, [&](const TomlTable& table) {
    Mistakes mistakes;
    core::Shape shape;
    mistakes.attempt([&] { shape = read(table); });
    mistakes.attempt([&] {
      const auto name = table.find("name");
      shape.name = name ? name->line() : fmt::format("{} {}", kind, out.scenario.shapes.size() + 1);
      for (const core::Shape& other : out.scenario.shapes)
        if (other.name == shape.name)
          (name ? *name : table.need("name")).fail(fmt::format("there are two shapes '{}'", shape.name));
    });
    mistakes.attempt([&] {
      if (const auto height = table.find("height_m")) shape.height_m = positive(*height, max_coordinate_m);
    });
    mistakes.end();
    out.scenario.shapes.push_back(std::move(shape));
  });
}

}  // namespace

std::vector<TomlKey> box_keys() {
  return {{"name"},
          {"center_m", point_range()},
          {"size_m", size_range()},
          {"angle_rad", range_text(-max_angle_rad, max_angle_rad)},
          {"height_m", positive_text(max_coordinate_m)}};
}

std::vector<TomlKey> circle_keys() {
  return {{"name"},
          {"center_m", point_range()},
          {"radius_m", positive_text(max_coordinate_m)},
          {"height_m", positive_text(max_coordinate_m)}};
}

std::vector<TomlKey> polygon_keys() {
  return {{"name"}, {"vertices_m", point_range()}, {"height_m", positive_text(max_coordinate_m)}};
}

void read_shapes(const TomlTable& root, ScenarioFile& out) {
  Mistakes mistakes;
  mistakes.attempt([&] { read_kind(root, "box", read_box, out); });
  mistakes.attempt([&] { read_kind(root, "circle", read_circle, out); });
  mistakes.attempt([&] { read_kind(root, "polygon", read_polygon, out); });
  mistakes.end();
}

}  // namespace dmrp::host
