// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>

#include "controllers/motion/footprint_check.hpp"
#include "controllers/motion/obstacles.hpp"
#include "controllers/motion/oscillation_detector.hpp"
#include "controllers/motion/path_ahead.hpp"
#include "controllers/motion/path_tracker.hpp"
#include "controllers/motion/stop_and_rotate.hpp"
#include "controllers/motion/unicycle.hpp"
#include "tests/unit/controllers/fake_costmap.hpp"
#include "tests/unit/controllers/robot_body.hpp"

namespace motion_test {

using namespace dmrp::controllers;
using dmrp::test::FakeCostmap;
using dmrp::toolkit::pi;

const double nan_heading = std::numeric_limits<double>::quiet_NaN();

// An observation that a test fills in.
struct Now {
  dmrp_limits limits = dmrp::test::differential_limits(0.0, 0.8, 1.0, 1.0, 1.0);
  dmrp_footprint footprint = dmrp::test::disc_footprint(0.25);
  dmrp_goal goal{};
  dmrp_observation c{};

  Now() {
    c.struct_size = sizeof(c);
    c.dt_ns = 100'000'000;
    goal.pose.theta = nan_heading;
    goal.tolerance_m = 0.2;
    goal.tolerance_rad = 0.2;
    c.goal = &goal;
    c.goal_stride = sizeof(goal);
    c.limits = &limits;
    c.footprint = &footprint;
    c.agent_stride = sizeof(dmrp_agent);
  }
  dmrp::Observation at(double x, double y, double theta = 0.0) {
    c.pose = {x, y, theta};
    return dmrp::Observation(c);
  }
};

struct Point {
  double x, y;
  std::uint32_t goal_index = 0;
};

void send(PathTracker& tracker, const std::vector<Point>& points, std::uint32_t flags = 0) {
  std::vector<dmrp_waypoint> waypoints;
  for (const Point& p : points) waypoints.push_back({p.x, p.y, nan_heading, 0, p.goal_index, 0});
  const dmrp_path path = {sizeof(path), static_cast<std::uint32_t>(waypoints.size()), sizeof(dmrp_waypoint), flags,
                          waypoints.data()};
  tracker.set_path(dmrp::Path(path));
}

TEST_CASE("Steps along an arc end on the circle") {
  const double v = 0.6;
  const double omega = GENERATE(-1.0, -1e-6, 0.0, 0.3, 1.0);
  const double duration_s = 1.7;
  CAPTURE(omega);
  DirectedPoint at = directed({1.0, 2.0, 0.5});
  const ArcStepper stepper(v, omega, duration_s / 20);
  for (int i = 0; i < 20; ++i) stepper.step(at);
  double x = 1.0 + v * duration_s * std::cos(0.5);
  double y = 2.0 + v * duration_s * std::sin(0.5);
  if (std::abs(omega) > 1e-3) {
    const double radius = v / omega;
    x = 1.0 + radius * (std::sin(0.5 + omega * duration_s) - std::sin(0.5));
    y = 2.0 - radius * (std::cos(0.5 + omega * duration_s) - std::cos(0.5));
  }
  CHECK(at.at.x == Approx(x).margin(1e-6));
  CHECK(at.at.y == Approx(y).margin(1e-6));
  CHECK(pose_of(at).theta == Approx(0.5 + omega * duration_s).margin(1e-9));
}

TEST_CASE("The stopping speed, kept for a period and then braked, stops in time") {
  const double distance_m = GENERATE(0.001, 0.02, 0.3, 2.0);
  const double a = GENERATE(0.3, 1.0, 2.5);
  const double speed = stopping_speed(distance_m, a, 0.1);
  CHECK(speed * 0.1 + speed * speed / (2.0 * a) == Approx(distance_m));
  CHECK(speed < std::sqrt(2.0 * a * distance_m));
  CHECK(stopping_speed(0.0, a, 0.1) == 0.0);
  CHECK(stopping_speed(-1.0, a, 0.1) == 0.0);
}

TEST_CASE("The tracker moves forward, skips no excursion, and ends at the stop point") {
  PathTracker tracker;
  Now now;
  SECTION("progress never falls") {
    send(tracker, {{0, 0}, {1, 0}, {2, 0}});
    tracker.update(now.at(0.7, 0.2));
    CHECK(tracker.progress_m() == Approx(0.7));
    tracker.update(now.at(0.5, 0.0));
    CHECK(tracker.progress_m() == Approx(0.7));
    CHECK(tracker.remaining_m() == Approx(1.3));
  }
  SECTION("the way back of an excursion is not taken for the way out") {
    send(tracker, {{0, 0}, {1, 0}, {1, 1}, {1, 0}, {2, 0}});
    tracker.update(now.at(1.0, 0.05));
    CHECK(tracker.progress_m() == Approx(1.05));
    tracker.update(now.at(1.3, 0.05));  // off to the right: still on the excursion
    CHECK(tracker.progress_m() < 1.2);
  }
  SECTION("what the host says it has reached counts") {
    send(tracker, {{0, 0}, {1, 0}, {1, 1}, {1, 0}, {2, 0}});
    now.c.progress_m = 3.0;
    tracker.update(now.at(1.1, 0.0));
    CHECK(tracker.progress_m() == Approx(3.1));
  }
  SECTION("a tour stops at each goal") {
    send(tracker, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
    now.goal.pose = {2.0, 0.0, 0.5};
    now.c.goal_index = 0;
    tracker.update(now.at(0.0, 0.0));
    CHECK(tracker.end_m() == Approx(2.0));
    CHECK(tracker.stop().is_goal);
    CHECK(tracker.stop().heading == 0.5);
    send(tracker, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 1}, {2, 2, 1}});
    now.goal.pose = {2.0, 2.0, nan_heading};
    now.c.goal_index = 1;
    now.c.progress_m = 2.0;
    tracker.update(now.at(2.0, 0.0));
    CHECK(tracker.end_m() == Approx(4.0));
    CHECK(tracker.stop().position.y == 2.0);
  }
  SECTION("the end of a partial path is a stop, but no goal") {
    send(tracker, {{0, 0}, {1, 0}}, DMRP_PATH_PARTIAL);
    now.goal.pose = GENERATE(dmrp_pose{2.0, 0.0, 0.5}, dmrp_pose{1.0, 0.0, 0.5});  // where it will come back to, too
    tracker.update(now.at(0.0, 0.0));
    CHECK(tracker.end_m() == Approx(1.0));
    CHECK_FALSE(tracker.stop().is_goal);
    CHECK(std::isnan(tracker.stop().heading));
    CHECK(tracker.point_at(5.0).x == 1.0);
    CHECK(tracker.point_at_distance({0.0, 0.0}, 5.0).x == 1.0);
  }
  SECTION("a point ahead lies on the circle") {
    send(tracker, {{0, 0}, {1, 0}, {1, 2}});
    now.goal.pose = {1.0, 2.0, nan_heading};
    tracker.update(now.at(0.4, 0.3));
    const dmrp_vec2 carrot = tracker.point_at_distance({0.4, 0.3}, 1.0);
    CHECK(carrot.x == Approx(1.0));
    CHECK(carrot.y == Approx(1.1));
  }
  SECTION("a single waypoint is a straight way from where the robot is") {
    send(tracker, {{3, 4}});
    now.goal.pose = {3.0, 4.0, nan_heading};
    tracker.update(now.at(0.0, 0.0));
    CHECK(tracker.end_m() == Approx(5.0));
    CHECK(tracker.stop().is_goal);
  }
}

