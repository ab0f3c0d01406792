// SPDX-License-Identifier: MIT
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/grid_line.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/segment.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

#include "pedestrians/crowd/groups.hpp"
#include "pedestrians/crowd/line_of_sight.hpp"
#include "pedestrians/crowd/neighbor_grid.hpp"
#include "pedestrians/crowd/right_of_way.hpp"
#include "pedestrians/crowd/walkers.hpp"
#include "pedestrians/crowd/wall_grid.hpp"
#include "pedestrians/crowd/way_finding.hpp"
#include "tests/unit/pedestrians/walking_world.hpp"

namespace crowd_test {

using namespace dmrp::pedestrians;
using dmrp::toolkit::Stream;

TEST_CASE("the neighbour grid finds the same bodies as exhaustive search") {
  const double reach_m = GENERATE(0.7, 5.0, 100.0);
  NeighborGrid grid;
  grid.start({-10.0, 0.0}, {13.0, 17.0}, GENERATE(0.5, 2.0, 30.0));
  for (uint64_t round = 0; round < 5; ++round) {
    // some bodies are outside the world
    Stream chance(1, "bodies", round);
    std::vector<Body> bodies;
    for (std::uint32_t slot = 0; slot < 60 * round; ++slot)
      bodies.push_back({{chance.uniform(-12.0, 15.0), chance.uniform(-2.0, 19.0)}, {0.0, 0.0}, 0.3, slot});
    grid.build(bodies);
    REQUIRE(grid.by_place().size() == bodies.size());

    for (int query = 0; query < 50; ++query) {
      const dmrp_vec2 point = {chance.uniform(-12.0, 15.0), chance.uniform(-2.0, 19.0)};
      std::vector<std::uint32_t> expected;
      for (const Body& body : bodies)
        if (dmrp::toolkit::squared_distance(body.position, point) <= reach_m * reach_m) expected.push_back(body.slot);
      std::vector<std::uint32_t> found;
      for (const auto& [squared_distance, body] : grid.near(point, reach_m)) {
        found.push_back(body->slot);
        REQUIRE(squared_distance == Approx(dmrp::toolkit::squared_distance(body->position, point)));
      }
      std::sort(found.begin(), found.end());
      REQUIRE(found == expected);
    }
  }
}

TEST_CASE("the wall grid finds the same walls as exhaustive search") {
  const double reach_m = 1.5;
  Stream chance(1, "walls");
  std::vector<dmrp_segment> segments;
  for (int i = 0; i < 80; ++i) {
    const dmrp_vec2 from = {chance.uniform(0.0, 20.0), chance.uniform(5.0, 30.0)};
    segments.push_back({from, from + dmrp_vec2{chance.uniform(-6.0, 6.0), chance.uniform(-6.0, 6.0)}});
  }
  segments.push_back({{3.0, 7.0}, {3.0, 7.0}});  // a wall without length
  WallGrid grid;
  grid.start({segments.data(), segments.size()}, {0.0, 5.0}, {20.0, 30.0}, reach_m);

  std::vector<WallPoint> found;
  for (int query = 0; query < 500; ++query) {
    const dmrp_vec2 point = {chance.uniform(0.0, 20.0), chance.uniform(5.0, 30.0)};
    grid.nearest_points(point, found);
    std::size_t next = 0;
    for (const dmrp_segment& segment : segments) {
      const double distance_m = dmrp::toolkit::distance(segment, point);
      if (distance_m > reach_m || distance_m == 0.0) continue;
      REQUIRE(next < found.size());
      CHECK(found[next].distance_m == Approx(distance_m));
      const dmrp_vec2 back = point - found[next].distance_m * found[next].away;
      CHECK(dmrp::toolkit::distance(segment, back) < 1e-9);
      ++next;
    }
    CHECK(next == found.size());
  }
}

// A grid with a free mask alone.
struct MaskGrid {
  std::vector<std::uint8_t> free;
  dmrp::toolkit::GridView view;

