// SPDX-License-Identifier: MIT
#include "core/people/flow_routes.hpp"

#include <catch2/catch.hpp>
#include <dmrp/toolkit/rectangle.hpp>

#include "core/scene/planning_grid.hpp"
#include "core/scene/static_geometry.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

namespace flow_routes_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

TEST_CASE("the route of a flow goes around obstacles") {
  Scenario scenario = empty_scenario(20, 10);
  scenario.shapes = {box("wall", {9.9, 0}, {10.1, 8})};
  scenario.regions = {{"west", {1, 1}, {3, 3}}, {"east", {17, 1}, {19, 3}}};
  scenario.flows = {{"across", {0, 1, 0}, 4}};
  const StaticGeometry geometry(scenario);
  const FlowRoutes routes = find_flow_routes(scenario, build_walking_grid(geometry, 0.3));
  REQUIRE(routes.legs.size() == 1);
  REQUIRE(routes.legs[0].size() == 2);
  const Route& there = routes.legs[0][0];
  CHECK(there.front() == dmrp_vec2{2, 2});
  CHECK(toolkit::contains(toolkit::Rectangle{{17, 1}, {19, 3}}, there.back()));
  CHECK(routes.legs[0][1].front() == there.back());
  double highest = 0.0;
  for (const dmrp_vec2 point : there) {
    CHECK(geometry.clearance(point) > 0.2);
    highest = std::max(highest, point.y);
  }
  CHECK(highest > 8.2);
}

}  // namespace flow_routes_test
