// SPDX-License-Identifier: MIT
#include "core/execution/action_dependencies.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <map>
#include <optional>
#include <vector>

namespace action_dependencies_test {

using namespace dmrp;
using namespace dmrp::core;
using toolkit::Cell;

constexpr std::int64_t second_ns = 1'000'000'000;

dmrp_waypoint waypoint(double x, double y, std::int64_t t_ns) {
  dmrp_waypoint made{};
  made.x = x;
  made.y = y;
  made.t_ns = t_ns;
  return made;
}

// Cells of 1 m, a step a second.
constexpr std::uint32_t side = 5;
dmrp_grid open_grid() {
  dmrp_grid grid{};
  grid.struct_size = sizeof(grid);
  grid.width = side;
  grid.height = side;
  grid.resolution_m = 1.0;
  return grid;
}

using Walk = std::vector<Cell>;  // a cell a step

struct Ordered {
  explicit Ordered(const std::vector<Walk>& walks) {
    std::vector<dmrp_vec2> starts;
    for (const Walk& walk : walks) {
      paths.emplace_back();
      for (std::size_t t = 0; t < walk.size(); ++t)
        paths.back().push_back(
            waypoint(walk[t].column + 0.5, walk[t].row + 0.5, static_cast<std::int64_t>(t) * second_ns));
      starts.push_back(toolkit::position(paths.back()[0]));
    }
    dependencies.set_plan(open_grid(), paths, starts);
    for (std::size_t i = 0; i < walks.size(); ++i) dependencies.reached(i, 0);
  }

  std::vector<std::uint32_t> released() {
    std::vector<std::uint32_t> stages;
    for (std::size_t i = 0; i < paths.size(); ++i) stages.push_back(dependencies.released(i));
    return stages;
  }

