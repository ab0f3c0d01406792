// SPDX-License-Identifier: MIT
#include "core/tasks/free_regions.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <string>

#include "core/scene/static_geometry.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

namespace free_regions_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

constexpr std::array resolutions_m = {1.0, 0.5, 0.25, 0.1};
constexpr double most_cells = 1e6;

// Eight wards of 4 m by 4 m on either side of a corridor of this width. The doors of 0.9 m of the first `on_cells` of them
// have their middle on that of a cell of 1 m, the others on the line between two.
Scenario wards(double corridor_m, int on_cells) {
  Scenario scenario = empty_scenario(32.0, 8.0 + corridor_m);
  for (int ward = 0; ward < 16; ++ward) {
    const double left_m = 4.0 * (ward % 8);
    const double door_m = left_m + (ward < on_cells ? 1.5 : 2.0);
    const double wall_m = ward < 8 ? 3.9 : 4.0 + corridor_m;
    const double from_m = ward < 8 ? 0.0 : wall_m;
    const std::string name = std::to_string(ward);
    scenario.shapes.push_back(box("west " + name, {left_m, wall_m}, {door_m - 0.45, wall_m + 0.1}));
    scenario.shapes.push_back(box("east " + name, {door_m + 0.45, wall_m}, {left_m + 4.0, wall_m + 0.1}));
    scenario.shapes.push_back(box("side " + name, {left_m + 3.95, from_m}, {left_m + 4.0, from_m + 4.0}));
  }
  return scenario;
}

struct Count {
  std::size_t regions;
  std::size_t missed;
};

Count count_in(const Scenario& scenario, double cell_m, const RobotSettings& robot = {}) {
  const StaticGeometry geometry(scenario);
  SimulationSettings settings;
  const FreeRegions regions(geometry, robot, settings, {}, resolutions_m, most_cells);
  settings.grid_resolution_m = cell_m;
  return {regions.count(), regions.missed(PlanningGrids(geometry, robot, settings).standard())};
}

TEST_CASE("wards whose doors the cells miss are cut off; the corridor is no region") {
  for (const double corridor_m : {1.6, 2.0, 3.0})
    for (const int on_cells : {6, 10, 16}) {
      const Scenario scenario = wards(corridor_m, on_cells);
      INFO("corridor " << corridor_m << ", doors on cells " << on_cells);
      const Count coarse = count_in(scenario, 1.0);
      CHECK(coarse.regions == 16);
      CHECK(coarse.missed == static_cast<std::size_t>(16 - on_cells));
      CHECK(count_in(scenario, 0.1).missed == 0);
    }
}

TEST_CASE("what no robot fits into is no region") {
  Scenario scenario = wards(2.0, 16);
  scenario.shapes.push_back(box("locked", {1.0, 3.9}, {2.0, 4.0}));  // the first door
  CHECK(count_in(scenario, 1.0).regions == 15);
  CHECK(count_in(scenario, 1.0).missed == 0);
}

TEST_CASE("of two rooms, the larger one counts") {
  Scenario scenario = empty_scenario(12.0, 6.0);
  scenario.shapes = {box("south", {4.95, 0.0}, {5.05, 2.55}), box("north", {4.95, 3.45}, {5.05, 6.0})};
  const Count rooms = count_in(scenario, 1.0);
  CHECK(rooms.regions == 2);
  CHECK(rooms.missed == 1);
  CHECK(count_in(scenario, 0.1).missed == 0);
}

TEST_CASE("other parts are free cells that hang together with none that tasks are drawn on") {
  const auto has_others = [](const Scenario& scenario) {
    const StaticGeometry geometry(scenario);
    return has_other_parts(build_planning_grid(geometry, 1.0, 0.25, 0.1), {});
  };
  CHECK_FALSE(has_others(empty_scenario(6.0, 6.0)));
  CHECK_FALSE(has_others(wards(2.0, 16)));
  CHECK(has_others(wards(2.0, 15)));
}

}  // namespace free_regions_test