TEST_CASE("The latch at the goal") {
  StopAndRotate latch;
  Now now;
  const StopPoint goal = {{1.0, 1.0}, pi / 2, 0.2, 0.2, true};
  CHECK_FALSE(latch.reached(goal, now.at(1.15, 1.0)));
  CHECK(latch.reached(goal, now.at(1.05, 1.0)));
  CHECK(latch.reached(goal, now.at(1.15, 1.0)));        // stays closed
  CHECK_FALSE(latch.reached(goal, now.at(1.25, 1.0)));  // until pushed out of the tolerance
  CHECK_FALSE(latch.reached(goal, now.at(1.15, 1.0)));
  CHECK(latch.settles(goal, now.at(1.15, 1.0)));  // or nothing better can be had
  StopPoint moved = goal;
  moved.position.x = 1.4;
  CHECK_FALSE(latch.reached(moved, now.at(1.15, 1.0)));

  // brakes first, turns when at rest, never faster than it can stop
  CHECK(latch.reached(goal, now.at(1.0, 1.0)));
  now.c.velocity = {0.3, 0.0, 0.5};
  dmrp::Command command = latch.command(goal, now.at(1.0, 1.0, 0.0));
  CHECK(command.v_x == Approx(0.2));
  CHECK(command.omega == Approx(0.4));
  now.c.velocity = {0.0, 0.0, 0.0};
  command = latch.command(goal, now.at(1.0, 1.0, 0.0));
  CHECK(command.omega == Approx(0.1));
  for (double left = 1.5; left > 0.11; left -= 0.01) {
    now.c.velocity.omega = 1.0;
    const double omega = latch.command(goal, now.at(1.0, 1.0, pi / 2 - left)).omega;
    CHECK((omega <= std::sqrt(2.0 * left) || omega == Approx(0.9)));  // 0.9: as slow as alpha allows
  }
}