  std::vector<std::vector<dmrp_waypoint>> paths;
  ActionDependencies dependencies;
};

using Stages = std::vector<std::uint32_t>;

TEST_CASE("the second robot at a crossing waits until the first has left it") {
  // the first passes (1, 1) at t = 1, the second, after a wait, at t = 3
  Ordered plan({{{0, 1}, {1, 1}, {2, 1}, {3, 1}}, {{1, 3}, {1, 2}, {1, 2}, {1, 1}, {1, 0}}});
  CHECK(plan.released() == Stages{3, 1});
  plan.dependencies.reached(0, 1);
  plan.dependencies.reached(1, 1);
  CHECK(plan.released() == Stages{3, 1});
  plan.dependencies.reached(0, 2);
  CHECK(plan.released() == Stages{3, 3});
}

TEST_CASE("robots in a row follow each other cell by cell") {
  Ordered plan({{{2, 0}, {3, 0}, {4, 0}}, {{1, 0}, {2, 0}, {3, 0}}, {{0, 0}, {1, 0}, {2, 0}}});
  CHECK(plan.released() == Stages{2, 0, 0});
  plan.dependencies.reached(0, 1);
  CHECK(plan.released() == Stages{2, 1, 0});
  plan.dependencies.reached(0, 2);
  CHECK(plan.released() == Stages{2, 2, 0});
  plan.dependencies.reached(1, 1);
  CHECK(plan.released() == Stages{2, 2, 1});
}

TEST_CASE("a rotation is released when all its robots have reached it") {
  // the last of four gets to the ring a step before it turns
  const std::vector<Walk> walks = {
      {{1, 1}, {1, 1}, {2, 1}}, {{2, 1}, {2, 1}, {2, 2}}, {{2, 2}, {2, 2}, {1, 2}}, {{0, 2}, {1, 2}, {1, 1}}};
  Ordered plan(walks);
  CHECK(plan.released() == Stages{0, 0, 0, 1});
  plan.dependencies.reached(3, 1);
  CHECK(plan.released() == Stages{1, 1, 1, 2});
}

TEST_CASE("a rotation waits as a whole if one of its robots must wait") {
  // a ring of diagonals, of which one passes a corner of (2, 2)
  Ordered plan({{{1, 0}, {1, 0}, {2, 1}},
                {{2, 1}, {2, 1}, {1, 2}},
                {{1, 2}, {1, 2}, {0, 1}},
                {{0, 1}, {0, 1}, {1, 0}},
                {{2, 2}, {3, 2}, {3, 2}}});
  CHECK(plan.released() == Stages{0, 0, 0, 0, 1});
  plan.dependencies.reached(4, 1);
  CHECK(plan.released() == Stages{1, 1, 1, 1, 1});
}

TEST_CASE("a diagonal move occupies the cells beside it until it ends") {
  Ordered plan({{{0, 0}, {1, 1}, {2, 2}}, {{3, 0}, {2, 0}, {1, 0}, {0, 0}}});
  CHECK(plan.released() == Stages{2, 1});
  plan.dependencies.reached(0, 1);
  CHECK(plan.released() == Stages{2, 3});

  // and needs them clear
  Ordered other({{{0, 0}, {0, 0}, {0, 0}, {1, 1}}, {{1, 0}, {2, 0}, {3, 0}}});
  CHECK(other.released() == Stages{0, 2});
  other.dependencies.reached(1, 1);
  CHECK(other.released() == Stages{1, 2});
}

TEST_CASE("a robot on the way to its first cell still occupies the cell where it is") {
  const std::vector<std::vector<dmrp_waypoint>> paths = {{waypoint(2.5, 0.5, 0), waypoint(3.5, 0.5, second_ns)},
                                                         {waypoint(1.5, 1.5, 0), waypoint(1.5, 0.5, second_ns)}};
  ActionDependencies dependencies;
  dependencies.set_plan(open_grid(), paths, std::vector<dmrp_vec2>{{1.9, 0.5}, {1.5, 1.5}});
  dependencies.reached(1, 0);
  CHECK(dependencies.released(0) == 1);
  CHECK(dependencies.released(1) == 0);
  dependencies.reached(0, 0);
  CHECK(dependencies.released(1) == 1);
}

bool meets(Cell a0, Cell a1, Cell b0, Cell b1) {
  const auto passes = [](Cell from, Cell to, Cell cell) {
    return from.column != to.column && from.row != to.row &&
           (cell == Cell{from.column, to.row} || cell == Cell{to.column, from.row});
  };
  return a1 == b1 || (a0 == b1 && a1 == b0) || passes(a0, a1, b0) || passes(a0, a1, b1) || passes(b0, b1, a0) ||
         passes(b0, b1, a1);
}

// A plan without conflicts in which robots wander at random: full of rotations and of robots on each other's heels.
std::vector<Walk> wander(toolkit::Stream& random, std::size_t robots, int steps, bool diagonal) {
  std::vector<Walk> walks;
  for (std::size_t i = 0; i < robots; ++i) {
    const auto cell = static_cast<std::int32_t>(i * side * side / robots);
    walks.push_back({{cell % static_cast<std::int32_t>(side), cell / static_cast<std::int32_t>(side)}});
  }
  for (int step = 0; step < steps; ++step) {
    // all rest, and draw another move as long as they meet nobody, several times
    std::vector<Cell> next;
    for (const Walk& walk : walks) next.push_back(walk.back());
    const auto fits = [&](const std::vector<Cell>& moves) {
      for (std::size_t a = 0; a < robots; ++a)
        for (std::size_t b = a + 1; b < robots; ++b)
          if (meets(walks[a].back(), moves[a], walks[b].back(), moves[b])) return false;
      return true;
    };
    const auto turn_ring = [&](std::vector<Cell> moves) {
      const Cell corner = {static_cast<std::int32_t>(random.uniform(0, side - 1)),
                           static_cast<std::int32_t>(random.uniform(0, side - 1))};
      const Cell ring[] = {corner,
                           {corner.column + 1, corner.row},
                           {corner.column + 1, corner.row + 1},
                           {corner.column, corner.row + 1}};
      for (std::size_t i = 0; i < robots; ++i)
        for (std::size_t k = 0; k < 4; ++k)
          if (walks[i].back() == ring[k]) moves[i] = ring[(k + 1) % 4];
      return moves;
    };
    for (int attempt = 0; attempt < 40; ++attempt) {
      std::vector<Cell> changed = next;
      if (attempt < 5) {
        changed = turn_ring(next);
      } else {
        const auto i = static_cast<std::size_t>(random.uniform(0, static_cast<double>(robots)));
        const auto d = static_cast<std::size_t>(random.uniform(0, 8));
        if (!diagonal && d % 2 == 1) continue;
        const Cell at = walks[i].back();
        changed[i] = {at.column + toolkit::direction_dx[d], at.row + toolkit::direction_dy[d]};
        if (changed[i].column < 0 || changed[i].row < 0 || changed[i].column >= static_cast<std::int32_t>(side) ||
            changed[i].row >= static_cast<std::int32_t>(side))
          continue;
      }
      if (fits(changed)) next = changed;
    }
    for (std::size_t i = 0; i < robots; ++i) walks[i].push_back(next[i]);
  }
  return walks;
}

struct Visit {
  std::size_t robot;
  std::size_t stage;
  bool operator==(const Visit&) const = default;
};
using Visits = std::map<std::uint32_t, std::vector<Visit>>;  // by cell, in order

std::uint32_t index_of(Cell cell) {
  return static_cast<std::uint32_t>(cell.row) * side + static_cast<std::uint32_t>(cell.column);
}

// The stages of every robot, and the order in which the plan visits cells.
Visits visits_of(const std::vector<Walk>& walks, std::vector<std::vector<std::uint32_t>>& stages) {
  Visits visits;
  stages.assign(walks.size(), {});
  for (std::size_t t = 0; t < walks[0].size(); ++t)
    for (std::size_t i = 0; i < walks.size(); ++i) {
      const std::uint32_t cell = index_of(walks[i][t]);
      if (t > 0 && walks[i][t] == walks[i][t - 1]) continue;
      visits[cell].push_back({i, stages[i].size()});
      stages[i].push_back(cell);
    }
  return visits;
}

TEST_CASE("with any delays robots pass every cell in the plan's order, and none waits forever") {
  const bool diagonal = GENERATE(false, true);
  std::size_t moves = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    toolkit::Stream random(seed, "wandering", diagonal ? 1 : 0);
    const std::size_t robots = 2 + seed % 15;
    const std::vector<Walk> walks = wander(random, robots, 12, diagonal);
    std::vector<std::vector<std::uint32_t>> stages;
    const Visits planned = visits_of(walks, stages);
    Ordered plan(walks);

    Visits done;
    std::vector<std::size_t> at(robots, 0);
    for (std::size_t i = 0; i < robots; ++i) done[stages[i][0]].push_back({i, 0});
    for (;;) {
      const Stages released = plan.released();
      std::vector<std::size_t> ready;
      for (std::size_t i = 0; i < robots; ++i)
        if (at[i] < released[i]) ready.push_back(i);
      if (ready.empty()) break;
      const std::size_t i = ready[static_cast<std::size_t>(random.uniform(0, static_cast<double>(ready.size())))];
      ++at[i];
      ++moves;
      done[stages[i][at[i]]].push_back({i, at[i]});
      plan.dependencies.reached(i, static_cast<std::uint32_t>(at[i]));
    }
    for (std::size_t i = 0; i < robots; ++i) REQUIRE(at[i] + 1 == stages[i].size());
    REQUIRE(done == planned);
  }
  CHECK(moves > 10'000);
}

}  // namespace action_dependencies_test
