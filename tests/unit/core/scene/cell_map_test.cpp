// SPDX-License-Identifier: MIT
// Maps of cells: as boxes, and as a planning grid that must be the one found from these boxes.
#include "core/scene/cell_map.hpp"

#include <catch2/catch.hpp>
#include <dmrp/toolkit/random.hpp>

#include "core/scene/static_geometry.hpp"

namespace cell_map_test {

using namespace dmrp;
using core::CellMap;

// Rows from the top, '@' blocked.
CellMap cells(const std::vector<std::string>& rows) {
  CellMap map{static_cast<std::uint32_t>(rows[0].size()), static_cast<std::uint32_t>(rows.size()), {}};
  for (auto row = rows.rbegin(); row != rows.rend(); ++row)
    for (const char letter : *row) map.free.push_back(letter == '@' ? 0 : 1);
  return map;
}

CellMap random_cells(toolkit::Stream& stream) {
  CellMap map{1 + static_cast<std::uint32_t>(stream.below(12)), 1 + static_cast<std::uint32_t>(stream.below(12)), {}};
  const double share = stream.uniform();
  for (std::uint32_t i = 0; i < map.width * map.height; ++i) map.free.push_back(stream.uniform() < share ? 0 : 1);
  return map;
}

core::Scenario scenario_of(const CellMap& map, double cell_m) {
  core::Scenario scenario;
  scenario.upper = {cell_m * map.width, cell_m * map.height};
  scenario.shapes = core::boxes_of(map, cell_m, {0.0, 0.0});
  return scenario;
}

TEST_CASE("blocked cells become boxes, each cell in one of them") {
  toolkit::Stream stream(1, "cells");
  for (int round = 0; round < 200; ++round) {
    const CellMap map = random_cells(stream);
    const auto boxes = core::boxes_of(map, 0.5, {3.0, -2.0});
    std::vector<int> times(map.free.size(), 0);
    for (const core::Shape& box : boxes) {
      REQUIRE(box.vertices.size() == 4);
      const dmrp_vec2 lower = box.vertices[0];
      const dmrp_vec2 upper = box.vertices[2];
      for (std::uint32_t row = 0; row < map.height; ++row)
        for (std::uint32_t column = 0; column < map.width; ++column) {
          const dmrp_vec2 center = {3.0 + 0.5 * (column + 0.5), -2.0 + 0.5 * (row + 0.5)};
          if (center.x > lower.x && center.x < upper.x && center.y > lower.y && center.y < upper.y)
            ++times[static_cast<std::size_t>(row) * map.width + column];
        }
    }
    for (std::size_t i = 0; i < times.size(); ++i) REQUIRE(times[i] == (map.free[i] != 0 ? 0 : 1));
  }
}

TEST_CASE("walls become one box in either direction") {
  CHECK(core::boxes_of(cells({"@@@@", "@@@@"}), 1.0, {}).size() == 1);
  CHECK(core::boxes_of(cells({"....", "...."}), 1.0, {}).empty());
  CHECK(core::boxes_of(cells({"@@@@", "....", "@@@@"}), 1.0, {}).size() == 2);
  // a comb: its teeth join along their columns only
  CHECK(core::boxes_of(cells({"@.@.@", "@.@.@", "@@@@@"}), 1.0, {}).size() == 4);
  const auto boxes = core::boxes_of(cells({"..@", "...", "..."}), 1.0, {});
  REQUIRE(boxes.size() == 1);  // the file's first row is the world's highest
  CHECK(boxes[0].vertices[0].x == 2.0);
  CHECK(boxes[0].vertices[0].y == 2.0);
}

TEST_CASE("the grid of cells is the grid of their boxes for a point") {
  toolkit::Stream stream(2, "cells");
  for (int round = 0; round < 100; ++round) {
    const CellMap map = random_cells(stream);
    const double cell_m = round % 2 == 0 ? 1.0 : 0.5;
    const core::PlanningGrid quick = core::planning_grid_of(map, cell_m);
    const core::StaticGeometry geometry(scenario_of(map, cell_m));
    const core::PlanningGrid exact = core::build_planning_grid(geometry, cell_m, 0.0, 0.0);
    REQUIRE(quick.width == exact.width);
    REQUIRE(quick.height == exact.height);
    REQUIRE(quick.resolution_m == exact.resolution_m);
    REQUIRE(quick.free == exact.free);
    REQUIRE(quick.edges == exact.edges);
    for (std::size_t i = 0; i < quick.clearance.size(); ++i)
      REQUIRE(quick.clearance[i] == Approx(exact.clearance[i]).margin(1e-6));
  }
}

}  // namespace cell_map_test