TEST_CASE("Costs convert to distances") {
  FakeCostmap fake(120);
  fake.mark(3.0, 3.0);  // the cell of [3.00, 3.05), its centre at 3.025
  const dmrp_costmap c = fake.c();
  const CostmapView map(c);
  CHECK(map.cost({3.01, 3.01}) == DMRP_COST_LETHAL);
  CHECK(map.cost({3.22, 3.02}) == DMRP_COST_INSCRIBED);
  CHECK(map.cost({-0.01, 3.0}) == DMRP_COST_FREE);
  CHECK(map.index_of({-0.01, 3.0}) == -1);
  CHECK(map.index_of({5.99, 5.99}) == 120 * 120 - 1);
  CHECK(map.index_of({6.0, 3.0}) == -1);
  for (const double distance : {0.3, 0.35, 0.4, 0.5})
    CHECK(map.distance_of(map.highest_cost_at(distance)) == Approx(distance).margin(0.005));
  CHECK(map.highest_cost_at(0.2) == DMRP_COST_INSCRIBED - 1);
  CHECK(map.highest_cost_at(0.6) == DMRP_COST_FREE);
  CHECK(map.distance_to_lethal({3.025, 3.525}, 1.0) == Approx(0.5));
  CHECK(map.distance_to_lethal({3.025, 3.525}, 0.3) == Approx(0.3));
}

TEST_CASE("Footprints on the costmap") {
  FakeCostmap fake(120);
  fake.mark(3.0, 3.0);
  const dmrp_costmap c = fake.c();
  const CostmapView map(c);
  SECTION("a disc costs what its centre's cell costs, and grows") {
    const dmrp_footprint disc = dmrp::test::disc_footprint(0.25);
    FootprintCheck check(map, disc, 0.0, {1.0, 1.0, 0.0});
    CHECK(check.cost(directed({3.025, 3.225, 0.0})) == in_collision);
    CHECK(check.cost(directed({3.025, 3.325, 0.0})) == map.cost({3.025, 3.325}));
    check.scale(1.3);  // 0.325
    CHECK(check.cost(directed({3.025, 3.325, 0.0})) == in_collision);
    CHECK(check.cost(directed({3.025, 3.375, 0.0})) > 0);
  }
  SECTION("a long robot fits one way only") {
    const std::vector<dmrp_vec2> corners = {{-0.6, -0.3}, {0.6, -0.3}, {0.6, 0.3}, {-0.6, 0.3}};
    const std::vector<dmrp_polygon> parts = {dmrp::test::polygon_of(corners)};
    const dmrp_footprint box = dmrp::test::polygon_footprint(parts, std::hypot(0.6, 0.3), 0.3);
    FootprintCheck check(map, box, 0.0, {1.0, 1.0, 0.0});
    CHECK(check.cost(directed({3.025, 3.425, 0.0})) >= 0);
    CHECK(check.cost(directed({3.025, 3.625, pi / 2})) == in_collision);
  }
  SECTION("a robot of two parts collides with each") {
    // a bar along x, and another one to the left of its front
    const std::vector<dmrp_vec2> bar = {{-0.3, -0.3}, {0.6, -0.3}, {0.6, 0.3}, {-0.3, 0.3}};
    const std::vector<dmrp_vec2> arm = {{0.3, 0.3}, {0.6, 0.3}, {0.6, 0.9}, {0.3, 0.9}};
    const std::vector<dmrp_polygon> parts = {dmrp::test::polygon_of(bar), dmrp::test::polygon_of(arm)};
    const dmrp_footprint both = dmrp::test::polygon_footprint(parts, std::hypot(0.6, 0.9), 0.3);
    FootprintCheck check(map, both, 0.0, {1.0, 1.0, 0.0});
    CHECK(check.cost(directed({2.425, 3.025, 0.0})) == in_collision);  // the obstacle is at the bar's front
    CHECK(check.cost(directed({2.425, 2.325, 0.0})) == in_collision);  // at the arm's front
    CHECK(check.cost(directed({2.425, 3.625, 0.0})) >= 0);             // right of the bar
    CHECK(check.cost(directed({3.025, 2.525, 0.0})) >= 0);             // left of the bar, behind the arm
  }
  SECTION("who stands too near may leave, and come no nearer") {
    const dmrp_footprint disc = dmrp::test::disc_footprint(0.25);
    const FootprintCheck check(map, disc, 0.05, {3.225, 3.025, 0.0});
    CHECK(check.cost(directed({3.225, 3.025, 1.0})) >= 0);
    CHECK(check.arc_cost({3.225, 3.025, 0.0}, 0.2, 0.0, 1.0, 10) >= 0);
    CHECK(check.arc_cost({3.225, 3.025, pi}, 0.2, 0.0, 1.0, 10) == in_collision);
  }
}

