// SPDX-License-Identifier: MIT
// An anytime planner, lifelong goals, a grid for each robot, and waypoints with velocities.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "tests/contract_wishes/planning.hpp"
#include "tests/contract_wishes/plugins/waypoint_with_velocity.h"

using namespace dmrp::test;

namespace {

std::size_t unfinished(const Planning& planning) {
  std::size_t count = 0;
  for (const auto& robot : planning.robots) count += robot.known.state == DMRP_ROBOT_ACTIVE;
  return count;
}

dmrp_waypoint last_of(const Planning& planning, std::size_t robot) {
  return planning.paths[robot].waypoints.back();
}

// The waypoints of a path as a plugin of a later minor version made them.
waypoint_with_velocity longer_waypoint(const GivenPath& path, std::size_t i) {
  waypoint_with_velocity waypoint{};
  std::memcpy(&waypoint, path.bytes.data() + i * path.stride, sizeof(waypoint));
  return waypoint;
}

}  // namespace

TEST_CASE("an anytime planner improves the plan in force while the robots drive, and never makes it worse") {
  // Robot 0 parks in the corridor through which robot 1 has to go: if 0 goes first, 1 goes all around.
  Library library(ANYTIME_PLANNER);
  Instance planner(library);
  World world({"..........", ".########.", ".########.", ".########.",  //
               "..........", "####.#####", "####.#####", "####.#####"},
              2);
  world.robot_data[0].goals = {{goal_at(world.center(4, 3))}};
  world.robot_data[1].goals = {{goal_at(world.center(9, 3))}};
  Planning planning(world, {world.center(4, 0), world.center(0, 3)});

  REQUIRE(planner.start(world) == DMRP_OK);
  REQUIRE(planning.plan(planner) == DMRP_OK);
  CHECK(fault_of(planning, world) == "");
  CHECK(planning.cost == 3.0 + 17.0);

  planning.drive(1);
  REQUIRE(planning.plan(planner) == DMRP_OK);
  CHECK(fault_of(planning, world) == "");
  CHECK(planning.cost == 6.0 + 10.0);  // of 2 + 16: 1 turns back, 0 lets it pass

  while (unfinished(planning) > 0) {
    const double rest = planning.cost - static_cast<double>(unfinished(planning));
    planning.drive(1);
    REQUIRE(planning.plan(planner) == DMRP_OK);
    CHECK(fault_of(planning, world) == "");
    CHECK(planning.cost <= rest);
  }
  CHECK(planning.cost == 0.0);

  // a trial does not depend on the one before
  REQUIRE(planner.start(world) == DMRP_OK);
  Planning again(world, {world.center(4, 0), world.center(0, 3)});
  REQUIRE(again.plan(planner) == DMRP_OK);
  CHECK(again.cost == 3.0 + 17.0);
}

TEST_CASE("a planner copes with goals that come between its calls, and with a finished robot that is sent on") {
  Library library(ANYTIME_PLANNER);
  Instance planner(library);
  World world({".....", ".....", "....."}, 2);
  world.robot_data[0].goals = {{goal_at(world.center(2, 0))}};
  world.robot_data[1].goals = {{goal_at(world.center(4, 2))}};
  Planning planning(world, {world.center(0, 0), world.center(0, 2)});
  REQUIRE(planner.start(world) == DMRP_OK);
  REQUIRE(planning.plan(planner) == DMRP_OK);

  // robot 1 gets a goal on the way; robot 0 has arrived
  planning.drive(2);
  REQUIRE(planning.robots[0].known.state == DMRP_ROBOT_FINISHED);
  world.robot_data[1].goals.push_back({goal_at(world.center(0, 1))});
  REQUIRE(planning.plan(planner) == DMRP_OK);
  CHECK(fault_of(planning, world) == "");
  CHECK(planning.paths[0].waypoints.size() == 1);  // it rests
  CHECK(last_of(planning, 1).x == 0.5);
  CHECK(last_of(planning, 1).goal_index == 1);

  planning.drive(1);
  world.robot_data[0].goals.push_back({goal_at(world.center(4, 0))});
  planning.robots[0].known.state = DMRP_ROBOT_ACTIVE;
  REQUIRE(planning.plan(planner) == DMRP_OK);
  CHECK(fault_of(planning, world) == "");
  CHECK(last_of(planning, 0).x == 4.5);
  CHECK(last_of(planning, 0).goal_index == 1);
}

TEST_CASE("a planner plans for each robot on the robot's own grid") {
  Library library(GRID_OF_EACH);
  Instance planner(library);
  World world({".......", "...#...", "...#...", "......."}, 2);
  World of_the_wide_robot({".......", "...#...", "...#...", "...#..."}, 0);  // the door below is too narrow for it
  for (auto& robot : world.robot_data) robot.goals = {{goal_at(world.center(6, 0))}};
  Planning planning(world, {world.center(0, 0), world.center(0, 0)});
  planning.robots[1].known.grid = of_the_wide_robot.grid();
  REQUIRE(planner.start(world) == DMRP_OK);
  REQUIRE(planning.plan(planner) == DMRP_OK);
  CHECK(planning.paths[0].waypoints.size() == 1 + 6);
  CHECK(planning.paths[1].waypoints.size() == 1 + 6 + 2 * 3);
  for (const dmrp_waypoint& waypoint : planning.paths[1].waypoints)
    CHECK(of_the_wide_robot.is_free(of_the_wide_robot.cell(waypoint.x, waypoint.y)));
}

TEST_CASE("waypoints with an appended velocity reach a host of any minor version") {
  Library library(KINODYNAMIC_PLANNER);
  Instance planner(library);
  World world({"..........", ".........."}, 1);
  world.robot_data[0].goals = {{goal_at(world.center(6, 0))}, {goal_at(world.center(6, 1))}};
  Planning planning(world, {world.center(0, 0)});
  REQUIRE(planner.start(world) == DMRP_OK);
  REQUIRE(planning.plan(planner) == DMRP_OK);

  // what a host that does not know the velocity reads
  const GivenPath& path = planning.paths[0];
  REQUIRE(path.stride == sizeof(waypoint_with_velocity));
  CHECK(path.waypoints.front().x == 0.5);
  CHECK(path.waypoints.back().x == Approx(6.5));
  CHECK(path.waypoints.back().y == Approx(1.5));
  CHECK(path.waypoints.back().goal_index == 1);

  // what one that knows it reads: at most the limit, changed at most by a_max, zero at each goal
  double last_v = 0.0;
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.waypoints.size(); ++i) {
    const double v = longer_waypoint(path, i).v;
    const double dt_s = static_cast<double>(path.waypoints[i].t_ns - path.waypoints[i - 1].t_ns) * 1e-9;
    CHECK(v <= world.robot_data[0].limits.v_max);
    CHECK(std::abs(v - last_v) <= world.robot_data[0].limits.a_max * dt_s + 1e-9);
    length_m +=
        std::hypot(path.waypoints[i].x - path.waypoints[i - 1].x, path.waypoints[i].y - path.waypoints[i - 1].y);
    last_v = v;
  }
  CHECK(last_v == 0.0);
  CHECK(length_m == Approx(7.0));
}
