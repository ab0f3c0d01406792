// SPDX-License-Identifier: MIT
// Robots and their plans: progress over several paths, when to plan again, and the order in which cells are passed.
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/random.hpp>
#include <map>
#include <optional>
#include <vector>

#include "core/execution/action_dependencies.hpp"
#include "core/execution/progress.hpp"
#include "core/execution/replanning.hpp"

using namespace dmrp;
using namespace dmrp::core;
using toolkit::Cell;

namespace {

constexpr std::int64_t second_ns = 1'000'000'000;

dmrp_waypoint waypoint(double x, double y, std::int64_t t_ns = 0) {
  dmrp_waypoint made{};
  made.x = x;
  made.y = y;
  made.t_ns = t_ns;
  return made;
}

std::vector<dmrp_waypoint> lane(double from, double to) {
  std::vector<dmrp_waypoint> path;
  for (double x = from; x <= to; x += 1.0) path.push_back(waypoint(x, 0));
  return path;
}

}  // namespace

TEST_CASE("a robot that is planned anew all the time gains what it drives") {
  // every 0.3 m a new path begins at the next cell's centre
  PathProgress progress;
  progress.set_path(lane(0, 9), {0.0, 0.0});
  for (int i = 1; i <= 70; ++i) {
    const double x = 0.1 * i;
    progress.update({x, 0.0}, 0);
    if (i % 3 == 0) progress.set_path(lane(std::ceil(x), 9), {x, 0.0});
  }
  CHECK(progress.gained_m() == Approx(7.0));
  CHECK(progress.off_path_m() == Approx(0.0).margin(1e-9));
}

TEST_CASE("a robot that swings to and fro gains nothing by new paths") {
  PathProgress progress;
  progress.set_path(lane(0, 9), {0.0, 0.0});
  progress.update({2.0, 0.0}, 0);
  for (int swing = 0; swing < 20; ++swing) {
    progress.update({1.2, 0.0}, 0);
    progress.set_path(lane(swing % 2 == 0 ? 1 : 2, 9), {1.2, 0.0});
    progress.update({1.6, 0.0}, 0);
    progress.update({2.0, 0.0}, 0);
  }
  CHECK(progress.gained_m() == Approx(2.0));
  progress.update({2.5, 0.0}, 0);
  CHECK(progress.gained_m() == Approx(2.5));
}

TEST_CASE("a path that begins elsewhere has begun when its first waypoint is passed") {
  PathProgress progress;
  progress.set_path(lane(2, 5), {1.0, 0.0});
  CHECK_FALSE(progress.has_begun());
  progress.update({1.5, 0.0}, 0);
  CHECK_FALSE(progress.has_begun());
  CHECK(progress.progress_m() == 0.0);
  CHECK(progress.waypoint() == 0);
  CHECK(progress.gained_m() == Approx(0.5));
  progress.update({3.2, 0.0}, 0);
  CHECK(progress.has_begun());
  CHECK(progress.progress_m() == Approx(1.2));
  CHECK(progress.waypoint() == 1);
}

namespace {

// One robot on a lane of 20 m, at 10 Hz; the times at which it is to be planned anew. `place` gives where it is.
template <class Place>
std::vector<double> replans(const ReplanSettings& settings, double until_s, Place&& place) {
  ReplanMonitor monitor(settings, 1);
  std::vector<RobotState> robots(1);
  std::vector<PathProgress> progress(1);
  progress[0].set_path(lane(0, 20), {0.0, 0.0});
  std::vector<double> times;
  for (int tick = 0; tick <= std::lround(10.0 * until_s); ++tick) {
    const double t_s = 0.1 * tick;
    progress[0].update(place(t_s), 0);
    if (monitor.due(tick * second_ns / 10, robots, progress)) times.push_back(t_s);
  }
  return times;
}

std::vector<double> approximately(const std::vector<double>& times) {
  std::vector<double> rounded;
  for (const double t : times) rounded.push_back(std::round(10.0 * t) / 10.0);
  return rounded;
}

}  // namespace

TEST_CASE("nobody plans anew unless told to") {
  CHECK(replans({}, 60.0, [](double) { return dmrp_vec2{0.0, 3.0}; }).empty());
}

TEST_CASE("planning anew every few seconds, or at the next control tick") {
  ReplanSettings settings;
  settings.period_ns = 2 * second_ns;
  const auto drives = [](double t_s) { return dmrp_vec2{0.5 * t_s, 0.0}; };
  CHECK(approximately(replans(settings, 6.5, drives)) == std::vector<double>{2.0, 4.0, 6.0});
  settings.period_ns = 1'750'000'000;
  CHECK(approximately(replans(settings, 4.0, drives)) == std::vector<double>{1.8, 3.6});
}

TEST_CASE("planning anew when a robot strays, no sooner than allowed") {
  ReplanSettings settings;
  settings.stray_m = 1.0;
  // 1.05 m off at 2.1 s; the planner was asked at 0 s first
  const auto strays = [](double t_s) { return dmrp_vec2{2.0, 0.5 * t_s}; };
  CHECK(approximately(replans(settings, 6.5, strays)) == std::vector<double>{2.1, 4.1, 6.1});
  settings.min_interval_ns = 3 * second_ns;
  CHECK(approximately(replans(settings, 6.5, strays)) == std::vector<double>{3.0, 6.0});
}

TEST_CASE("planning anew when a robot stalls, and again when that did not help") {
  ReplanSettings settings;
  settings.stall_ns = 5 * second_ns;
  // drives for 3 s and 1.65 m; the last gain of 0.2 m was complete at 2.8 s
  const auto stalls = [](double t_s) { return dmrp_vec2{0.55 * std::min(t_s, 3.0), 0.0}; };
  CHECK(approximately(replans(settings, 15.0, stalls)) == std::vector<double>{7.8, 12.8});
}

TEST_CASE("robots that are not active give no reason to plan") {
  ReplanSettings settings;
  settings.period_ns = second_ns;
  ReplanMonitor monitor(settings, 1);
  std::vector<RobotState> robots(1);
  robots[0].state = DMRP_ROBOT_FINISHED;
  CHECK_FALSE(monitor.due(5 * second_ns, robots, std::vector<PathProgress>(1)));
}

namespace {

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

}  // namespace

TEST_CASE("who comes second to a crossing waits until the first has left it") {
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

TEST_CASE("a rotation is released when all stand in it") {
  // the last of four gets to the ring a step before it turns
  const std::vector<Walk> walks = {
      {{1, 1}, {1, 1}, {2, 1}}, {{2, 1}, {2, 1}, {2, 2}}, {{2, 2}, {2, 2}, {1, 2}}, {{0, 2}, {1, 2}, {1, 1}}};
  Ordered plan(walks);
  CHECK(plan.released() == Stages{0, 0, 0, 1});
  plan.dependencies.reached(3, 1);
  CHECK(plan.released() == Stages{1, 1, 1, 2});
}

TEST_CASE("a rotation waits as one for whom one of it waits") {
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

TEST_CASE("a diagonal has the cells beside it until it is done") {
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

TEST_CASE("a robot on the way to its first cell still has the cell where it is") {
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

namespace {

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

}  // namespace

TEST_CASE("however long robots take, they pass every cell in the plan's order, and none waits for ever") {
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