// Obstacles of an observation without agents.
struct Clusters {
  std::vector<std::vector<dmrp_vec2>> shapes;
  std::vector<dmrp_obstacle_cluster> rows = {};
  dmrp_obstacle_cluster_list list = {};

  const dmrp_obstacle_cluster_list* c() {
    rows.clear();
    for (const auto& shape : shapes) rows.push_back({static_cast<std::uint32_t>(shape.size()), 0, shape.data()});
    list = {sizeof(list), static_cast<std::uint32_t>(rows.size()), sizeof(dmrp_obstacle_cluster), 0, 0, 0.075,
            rows.data()};
    return &list;
  }
};

const std::vector<dmrp_vec2> point = {{1.0, 2.0}};
const std::vector<dmrp_vec2> segment = {{-1.0, 0.5}, {2.0, 0.5}};
const std::vector<dmrp_vec2> triangle = {{0.0, 0.0}, {2.0, 0.0}, {1.0, 1.5}};
const std::vector<dmrp_vec2> corners = {{0.3, 0.2}, {-0.3, 0.2}, {-0.3, -0.2}, {0.3, -0.2}};
const dmrp_footprint disc = dmrp::test::disc_footprint(0.25);
const std::vector<dmrp_polygon> box_parts = {dmrp::test::polygon_of(corners)};
const dmrp_footprint box = dmrp::test::polygon_footprint(box_parts, std::hypot(0.3, 0.2), 0.2);

TEST_CASE("Distances from a robot to obstacles") {
  Now now;
  Clusters clusters{{point, segment, triangle}};
  dmrp_agent person = {7, DMRP_AGENT_PERSON, 0, {5.0, 0.0, 0.0}, {-1.0, 0.0}, 0.3};
  now.c.agents = &person;
  now.c.agent_count = 1;
  ObstacleSet set;
  set.gather(now.at(0.0, 0.0), clusters.c());
  REQUIRE(set.all().size() == 4);

  CHECK(separation(disc, {1.0, 4.0, 0.0}, set.all()[0], 0.0).distance_m == Approx(1.75));
  CHECK(separation(disc, {0.0, -0.5, 0.0}, set.all()[1], 0.0).distance_m == Approx(0.75));
  CHECK(separation(disc, {4.0, 0.5, 0.0}, set.all()[1], 0.0).distance_m == Approx(1.75));
  CHECK(separation(disc, {1.0, -1.0, 0.0}, set.all()[2], 0.0).distance_m == Approx(0.75));
  CHECK(separation(disc, {1.0, 0.1, 0.0}, set.all()[2], 0.0).distance_m == Approx(-0.35));  // inside
  CHECK(separation(disc, {0.0, 0.0, 0.0}, set.all()[3], 0.0).distance_m == Approx(4.45));
  CHECK(separation(disc, {0.0, 0.0, 0.0}, set.all()[3], 2.0).distance_m == Approx(2.45));  // walked 2 m nearer
  CHECK(separation(box, {1.0, -1.0, 0.0}, set.all()[2], 0.0).distance_m == Approx(0.8));
  CHECK(separation(box, {1.0, -1.0, pi / 2}, set.all()[2], 0.0).distance_m == Approx(0.7));
  CHECK(separation(box, {1.0, -0.1, 0.0}, set.all()[2], 0.0).distance_m == Approx(-0.1));
}