  MaskGrid(std::uint32_t width, std::uint32_t height, double blocked_share, std::uint32_t block, Stream& chance)
      : free(std::size_t{width} * height, 1) {
    const auto size = static_cast<double>(free.size());
    for (double left = blocked_share * size; left > 0.0; left -= block * block) {
      const auto column = static_cast<std::uint32_t>(chance.uniform(0.0, width));
      const auto row = static_cast<std::uint32_t>(chance.uniform(0.0, height));
      for (std::uint32_t r = row; r < std::min(row + block, height); ++r)
        for (std::uint32_t c = column; c < std::min(column + block, width); ++c) free[std::size_t{r} * width + c] = 0;
    }
    dmrp_grid grid{};
    grid.width = width;
    grid.height = height;
    grid.resolution_m = 0.25;
    grid.origin = {-3.0, 1.0};
    grid.free = free.data();
    view = dmrp::toolkit::GridView(grid);
  }
};

TEST_CASE("cached lines of sight equal an examination of the whole line") {
  Stream chance(1, "sight");
  const std::uint32_t block = GENERATE(1, 2, 5);
  const double share = GENERATE(0.01, 0.05, 0.2);
  const MaskGrid grid(120, 90, share, block, chance);
  LineOfSight line_of_sight;
  line_of_sight.start(grid.view);

  // half of the places are corners and middles of cells
  const auto anywhere = [&] {
    dmrp_vec2 at = {chance.uniform(-3.5, 27.5), chance.uniform(0.5, 24.0)};
    if (chance.uniform() < 0.5) at = {0.125 * std::round(8.0 * at.x), 0.125 * std::round(8.0 * at.y)};
    return at;
  };
  int seen = 0;
  int kept = 0;
  for (int walker = 0; walker < 150; ++walker) {
    dmrp_vec2 at = anywhere();
    const dmrp_vec2 to = anywhere();
    const double stray_m = chance.uniform(0.0, 0.1);
    SightLine line;
    for (int step = 0; step < 60; ++step) {
      const dmrp_vec2 last = line.witness;
      const bool is_free = line_of_sight.is_free(at, to, line);
      REQUIRE(is_free == dmrp::toolkit::line_is_free(grid.view, at, to));
      seen += is_free;
      kept += step > 0 && line.witness == last;
      if (dmrp::toolkit::distance(at, to) > 0.2) at += 0.2 * dmrp::toolkit::normalized(to - at);
      at += {chance.uniform(-stray_m, stray_m), chance.uniform(-stray_m, stray_m)};
    }
  }
  CHECK(seen > 100);
  CHECK(seen < 8900);
  CHECK(kept > 1000);  // answered without an examination
}

TEST_CASE("walkers are the people in the order of the grid, with their directions, without robots") {
  std::vector<dmrp_person> people;
  Stream chance(1, "walkers");
  for (std::uint64_t id = 0; id < 50; ++id)
    people.push_back(dmrp::test::person(id, {chance.uniform(0.0, 20.0), chance.uniform(0.0, 20.0)}, {1.0, 1.0}));
  const dmrp_agent robots[] = {dmrp::test::robot(1, {5.0, 5.0}), dmrp::test::robot(2, {15.0, 5.0})};
  dmrp_crowd crowd{};
  crowd.person_count = 50;
  crowd.people = people.data();
  crowd.person_stride = sizeof(dmrp_person);
  crowd.robot_count = 2;
  crowd.robots = robots;
  crowd.robot_stride = sizeof(dmrp_agent);

  const double awareness = GENERATE(0.0, 0.5);
  Walkers walkers;
  walkers.grid.start({0.0, 0.0}, {20.0, 20.0}, 1.0);
  walkers.reactions.start(1, {}, true, awareness, {});
  walkers.gather(dmrp::Crowd(crowd), [](std::uint32_t slot, const dmrp_person& person) {
    return dmrp_vec2{static_cast<double>(slot), person.position.x};
  });
  CHECK(walkers.grid.by_place().size() == 52);
  REQUIRE(walkers.by_place().size() == 50);
  auto walker = walkers.by_place().begin();
  for (const Body& body : walkers.grid.by_place()) {
    if (body.slot == no_slot) continue;
    REQUIRE(walker->slot == body.slot);
    CHECK(walker->person.id == body.slot);
    CHECK(walker->robot_weight == awareness);
    CHECK(walker->way == dmrp_vec2{static_cast<double>(body.slot), body.position.x});
    ++walker;
  }
}

TEST_CASE("directions lead straight to visible targets and around obstacles to hidden ones") {
  const dmrp::test::WalkingWorld world({24.0, 10.0}, {{{10.0, 0.0}, {12.0, 7.0}}});
  WayFinder ways;
  ways.start(world.walking_grid());

  dmrp_person p = dmrp::test::person(1, {2.0, 2.0}, {5.0, 6.0});
  CHECK(ways.direction(0, p).x == Approx(0.6));
  CHECK(ways.direction(0, p).y == Approx(0.8));
  p.position = p.target;
  CHECK(ways.direction(0, p) == dmrp_vec2{0.0, 0.0});

  // following the directions leads past the box
  p = dmrp::test::person(2, {2.0, 2.0}, {22.0, 2.0});
  double walked_m = 0.0;
  while (dmrp::toolkit::distance(p.position, p.target) > 0.3 && walked_m < 40.0) {
    p.position += 0.05 * ways.direction(0, p);
    walked_m += 0.05;
    REQUIRE(world.clearance(p.position) >= 0.25);
  }
  // 23.0 m around the corners at 0.3 m, minus the last 0.3 m; the preferred way keeps a larger distance
  CHECK(walked_m > 22.5);
  CHECK(walked_m < 24.5);
}

TEST_CASE("people without a way to their target walk straight toward it") {
  const dmrp::test::WalkingWorld world({24.0, 10.0}, {{{10.0, 0.0}, {12.0, 10.0}}});
  WayFinder ways;
  ways.start(world.walking_grid());
  const dmrp_vec2 along = ways.direction(0, dmrp::test::person(1, {2.0, 5.0}, {22.0, 2.0}));
  CHECK(along.x == Approx(20.0 / std::sqrt(409.0)));
  CHECK(along.y == Approx(-3.0 / std::sqrt(409.0)));
}

TEST_CASE("a person pushed out of the free cells finds the way back") {
  const dmrp::test::WalkingWorld world({24.0, 10.0}, {{{10.0, 0.0}, {12.0, 7.0}}});
  WayFinder ways;
  ways.start(world.walking_grid());
  CHECK(ways.direction(0, dmrp::test::person(1, {9.95, 3.0}, {22.0, 2.0})).x < 0.0);
}

TEST_CASE("the members of a group are the people with its number, in any slots") {
  std::vector<dmrp_person> people(6);
  const std::uint32_t numbers[] = {7, 0, 3, 7, 0, 7};
  for (std::size_t slot = 0; slot < 6; ++slot) people[slot].group = numbers[slot];
  Groups groups;
  groups.start();
  const auto members = [&](std::uint32_t slot) {
    groups.update({people.data(), people.size()});
    const auto found = groups.members(slot);
    return std::vector<std::uint32_t>(found.begin(), found.end());
  };
  CHECK(members(3) == std::vector<std::uint32_t>{0, 3, 5});
  CHECK(members(2) == std::vector<std::uint32_t>{2});
  CHECK(members(1).empty());
  people[3].group = 3;
  CHECK(members(3) == std::vector<std::uint32_t>{2, 3});
  CHECK(members(0) == std::vector<std::uint32_t>{0, 5});
}

TEST_CASE("a blocked person ignores people ahead who have farther to go") {
  RightOfWay right_of_way;
  right_of_way.start();
  // 0 leaves after a while; 1 and 2 face each other, 2 has farther to go; 3 always walks west, 4 turns back half-way
  std::vector<dmrp_person> people;
  for (const double x : {0.0, 5.0, 4.4, 20.0, 30.0})
    people.push_back(dmrp::test::person(people.size() + 10, {x, 2.0}, {x, 2.0}));
  people[1].target = {0.0, 2.0};
  people[2].target = {40.0, 2.0};
  const auto pass = [&](double duration_s, dmrp_vec2 way_of_last) {
    for (int step = 0; step < 50 * duration_s; ++step) {
      right_of_way.begin_step();
      for (dmrp_person& each : people) {
        const dmrp_vec2 way = each.id == 14 ? way_of_last : dmrp_vec2{each.id == 12 ? 1.0 : -1.0, 0.0};
        each.velocity = each.id >= 13 ? each.desired_speed * way : dmrp_vec2{0.0, 0.0};
        right_of_way.update(each, way, 0.02);
      }
    }
  };
  const auto ignores = [&](std::uint32_t slot, std::uint32_t over) {
    const Body body = {people[over].position, {0.0, 0.0}, 0.3, over};
    return right_of_way.ignores(slot, body, {people.data(), people.size()});
  };

  pass(5.0, {1.0, 0.0});
  CHECK_FALSE(ignores(1, 2));  // blocked for too short a time
  people.erase(people.begin());
  for (int tenth = 0; tenth < 150; ++tenth) {
    pass(0.1, tenth < 75 ? dmrp_vec2{1.0, 0.0} : dmrp_vec2{-1.0, 0.0});
    CHECK_FALSE(ignores(2, 0));  // both make progress, in different directions
    CHECK_FALSE(ignores(3, 0));
  }
  CHECK(ignores(0, 1));
  CHECK_FALSE(ignores(1, 0));  // has farther to go
  CHECK_FALSE(ignores(0, 2));  // a person behind
  const Body robot = {{4.4, 2.0}, {0.0, 0.0}, 0.25, no_slot};
  CHECK_FALSE(right_of_way.ignores(0, robot, {people.data(), people.size()}));

  const auto walk_at = [&](double share) {
    for (int step = 0; step < 1000; ++step) {
      right_of_way.begin_step();
      for (dmrp_person& each : people) {
        each.velocity = {-share * each.desired_speed, 0.0};
        right_of_way.update(each, {-1.0, 0.0}, 0.02);
      }
    }
    return ignores(0, 1);
  };
  CHECK(walk_at(0.05));  // shuffles on
  CHECK_FALSE(walk_at(0.2));
  CHECK_FALSE(walk_at(0.05));
}

}  // namespace crowd_test
