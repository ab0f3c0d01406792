// SPDX-License-Identifier: MIT
// Tasks drawn for any number of robots.
#include "core/scene/random_tasks.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/grid_view.hpp>
#include <set>

#include "tests/unit/core/sample_scenarios.hpp"

namespace random_tasks_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

PlanningGrid grid_of(const Scenario& scenario) {
  return build_planning_grid(*geometry_of(scenario), 1.0, 0.25, 0.1);
}

dmrp_vec2 place(const dmrp_pose& pose) {
  return {pose.x, pose.y};
}

TEST_CASE("random starts and goals are free, on cell centres, apart, and in one connected part of the world") {
  Scenario scenario = random_scenario(3, 40.0, 60);
  // a closed room that nobody gets out of
  scenario.shapes.push_back(box("room, east", {8, 0}, {8.2, 8}));
  scenario.shapes.push_back(box("room, north", {0, 8}, {8.2, 8.2}));
  const PlanningGrid grid = grid_of(scenario);
  const dmrp_grid c_grid = grid.view();
  const toolkit::GridView view(c_grid);
  std::set<std::pair<double, double>> starts;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<RobotTask> tasks = random_tasks(grid, 20, seed);
    REQUIRE(tasks.size() == 20);
    const auto reachable = reachable_cells(grid, view.index_of(place(tasks[0].start)));
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      REQUIRE(tasks[i].goals.size() == 1);
      for (const dmrp_vec2 point : {place(tasks[i].start), place(tasks[i].goals[0])}) {
        CHECK(point == view.center(view.cell_of(point)));
        CHECK(view.free(view.cell_of(point)));
        CHECK(reachable[view.index_of(point)]);
      }
      CHECK(std::isnan(tasks[i].start.theta));
      CHECK(toolkit::distance(place(tasks[i].start), place(tasks[i].goals[0])) >= min_task_length_m);
      for (std::size_t k = 0; k < i; ++k) {
        CHECK(toolkit::distance(place(tasks[i].start), place(tasks[k].start)) > task_separation_m);
        CHECK(toolkit::distance(place(tasks[i].goals[0]), place(tasks[k].goals[0])) > task_separation_m);
      }
    }
    starts.emplace(tasks[0].start.x, tasks[0].start.y);
  }
  CHECK(starts.size() > 15);
}

TEST_CASE("the tasks of the first robots do not depend on the number") {
  const PlanningGrid grid = grid_of(empty_scenario(30, 30));
  const auto few = random_tasks(grid, 4, 7);
  const auto many = random_tasks(grid, 30, 7);
  REQUIRE(few.size() == 4);
  REQUIRE(many.size() == 30);
  for (std::size_t i = 0; i < few.size(); ++i) {
    CHECK(few[i].name == many[i].name);
    CHECK(place(few[i].start) == place(many[i].start));
    CHECK(place(few[i].goals[0]) == place(many[i].goals[0]));
  }
}

TEST_CASE("without room for all there are fewer tasks, and has_room_for_tasks() is never wrong") {
  const PlanningGrid grid = grid_of(empty_scenario(12, 12));
  CHECK(random_tasks(grid, 1000, 1).size() < 30);  // no two within 2 m on 144 cells
  CHECK(random_tasks(grid, 1000, 1).size() > 8);
  CHECK_FALSE(has_room_for_tasks(grid, 12));
  std::size_t sure = 0;
  while (has_room_for_tasks(grid, sure + 1)) ++sure;
  CHECK(sure >= 4);  // 13 cells a robot, and 81 about its own start
  for (std::uint64_t seed = 0; seed < 200; ++seed) REQUIRE(random_tasks(grid, sure, seed).size() == sure);
  // a world too small for a way of 5 m
  TaskLack lack = TaskLack::nothing;
  CHECK(random_tasks(grid_of(empty_scenario(4, 4)), 1, 1, {}, &lack).empty());
  CHECK(lack == TaskLack::length);
  random_tasks(grid, 1000, 1, {}, &lack);
  CHECK((lack == TaskLack::start || lack == TaskLack::goal));
  random_tasks(grid, 1, 1, {}, &lack);
  CHECK(lack == TaskLack::nothing);
  CHECK(random_tasks(grid_of(empty_scenario(4, 4)), 0, 1).empty());
}

TEST_CASE("drawn types keep their shares at every number of robots") {
  const std::vector<TypeShare> shares = {{"a", 2.0}, {"b", 1.0}, {"", 1.0}};
  const std::vector<std::string> types = drawn_types(shares, 40);
  for (std::size_t count = 1; count <= types.size(); ++count)
    for (const TypeShare& one : shares) {
      const auto given = std::count(types.begin(), types.begin() + static_cast<std::ptrdiff_t>(count), one.type);
      CHECK(std::abs(static_cast<double>(given) - 0.25 * one.share * static_cast<double>(count)) < 1.0);
    }
}

TEST_CASE("robots of several types are drawn on their own grids") {
  Scenario scenario = empty_scenario(30, 20);
  scenario.shapes = {box("pillar", {10.2, 5.2}, {10.8, 5.8})};
  const auto geometry = geometry_of(scenario);
  const PlanningGrid small = build_planning_grid(*geometry, 1.0, 0.25, 0.1);
  const PlanningGrid large = build_planning_grid(*geometry, 1.0, 1.2, 0.1);
  const std::vector<TypeGrid> grids = {{"small", 0.25, &small}, {"large", 1.2, &large}};
  const std::vector<TypeShare> shares = {{"small", 1.0}, {"large", 1.0}};
  const std::vector<std::string> types = drawn_types(shares, 8);
  const std::vector<RobotTask> tasks = random_tasks(grids, types, 3);
  REQUIRE(tasks.size() == 8);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    CHECK(tasks[i].type == types[i]);
    const double radius_m = types[i] == "large" ? 1.2 : 0.25;
    CHECK(geometry->clearance({tasks[i].start.x, tasks[i].start.y}) >= radius_m + 0.1 - 1e-9);
    for (std::size_t k = 0; k < i; ++k)
      if (types[i] == "large" && types[k] == "large")
        CHECK(std::hypot(tasks[i].start.x - tasks[k].start.x, tasks[i].start.y - tasks[k].start.y) > 2.6 - 1e-9);
  }
}

}  // namespace random_tasks_test
