// SPDX-License-Identifier: MIT
// E3MoP's lattice: motions, heuristic, search and pruning.
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <functional>
#include <queue>

#include "tests/unit/controllers/e3mop/e3mop_window.hpp"

namespace lattice_test {

using namespace dmrp::controllers;
using namespace dmrp::controllers::e3mop;
using dmrp::test::e3mop_limits;
using dmrp::test::LatticeProblem;
using dmrp::test::Window;
using dmrp::toolkit::pi;
using dmrp::toolkit::Stream;

MotionSet motions_of(const dmrp_limits& limits = e3mop_limits) {
  MotionSet motions;
  motions.build(limits, 0.1);
  return motions;
}

const Direction& direction(int index) {
  return directions()[static_cast<std::size_t>(index)];
}

// A window with random discs, none near its centre.
Window strewn_window(Stream& random, int count) {
  std::vector<dmrp_vec2> discs;
  while (static_cast<int>(discs.size()) < count) {
    const dmrp_vec2 at = {random.uniform(-2.9, 2.9), random.uniform(-2.9, 2.9)};
    if (dmrp::toolkit::norm(at) > 0.8) discs.push_back(at);
  }
  return Window({0.0, 0.0, random.uniform(-pi, pi)}, [&](dmrp_vec2 point) {
    return std::any_of(discs.begin(), discs.end(),
                       [&](dmrp_vec2 disc) { return dmrp::toolkit::distance(disc, point) < 0.2; });
  });
}

bool is_clear(const LatticeProblem& problem, std::int32_t cell, const Motion& motion) {
  const dmrp_vec2 from = problem.frame.point_of(cell);
  for (std::uint32_t k = 0; k < motion.sample_count; ++k) {
    const DirectedPoint& sample = problem.motions.samples()[motion.first_sample + k];
    if (!problem.free_space.is_free({from + sample.at, sample.heading})) return false;
  }
  return true;
}

// Calls `visit(node, motion, next node)` for every free motion.
void for_all_edges(LatticeProblem& problem,
                   const std::function<void(std::int32_t, const Motion&, std::int32_t)>& visit) {
  for (std::int32_t cell = 0; cell < problem.frame.cell_count(); ++cell) {
    const std::int32_t column = problem.frame.column_of(cell);
    const std::int32_t row = problem.frame.row_of(cell);
    const dmrp_vec2 at = problem.frame.point_of(cell);
    if (!problem.frame.inside(column, row) || !problem.free_space.is_free({at, {1.0, 0.0}})) continue;
    for (int heading = 0; heading < direction_count; ++heading) {
      for (const Motion& motion : problem.motions.from(heading)) {
        if (!problem.frame.inside(column + motion.dx, row + motion.dy) || !is_clear(problem, cell, motion)) continue;
        visit(cell * direction_count + heading, motion,
              problem.frame.cell_at(column + motion.dx, row + motion.dy) * direction_count + motion.to_heading);
      }
    }
  }
}

// The minimum cost from the frame's centre at a heading to the goal's cells, without a heuristic; -1 if there is no
// path.
Ticks least_cost(LatticeProblem& problem, int heading) {
  std::vector<std::vector<std::pair<std::int32_t, Ticks>>> edges(
      static_cast<std::size_t>(problem.frame.cell_count() * direction_count));
  for_all_edges(problem, [&](std::int32_t from, const Motion& motion, std::int32_t to) {
    edges[static_cast<std::size_t>(from)].push_back({to, motion.cost});
  });
  std::vector<Ticks> costs(edges.size(), INT32_MAX);
  std::priority_queue<std::pair<Ticks, std::int32_t>, std::vector<std::pair<Ticks, std::int32_t>>, std::greater<>> open;
  open.push({0, problem.frame.center_cell() * direction_count + heading});
  costs[static_cast<std::size_t>(open.top().second)] = 0;
  while (!open.empty()) {
    const auto [cost, node] = open.top();
    open.pop();
    if (cost > costs[static_cast<std::size_t>(node)]) continue;
    if (problem.goal.distance(node / direction_count) == 0) return cost;
    for (const auto& edge : edges[static_cast<std::size_t>(node)]) {
      Ticks& known = costs[static_cast<std::size_t>(edge.first)];
      if (cost + edge.second >= known) continue;
      known = cost + edge.second;
      open.push({known, edge.first});
    }
  }
  return -1;
}

TEST_CASE("Motions end exactly on states of the lattice") {
  dmrp_limits limits = e3mop_limits;
  limits.v_max = GENERATE(0.3, 0.8, 1.5);
  limits.omega_max = GENERATE(0.5, 1.0, 3.0);
  const MotionSet motions = motions_of(limits);
  for (int heading = 0; heading < direction_count; ++heading) {
    int kinds[4] = {0, 0, 0, 0};
    for (const Motion& motion : motions.from(heading)) {
      CAPTURE(heading, motion.dx, motion.dy, motion.to_heading);
      ++kinds[static_cast<int>(motion.kind)];
      const DirectedPoint& end = motions.samples()[motion.first_sample + motion.sample_count - 1];
      CHECK(end.at.x == Approx(0.1 * motion.dx).margin(1e-12));
      CHECK(end.at.y == Approx(0.1 * motion.dy).margin(1e-12));
      CHECK(end.heading.x == Approx(direction(motion.to_heading).unit.x).margin(1e-12));
      CHECK(end.heading.y == Approx(direction(motion.to_heading).unit.y).margin(1e-12));
      // no faster than the limits
      const double turn =
          std::abs(dmrp::toolkit::difference(direction(heading).theta, direction(motion.to_heading).theta));
      CHECK(motion.cost >= motion.length_m / limits.v_max * ticks_per_s);
      CHECK(motion.cost >= turn / limits.omega_max * ticks_per_s);
    }
    CHECK(kinds[static_cast<int>(MotionKind::short_forward)] == 1);
    CHECK(kinds[static_cast<int>(MotionKind::long_forward)] == 1);
    CHECK(kinds[static_cast<int>(MotionKind::turn)] == 2);
    CHECK(kinds[static_cast<int>(MotionKind::arc)] >= 2);
  }
}

TEST_CASE("Motions are feasible for a unicycle") {
  const MotionSet motions = motions_of();
  for (int heading = 0; heading < direction_count; ++heading) {
    for (const Motion& motion : motions.from(heading)) {
      if (motion.kind == MotionKind::turn) continue;
      CAPTURE(heading, motion.dx, motion.dy);
      DirectedPoint at = {{0.0, 0.0}, direction(heading).unit};
      double length_m = 0.0;
      for (std::uint32_t k = 0; k < motion.sample_count; ++k) {
        const DirectedPoint& next = motions.samples()[motion.first_sample + k];
        const double chord_m = dmrp::toolkit::distance(at.at, next.at);
        REQUIRE(chord_m <= 0.05 + 1e-9);
        // forward, between the two headings
        const double along = dmrp::toolkit::bearing(at.at, next.at);
        const double before = dmrp::toolkit::difference(pose_of(at).theta, along);
        const double after = dmrp::toolkit::difference(along, pose_of(next).theta);
        REQUIRE(std::abs(before) + std::abs(after) == Approx(std::abs(before + after)).margin(1e-6));
        REQUIRE(std::abs(before + after) <= chord_m / motion.radius_m * 1.01 + 1e-9);
        length_m += chord_m;
        at = next;
      }
      CHECK(length_m == Approx(motion.length_m).epsilon(1e-3));
    }
  }
}

TEST_CASE("Motions are dropped by the angle between the direction to the goal and that of the motion") {
  const MotionSet motions = motions_of();
  for (int heading = 0; heading < direction_count; ++heading) {
    for (const Motion& motion : motions.from(heading)) {
      for (int way = 0; way < direction_count; ++way) {
        const bool dropped = (motion.dropped_for >> way & 1) != 0;
        if (motion.kind == MotionKind::short_forward || motion.kind == MotionKind::turn) {
          REQUIRE_FALSE(dropped);
          continue;
        }
        const double apart =
            std::abs(dmrp::toolkit::difference(std::atan2(motion.dy, motion.dx), direction(way).theta));
        REQUIRE(dropped == (apart > pi / 4));
      }
    }
  }
}

TEST_CASE("The heuristic's distances agree with plain relaxation") {
  Stream random(1, "e3mop.grid");
  const MotionSet motions = motions_of();
  for (int round = 0; round < 5; ++round) {
    const Window window = strewn_window(random, 40);
    LatticeProblem problem(window, motions, {random.uniform(-2.5, 2.5), random.uniform(-2.5, 2.5)});
    std::vector<std::int64_t> plain(problem.open_cells.size(), GoalDistances::infinite);
    for (const int row : {-1, 0, 1}) {
      for (const int column : {-1, 0, 1}) {
        const auto cell = static_cast<std::size_t>(problem.goal_cell + row * problem.frame.stride() + column);
        if (problem.open_cells[cell]) plain[cell] = 0;
      }
    }
    for (bool changed = true; changed;) {
      changed = false;
      for (std::int32_t cell = 0; cell < problem.frame.cell_count(); ++cell) {
        if (!problem.open_cells[static_cast<std::size_t>(cell)]) continue;
        for (const Direction& along : directions()) {
          const std::int32_t next = cell + along.dy * problem.frame.stride() + along.dx;
          const auto edge = static_cast<std::int64_t>(1000.0 * std::hypot(along.dx, along.dy));
          if (!problem.open_cells[static_cast<std::size_t>(next)]) continue;
          if (plain[static_cast<std::size_t>(next)] + edge >= plain[static_cast<std::size_t>(cell)]) continue;
          plain[static_cast<std::size_t>(cell)] = plain[static_cast<std::size_t>(next)] + edge;
          changed = true;
        }
      }
    }
    // queried in any order
    const std::int32_t count = problem.frame.cell_count();
    for (std::int32_t k = 0; k < count; ++k) {
      const std::int32_t cell = static_cast<std::int32_t>((static_cast<std::int64_t>(k) * 1009) % count);
      const std::int32_t distance = problem.goal.distance(cell);
      REQUIRE(distance == plain[static_cast<std::size_t>(cell)]);
      if (distance == GoalDistances::infinite || distance == 0) continue;
      const Direction& out = direction(problem.goal.exit_direction(cell));
      const std::int32_t next = cell + out.dy * problem.frame.stride() + out.dx;
      REQUIRE(problem.goal.distance(next) + static_cast<std::int32_t>(1000.0 * std::hypot(out.dx, out.dy)) == distance);
    }
  }
}

TEST_CASE("The heuristic never exceeds the cost, motion by motion") {
  Stream random(1, "e3mop.heuristic");
  const MotionSet motions = motions_of();
  for (int round = 0; round < 5; ++round) {
    const Window window = strewn_window(random, 25);
    LatticeProblem problem(window, motions, {random.uniform(-2.5, 2.5), random.uniform(-2.5, 2.5)});
    const auto to_go = [&](std::int32_t node) {
      const std::int32_t distance = problem.goal.distance(node / direction_count);
      return distance == GoalDistances::infinite ? INT32_MAX : cost_to_go(distance, 0.1, e3mop_limits.v_max);
    };
    std::size_t edges = 0;
    std::size_t above = 0;
    for_all_edges(problem, [&](std::int32_t from, const Motion& motion, std::int32_t to) {
      ++edges;
      if (to_go(to) != INT32_MAX && to_go(from) > motion.cost + to_go(to)) ++above;
    });
    CHECK(edges > 10000);
    CHECK(above == 0);
  }
}

TEST_CASE("Without pruning the search finds the minimum cost") {
  Stream random(1, "e3mop.optimal");
  const MotionSet motions = motions_of();
  int solved = 0;
  for (int round = 0; round < 8; ++round) {
    const Window window = strewn_window(random, 45);
    LatticeProblem problem(window, motions, {random.uniform(-2.5, 2.5), random.uniform(-2.5, 2.5)});
    const int heading = static_cast<int>(random.below(direction_count));
    const SearchResult result = problem.search({0.0, 0.0, direction(heading).theta}, false);
    // the search may first turn to a neighbouring heading, at the unweighted time of the turn
    const Ticks least = least_cost(problem, heading);
    REQUIRE(result.found == (least >= 0));
    if (!result.found) continue;
    ++solved;
    CHECK(result.cost <= least);
    const auto turn = static_cast<Ticks>(std::ceil(std::atan2(1.0, 2.0) * ticks_per_s));
    CHECK(result.cost >= least - turn);
  }
  CHECK(solved >= 4);
}

TEST_CASE("A path is free, leads from the start to the goal, and bends no tighter than the motions") {
  Stream random(1, "e3mop.path");
  const MotionSet motions = motions_of();
  const bool pruning = GENERATE(true, false);
  for (int round = 0; round < 20; ++round) {
    const Window window = strewn_window(random, 35);
    const dmrp_vec2 goal = {random.uniform(-2.5, 2.5), random.uniform(-2.5, 2.5)};
    LatticeProblem problem(window, motions, goal);
    const SearchResult result = problem.search(window.robot, pruning);
    if (problem.goal.distance(problem.frame.center_cell()) == GoalDistances::infinite) continue;
    CHECK(result.poses.front().x == 0.0);
    for (std::size_t i = 1; i < result.poses.size(); ++i) {
      const dmrp_pose& pose = result.poses[i];
      REQUIRE(problem.free_space.is_free({{pose.x, pose.y}, {std::cos(pose.theta), std::sin(pose.theta)}}));
      REQUIRE(std::hypot(pose.x - result.poses[i - 1].x, pose.y - result.poses[i - 1].y) <= 0.05 + 1e-9);
    }
    if (!result.found) continue;
    CHECK(std::abs(result.poses.back().x - goal.x) <= 0.15 + 1e-9);
    CHECK(std::abs(result.poses.back().y - goal.y) <= 0.15 + 1e-9);
  }
}

TEST_CASE("A search that finds no path leads toward the goal") {
  // a wall across the whole window
  const Window window({0.0, 0.0, 0.0}, [](dmrp_vec2 point) { return std::abs(point.x - 1.5) < 0.05; });
  const MotionSet motions = motions_of();
  LatticeProblem problem(window, motions, {2.5, 0.0});
  const SearchResult result = problem.search(window.robot, true);
  CHECK_FALSE(result.found);
  CHECK(result.expanded == 0);  // the grid knows

  // a gap wide enough for the heuristic's grid but not for the padded disc
  const Window gap({0.0, 0.0, 0.0},
                   [](dmrp_vec2 point) { return std::abs(point.x - 1.5) < 0.05 && std::abs(point.y - 0.025) > 0.24; });
  LatticeProblem narrow(gap, motions, {2.5, 0.0});
  const SearchResult stuck = narrow.search(gap.robot, true);
  CHECK_FALSE(stuck.found);
  REQUIRE_FALSE(stuck.poses.empty());
  CHECK(stuck.poses.back().x > 0.9);
}

TEST_CASE("On the shipped maps pruning loses no path and at least halves the states expanded") {
  const MotionSet motions = motions_of();
  const std::filesystem::path folder = DMRP_SCENARIOS;
  for (const char* name : {"mall", "library", "office"}) {
    const auto scenario = dmrp::host::read_scenario_file(folder / name / "scenario.toml", name).scenario;
    const dmrp::core::StaticGeometry geometry(scenario);
    const auto columns = static_cast<std::int64_t>((geometry.upper().x - geometry.lower().x) / Window::resolution_m);
    const auto rows = static_cast<std::int64_t>((geometry.upper().y - geometry.lower().y) / Window::resolution_m);
    std::vector<char> occupied;
    for (std::int64_t cell = 0; cell < columns * rows; ++cell)
      occupied.push_back(
          geometry.clearance(geometry.lower() +
                             Window::resolution_m * dmrp_vec2{cell % columns + 0.5, cell / columns + 0.5}) <= 0.0);
    const auto is_occupied = [&](dmrp_vec2 point) {
      const dmrp_vec2 cells = (point - geometry.lower()) / Window::resolution_m;
      const auto column = static_cast<std::int64_t>(std::floor(cells.x));
      const auto row = static_cast<std::int64_t>(std::floor(cells.y));
      return column < 0 || row < 0 || column >= columns || row >= rows ||
             occupied[static_cast<std::size_t>(row * columns + column)];
    };
    Stream random(1, "e3mop.shipped");
    constexpr std::size_t windows = 250;
    std::vector<double> pruned, unpruned;
    double pruned_sum = 0.0, unpruned_sum = 0.0;
    while (pruned.size() < windows) {
      // a robot anywhere, with any heading, and a goal in its window
      const dmrp_pose robot = {random.uniform(geometry.lower().x, geometry.upper().x),
                               random.uniform(geometry.lower().y, geometry.upper().y), random.uniform(-pi, pi)};
      const double goal_distance_m = random.uniform(1.5, 2.7);
      const double goal_bearing = random.uniform(-pi, pi);
      const dmrp_vec2 goal = dmrp::toolkit::position(robot) + goal_distance_m * dmrp::toolkit::from_angle(goal_bearing);
      if (geometry.clearance(dmrp::toolkit::position(robot)) < 0.35 || geometry.clearance(goal) < 0.35) continue;
      const Window window(robot, is_occupied);
      LatticeProblem problem(window, motions, goal);
      const SearchResult with = problem.search(robot, true);
      const SearchResult without = problem.search(robot, false);
      REQUIRE(with.found == without.found);
      if (!with.found) continue;
      pruned.push_back(with.expanded);
      unpruned.push_back(without.expanded);
      pruned_sum += with.expanded;
      unpruned_sum += without.expanded;
    }
    std::sort(pruned.begin(), pruned.end());
    std::sort(unpruned.begin(), unpruned.end());
    CAPTURE(name, pruned_sum, unpruned_sum, pruned[windows / 2], unpruned[windows / 2]);
    CHECK(pruned_sum <= 0.5 * unpruned_sum);
    CHECK(pruned[windows / 2] <= unpruned[windows / 2]);  // many ways are short and straight: little to prune
  }
}

}  // namespace lattice_test