TEST_CASE("The distance of a robot of several parts is that of its nearest part") {
  Now now;
  Clusters clusters{{point, segment, triangle}};
  ObstacleSet set;
  set.gather(now.at(0.0, 0.0), clusters.c());
  const std::vector<dmrp_vec2> left = {{0.0, 0.2}, {-0.3, 0.2}, {-0.3, -0.2}, {0.0, -0.2}};
  const std::vector<dmrp_vec2> right = {{0.3, 0.2}, {0.0, 0.2}, {0.0, -0.2}, {0.3, -0.2}};
  const std::vector<dmrp_polygon> halves = {dmrp::test::polygon_of(left), dmrp::test::polygon_of(right)};
  const dmrp_footprint halved = dmrp::test::polygon_footprint(halves, std::hypot(0.3, 0.2), 0.2);
  dmrp::toolkit::Stream random(2, "poses");
  int apart = 0;
  for (int i = 0; i < 400; ++i) {
    const dmrp_pose at = {random.uniform(-2.0, 3.0), random.uniform(-2.0, 3.0), random.uniform(-pi, pi)};
    for (const Obstacle& obstacle : set.all()) {
      const Separation whole = separation(box, at, obstacle, 0.0);
      const Separation parts = separation(halved, at, obstacle, 0.0);
      // overlaps of the halves are at most as deep as those of the whole
      if (whole.distance_m <= 0.0) {
        CHECK(parts.distance_m <= 1e-12);
        continue;
      }
      ++apart;
      CHECK(parts.distance_m == Approx(whole.distance_m).margin(1e-12));
      CHECK(parts.gradient.x == Approx(whole.gradient.x).margin(1e-9));
      CHECK(parts.gradient.y == Approx(whole.gradient.y).margin(1e-9));
    }
  }
  CHECK(apart > 800);
}

TEST_CASE("The gradient of a distance agrees with finite differences") {
  Now now;
  Clusters clusters{{point, segment, triangle}};
  dmrp_agent person = {7, DMRP_AGENT_PERSON, 0, {0.5, 1.0, 0.0}, {0.4, -0.3}, 0.3};
  now.c.agents = &person;
  now.c.agent_count = 1;
  ObstacleSet set;
  set.gather(now.at(0.0, 0.0), clusters.c());
  const dmrp_footprint& footprint = GENERATE(std::cref(disc), std::cref(box));
  dmrp::toolkit::Stream random(1, "poses");
  constexpr double h = 1e-6;
  int smooth = 0;
  for (int i = 0; i < 400; ++i) {
    const dmrp_pose at = {random.uniform(-2.0, 3.0), random.uniform(-2.0, 3.0), random.uniform(-pi, pi)};
    for (const Obstacle& obstacle : set.all()) {
      const auto distance = [&](double x, double y, double theta) {
        return separation(footprint, {at.x + x, at.y + y, at.theta + theta}, obstacle, 1.3).distance_m;
      };
      const Separation here = separation(footprint, at, obstacle, 1.3);
      CHECK(least_distance(footprint, {at.x, at.y}, obstacle, 1.3) <= here.distance_m + 1e-12);
      const auto slope = [&](double x, double y, double theta) {
        return (distance(h * x, h * y, h * theta) - distance(-h * x, -h * y, -h * theta)) / (2.0 * h);
      };
      // no gradient exists where two points are equally close: one-sided slopes differ
      const auto kink = [&](double x, double y, double theta) {
        return std::abs(distance(h * x, h * y, h * theta) + distance(-h * x, -h * y, -h * theta) -
                        2.0 * here.distance_m) > 1e-9;
      };
      if (kink(1, 0, 0) || kink(0, 1, 0) || kink(0, 0, 1)) continue;
      ++smooth;
      CHECK(here.gradient.x == Approx(slope(1, 0, 0)).margin(1e-5));
      CHECK(here.gradient.y == Approx(slope(0, 1, 0)).margin(1e-5));
      CHECK(here.gradient_theta == Approx(slope(0, 0, 1)).margin(1e-5));
    }
  }
  CHECK(smooth > 1500);
}

