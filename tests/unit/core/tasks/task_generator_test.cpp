// SPDX-License-Identifier: MIT
// The difficulty of tasks, worked out by hand, and tasks drawn as difficult as wished.
#include "core/tasks/task_generator.hpp"

#include <catch2/catch.hpp>
#include <set>
#include <utility>

#include "core/tasks/task_difficulty.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

namespace task_generator_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

PlanningGrid grid_of(const Scenario& scenario) {
  return build_planning_grid(*geometry_of(scenario), 1.0, 0.25, 0.1);
}

PlanningGrids grids_of(const Scenario& scenario) {
  return PlanningGrids(*geometry_of(scenario), RobotTypes(RobotSettings{}), {});
}

// Two halls of 5 x 9 m, joined by a passage of one lane, 3 m long.
Scenario two_halls() {
  Scenario scenario = empty_scenario(13, 9);
  scenario.shapes.push_back(box("south", {5, 0}, {8, 4}));
  scenario.shapes.push_back(box("north", {5, 5}, {8, 9}));
  return scenario;
}

RobotTask task(double x, double y, double to_x, double to_y) {
  return robot({x, y, any_heading}, dmrp_vec2{to_x, to_y});
}

TEST_CASE("robots that meet on a cell at a step conflict; in a corridor there is one lane") {
  const PlanningGrid grid = grid_of(two_halls());
  // head-on through the passage: after four steps both are at x = 6.5
  const TaskDifficulty head_on = difficulty_of(grid, std::vector{task(2.5, 4.5, 10.5, 4.5), task(10.5, 4.5, 2.5, 4.5)});
  CHECK(head_on.conflicts == 1);
  CHECK(head_on.corridor_conflicts == 1);
  CHECK_FALSE(head_on.slack_steps);
  CHECK_FALSE(head_on.well_formed);  // each begins at the other's goal
  // crossing in the hall: both at (2.5, 2.5) after two steps
  const TaskDifficulty crossing = difficulty_of(grid, std::vector{task(0.5, 2.5, 4.5, 2.5), task(2.5, 0.5, 2.5, 4.5)});
  CHECK(crossing.conflicts == 1);
  CHECK(crossing.corridor_conflicts == 0);
  CHECK(crossing.well_formed);
  // exchange of cells: an odd number of cells apart
  CHECK(difficulty_of(grid, std::vector{task(0.5, 1.5, 4.5, 1.5), task(3.5, 1.5, 0.5, 1.5)}).conflicts == 1);
}

TEST_CASE("slack is the delay that makes a conflict") {
  const PlanningGrid grid = grid_of(empty_scenario(9, 9));
  // the second one is on (4.5, 4.5) after 4 steps, the first one after 2
  const TaskDifficulty one = difficulty_of(grid, std::vector{task(2.5, 4.5, 8.5, 4.5), task(4.5, 0.5, 4.5, 8.5)});
  CHECK(one.conflicts == 0);
  REQUIRE(one.slack_steps);
  CHECK(*one.slack_steps == 2);
  CHECK_FALSE(difficulty_of(grid, std::vector{task(0.5, 0.5, 8.5, 0.5), task(0.5, 8.5, 8.5, 8.5)}).slack_steps);
  // a robot that rests at its goal stands in the way of one that comes later
  CHECK(difficulty_of(grid, std::vector{task(3.5, 4.5, 4.5, 4.5), task(4.5, 0.5, 4.5, 8.5)}).conflicts == 1);
}

TEST_CASE("wishes are fulfilled, and the tasks have a solution by construction") {
  const PlanningGrids grids = grids_of(two_halls());
  TaskRequest request;
  request.count = 3;
  request.wishes = {5, 1, 2, Crossing::corridor};
  std::set<std::pair<double, double>> starts;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const DrawnTasks drawn = draw_tasks(grids, request, seed);
    REQUIRE(drawn.as_wished);
    REQUIRE(drawn.tasks.size() == 3);
    const TaskDifficulty difficulty = difficulty_of(grids.standard(), drawn.tasks);
    CHECK(difficulty.corridor_conflicts >= 1);
    CHECK(difficulty.corridor_conflicts <= 2);
    CHECK(difficulty.well_formed);
    CHECK(difficulty.corridor_conflicts == drawn.difficulty.corridor_conflicts);
    starts.emplace(drawn.tasks[0].start.x, drawn.tasks[0].start.y);
    const DrawnTasks again = draw_tasks(grids, request, seed);
    CHECK(again.tasks[2].start.x == drawn.tasks[2].start.x);
    CHECK(again.tasks[2].goals[0].y == drawn.tasks[2].goals[0].y);
  }
  CHECK(starts.size() > 2);
}

TEST_CASE("wishes that a draw fulfils change nothing, and impossible ones are told") {
  const PlanningGrids grids = grids_of(empty_scenario(30, 30));
  TaskRequest request;
  request.count = 4;
  const auto plain = draw_tasks(grids, request, 3).tasks;
  request.wishes = {1, 0, any_number, Crossing::any};
  const auto wished = draw_tasks(grids, request, 3);
  REQUIRE(wished.as_wished);
  CHECK(wished.tasks[3].start.x == plain[3].start.x);
  CHECK(wished.tasks[3].goals[0].x == plain[3].goals[0].x);
  request.wishes.crossing = Crossing::corridor;  // there is none
  request.wishes.conflicts_min = 1;
  CHECK_FALSE(draw_tasks(grids, request, 3).as_wished);
}

TEST_CASE("robots are drawn in what the given points reach, not in larger space around it") {
  // a house of 10 x 10 m in the middle of 30 x 30 m
  Scenario scenario = empty_scenario(30, 30);
  scenario.shapes = {box("south", {10, 10}, {20, 10.2}), box("north", {10, 19.8}, {20, 20}),
                     box("west", {10, 10}, {10.2, 20}), box("east", {19.8, 10}, {20, 20})};
  const PlanningGrids grids = grids_of(scenario);
  const auto is_in_house = [](const dmrp_pose& pose) {
    return pose.x > 10.0 && pose.x < 20.0 && pose.y > 10.0 && pose.y < 20.0;
  };
  TaskRequest request;
  request.count = 3;
  request.inside = {{15.0, 15.0}};
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (const RobotTask& drawn : draw_tasks(grids, request, seed).tasks) {
      CHECK(is_in_house(drawn.start));
      CHECK(is_in_house(drawn.goals[0]));
    }
  request.inside.clear();
  CHECK_FALSE(is_in_house(draw_tasks(grids, request, 1).tasks[0].start));
}

}  // namespace task_generator_test
