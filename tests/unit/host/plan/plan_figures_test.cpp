// SPDX-License-Identifier: MIT
// Figures of paths, computed by hand, on a grid of 6 x 4 cells of 0.5 m at (10, 20).
#include "host/plan/plan_figures.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

namespace plan_figures_test {

using namespace dmrp::host;

constexpr std::int64_t step_ns = 1'800'000'000;
constexpr std::int64_t from_ns = 500'000'000;

dmrp_grid grid_of_points() {
  dmrp_grid grid{};
  grid.struct_size = sizeof(grid);
  grid.width = 6;
  grid.height = 4;
  grid.resolution_m = 0.5;
  grid.origin = {10.0, 20.0};
  return grid;
}

const dmrp_grid grid = grid_of_points();

dmrp_planning_problem problem() {
  dmrp_planning_problem c{};
  c.struct_size = sizeof(c);
  c.effective_from_ns = from_ns;
  c.step_duration_ns = step_ns;
  c.grid = &grid;
  return c;
}

struct Place {
  double column;
  double row;
  std::uint32_t goal = 0;
};

// One waypoint per step; off the centres by rounding errors, as sums of coordinates are.
std::vector<dmrp_waypoint> path(const std::vector<Place>& places) {
  std::vector<dmrp_waypoint> out;
  for (const Place& p : places)
    out.push_back({10.0 + 0.5 * (p.column + 0.5) + 1e-12, 20.0 + 0.5 * (p.row + 0.5),
                   std::numeric_limits<double>::quiet_NaN(), from_ns + static_cast<std::int64_t>(out.size()) * step_ns,
                   p.goal, 0});
  return out;
}

PlanFigures figures(const PlannedPaths& paths, std::uint32_t connectivity = DMRP_CONNECTIVITY_4) {
  return figures_of(problem(), paths, connectivity);
}

TEST_CASE("moves and waits cost one, rest at the goal costs nothing") {
  const PlanFigures f =
      figures({path({{0, 0}, {1, 0}, {1, 0}, {1, 1}, {1, 1}, {1, 1}}), path({{3, 3}}), path({{5, 0}, {5, 0}, {5, 0}})});
  CHECK(f.cost == 3.0);
  CHECK(f.makespan == 3);
  CHECK(f.turns == 1);
}

TEST_CASE("who leaves its goal again was not at rest there") {
  const PlanFigures f = figures({path({{0, 0}, {1, 0}, {1, 0}, {0, 0}, {1, 0}, {1, 0}})});
  CHECK(f.cost == 4.0);
  CHECK(f.makespan == 4);
  CHECK(f.turns == 2);  // back and forth
}

TEST_CASE("diagonals cost the root of two") {
  const PlanFigures f =
      figures({path({{0, 0}, {1, 1}, {2, 2}, {2, 2}, {3, 2}}), path({{5, 3}, {4, 2}})}, DMRP_CONNECTIVITY_8);
  CHECK(f.cost == 2.0 + 3.0 * std::sqrt(2.0));
  CHECK(f.makespan == 4);
  CHECK(f.turns == 1);
}

TEST_CASE("on a tour the goals count, not the place") {
  // the last goal is where the robot stands: it must wait for it to become current
  const PlanFigures f = figures({path({{0, 0}, {1, 0}, {1, 0, 1}})});
  CHECK(f.cost == 2.0);
  CHECK(figures({path({{1, 0}, {1, 0, 1}, {1, 0, 1}})}).cost == 1.0);
}

TEST_CASE("paths at any angle: lengths in cells, fractions of steps rounded up") {
  auto direct = path({{0, 0}, {3, 3}});
  direct[1].t_ns = from_ns + 4 * step_ns + step_ns / 2;
  const PlanFigures f = figures({direct}, DMRP_CONNECTIVITY_ANY);
  CHECK(f.cost == Approx(3.0 * std::sqrt(2.0)));
  CHECK(f.makespan == 5);
  CHECK(paths_csv(problem(), {direct}) == "agent,t,x,y\n0,0,0,3\n0,4.5,3,0\n");
}

TEST_CASE("the file counts rows from the top and ends at the goal") {
  CHECK(paths_csv(problem(), {path({{0, 0}, {1, 0}, {1, 0}, {1, 1}, {1, 1}}), path({{5, 3}})}) ==
        "agent,t,x,y\n0,0,0,3\n0,1,1,3\n0,2,1,3\n0,3,1,2\n1,0,5,0\n");
}

}  // namespace plan_figures_test