TEST_CASE("The path ahead ends at its look-ahead, at the window or at the stop") {
  Now now;
  FakeCostmap costmap(120);  // 6 m
  const dmrp_costmap c = costmap.c();
  const CostmapView map(c);
  PathTracker tracker;
  send(tracker, {{1.0, 3.0}, {2.0, 3.0}, {3.0, 3.0}, {3.0, 4.0}, {3.0, 5.0}, {3.0, 6.0}, {3.0, 9.0}});
  const dmrp::Observation here = now.at(1.5, 2.9);
  tracker.update(here);
  PathAhead ahead;

  ahead.look(tracker, here, map, 1.0);
  CHECK(ahead.points().front().x == Approx(1.5));
  CHECK(ahead.points().front().y == Approx(3.0));
  CHECK(ahead.goal().x == Approx(2.5));
  CHECK(ahead.goal().theta == Approx(0.0).margin(1e-9));
  CHECK_FALSE(ahead.ends_at_stop());
  for (std::size_t i = 1; i < ahead.points().size(); ++i)
    CHECK(dmrp::toolkit::distance(ahead.points()[i - 1], ahead.points()[i]) <= PathAhead::spacing_m + 1e-9);

  ahead.look(tracker, here, map, 1.5);  // in the bend: halfway between the two directions
  CHECK(ahead.goal().x == Approx(3.0));
  CHECK(ahead.goal().theta == Approx(pi / 4));

  ahead.look(tracker, here, map, 10.0);  // the window ends at y = 6
  CHECK(ahead.goal().y == Approx(5.6).margin(PathAhead::spacing_m));
  CHECK(ahead.goal().y <= 5.6);
  CHECK(ahead.goal().theta == Approx(pi / 2));
  CHECK_FALSE(ahead.ends_at_stop());

  SECTION("a stop with a heading") {
    now.goal.pose = {3.0, 4.5, 0.3};
    send(tracker, {{1.0, 3.0}, {2.0, 3.0}, {3.0, 3.0}, {3.0, 4.5}});
    const dmrp::Observation then = now.at(1.5, 2.9);
    tracker.update(then);
    ahead.look(tracker, then, map, 10.0);
    CHECK(ahead.ends_at_stop());
    CHECK(ahead.has_heading());
    CHECK(ahead.goal().y == Approx(4.5));
    CHECK(ahead.goal().theta == Approx(0.3));
  }
}

TEST_CASE("Turning back and forth on the spot is detected; driving and turning around are not") {
  const dmrp_limits limits = dmrp::test::differential_limits(0.0, 0.8, 1.0, 1.0, 1.0);
  OscillationDetector detector;
  detector.reset(20);
  const auto drive = [&](int periods, double v, auto omega_of) {
    for (int i = 0; i < periods; ++i) detector.record({v, 0.0, omega_of(i)}, limits);
  };
  const auto to_and_fro = [](int i) { return i / 3 % 2 == 0 ? 0.5 : -0.5; };
  drive(8, 0.0, to_and_fro);
  CHECK_FALSE(detector.is_oscillating(0.1, 0.1));  // too soon to tell
  drive(16, 0.0, to_and_fro);
  CHECK(detector.is_oscillating(0.1, 0.1));
  drive(20, 0.4, to_and_fro);
  CHECK_FALSE(detector.is_oscillating(0.1, 0.1));  // gets on
  drive(20, 0.0, [](int) { return 0.5; });
  CHECK_FALSE(detector.is_oscillating(0.1, 0.1));  // turns round
  drive(20, 0.0, [](int) { return 0.0; });
  CHECK_FALSE(detector.is_oscillating(0.1, 0.1));  // stands
}

}  // namespace motion_test
