// SPDX-License-Identifier: MIT
#include "host/world/walking_grids.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>

#include "tests/support/odd_plugins/grown.hpp"
#include "tests/unit/host/plugins/odd_library.hpp"

namespace walking_grids_test {

using namespace dmrp::host;
using namespace dmrp::test;
namespace core = dmrp::core;

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// The hall with a pillar and a wall.
core::Scenario furnished_hall() {
  core::Scenario scenario = hall(2);
  core::Shape pillar;
  pillar.kind = core::Shape::Kind::circle;
  pillar.center = {5.0, 3.1};
  pillar.radius_m = 0.4;
  core::Shape wall;
  wall.vertices = {{6.0, 4.0}, {6.2, 4.0}, {6.2, 6.0}, {6.0, 6.0}};
  scenario.shapes = {pillar, wall};
  return scenario;
}

const dmrp_grid* ask(WalkingGrids& grids, double resolution_m, double radius_m, int extra = 0) {
  const dmrp_walking_grid* const extension = grids.extension();
  return extension->grid(extension, Grown<dmrp_walking_grid_request>({0, 0, resolution_m, radius_m}, extra).get());
}

bool same(const dmrp_grid& a, const dmrp_grid& b) {
  const std::size_t cells = std::size_t{a.width} * a.height;
  return a.width == b.width && a.height == b.height && a.resolution_m == b.resolution_m && a.origin.x == b.origin.x &&
         a.origin.y == b.origin.y && std::memcmp(a.free, b.free, cells) == 0 &&
         std::memcmp(a.edges, b.edges, cells) == 0 && std::memcmp(a.clearance, b.clearance, cells * sizeof(float)) == 0;
}

TEST_CASE("equal requests get the same grid, others another one") {
  WalkingGrids grids(std::make_shared<const core::StaticGeometry>(furnished_hall()));
  const dmrp_grid* const grid = ask(grids, 0.5, 0.3);
  REQUIRE(grid);
  CHECK(grid->width == 20);
  CHECK(grid->height == 12);
  CHECK(grid->resolution_m == 0.5);
  CHECK(ask(grids, 0.5, 0.3) == grid);
  CHECK(ask(grids, 0.5, 0.3, 16) == grid);  // of a newer plugin
  CHECK(ask(grids, 0.25, 0.3) != grid);
  CHECK(ask(grids, 0.25, 0.3)->width == 40);
  const dmrp_grid* const wide = ask(grids, 0.5, 0.8);
  REQUIRE((wide && wide != grid));
  CHECK(std::count(wide->free, wide->free + 240, 1) < std::count(grid->free, grid->free + 240, 1));
  CHECK(ask(grids, 0.5, 0.3) == grid);
}

TEST_CASE("requests out of range get no grid") {
  WalkingGrids grids(std::make_shared<const core::StaticGeometry>(furnished_hall()));
  for (const double resolution_m : {0.0, -0.5, nan_value, infinity, 1e12, 5e-4, 1e-300})
    CHECK(ask(grids, resolution_m, 0.3) == nullptr);
  for (const double radius_m : {-0.1, nan_value, infinity}) CHECK(ask(grids, 0.5, radius_m) == nullptr);
  CHECK(ask(grids, 0.5, 0.3, -8) == nullptr);  // shorter than v1.0's
  CHECK(grids.extension()->grid(grids.extension(), nullptr) == nullptr);
  CHECK(ask(grids, 0.5, 0.0) != nullptr);
}

TEST_CASE("a request with a reserved field that is set gets no grid, even if there is one for the rest of it") {
  WalkingGrids grids(std::make_shared<const core::StaticGeometry>(furnished_hall()));
  REQUIRE(ask(grids, 0.5, 0.3) != nullptr);
  const Grown<dmrp_walking_grid_request> request({0, 7, 0.5, 0.3}, 0);
  CHECK(grids.extension()->grid(grids.extension(), request.get()) == nullptr);
}

TEST_CASE("a stored trace's world gives the grid of the trial's") {
  OddStage stage;
  stage.experiment.scenarios[0].scenario = furnished_hall();
  stage.experiment.scenarios[0].scenario.robots.resize(1);  // the other's way is blocked
  stage.run();
  WalkingGrids stored(stage.reader->world());
  for (const double resolution_m : {0.1, 0.5})
    for (const double radius_m : {0.0, 0.25}) {
      const dmrp_grid* const then = ask(*stage.variant->walking_grids, resolution_m, radius_m);
      const dmrp_grid* const now = ask(stored, resolution_m, radius_m);
      REQUIRE((then && now));
      CHECK(same(*then, *now));
    }
}

}  // namespace walking_grids_test
