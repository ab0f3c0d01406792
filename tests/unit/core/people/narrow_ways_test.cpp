// SPDX-License-Identifier: MIT
#include "core/people/narrow_ways.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/random.hpp>
#include <numbers>

#include "core/scene/static_geometry.hpp"
#include "tests/support/draws.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

namespace narrow_ways_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

constexpr double radius_m = 0.2;

// A rectangle that begins at `from` and goes on for `length_m` along `heading`, `thickness_m` to its left.
Shape wall(dmrp_vec2 from, double heading, double length_m, double thickness_m) {
  const dmrp_vec2 along = length_m * dmrp_vec2{std::cos(heading), std::sin(heading)};
  const dmrp_vec2 left = thickness_m * dmrp_vec2{-std::sin(heading), std::cos(heading)};
  Shape shape;
  shape.name = "wall";
  shape.vertices = {from, from + along, from + along + left, from + left};
  return shape;
}

// Whether people get from corner to corner of a room that a wall with one gap divides; `middle`: of the gap.
bool gets_through(dmrp_vec2 middle, double heading, double gap_m, double thickness_m) {
  Scenario scenario = empty_scenario(8, 8);
  const dmrp_vec2 along = {std::cos(heading), std::sin(heading)};
  scenario.shapes = {wall(middle + 0.5 * gap_m * along, heading, 20.0, thickness_m),
                     wall(middle + (-0.5 * gap_m - 20.0) * along, heading, 20.0, thickness_m)};
  const StaticGeometry geometry(scenario);
  const PlanningGrid grid = build_walking_grid(geometry, radius_m);
  const dmrp_grid view = grid.view();
  const toolkit::GridView cells(view);
  const dmrp_vec2 ahead = {along.y, -along.x};
  const auto seen = reachable_cells(grid, cells.index(cells.cell_of(middle + 2.0 * ahead)));
  return seen[cells.index(cells.cell_of(middle - (2.0 + thickness_m) * ahead))];
}

TEST_CASE("whether people get through a door does not depend on where the grid lies") {
  for (int offset = 0; offset < 20; ++offset) {
    const dmrp_vec2 middle = {4.0 + 0.0125 * (7 * offset % 20), 4.0 + 0.0125 * offset};
    for (const double heading : {0.0, 0.5 * std::numbers::pi})
      for (const double thickness_m : {0.05, 0.1, 0.3}) {
        INFO("middle " << middle.x << ", " << middle.y << ", heading " << heading << ", thickness " << thickness_m);
        for (const double gap_m : {0.38, 0.399}) CHECK_FALSE(gets_through(middle, heading, gap_m, thickness_m));
        for (const double gap_m : {0.4, 0.42, 0.5, 0.6}) {
          INFO("gap " << gap_m);
          CHECK(gets_through(middle, heading, gap_m, thickness_m));
        }
      }
  }
}

// In a slanted wall a gap that is hardly wider than a person may be missed.
TEST_CASE("a door in a wall at any angle lets people through who are slimmer, and nobody else") {
  toolkit::Stream stream(1, "narrow ways");
  for (int draw = 0; draw < dmrp::test::draws(400); ++draw) {
    const dmrp_vec2 middle = {stream.uniform(3.5, 4.5), stream.uniform(3.5, 4.5)};
    const double heading = stream.uniform(0.0, 2.0 * std::numbers::pi);
    const double gap_m = stream.uniform(0.2, 0.8);
    const double thickness_m = stream.uniform(0.02, 0.6);
    if (gap_m > 2.0 * radius_m - 0.001 && gap_m < 2.0 * radius_m + 0.05) continue;
    INFO("middle " << middle.x << ", " << middle.y << ", heading " << heading << ", thickness " << thickness_m
                   << ", gap " << gap_m);
    CHECK(gets_through(middle, heading, gap_m, thickness_m) == (gap_m > 2.0 * radius_m));
  }
}

}  // namespace narrow_ways_test
