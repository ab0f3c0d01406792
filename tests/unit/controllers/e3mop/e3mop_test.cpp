// SPDX-License-Identifier: MIT
// E3MoP's path optimisation, spline, velocity profile and tracking controller.
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>

#include "controllers/e3mop/local_plan.hpp"
#include "controllers/e3mop/path_follower.hpp"
#include "controllers/e3mop/path_smoother.hpp"
#include "controllers/e3mop/velocity_profile.hpp"
#include "controllers/e3mop/way_out.hpp"
#include "tests/unit/controllers/e3mop/e3mop_paths.hpp"
#include "tests/unit/controllers/e3mop/e3mop_window.hpp"
#include "tests/unit/controllers/fake_costmap.hpp"

namespace e3mop_test {

using namespace dmrp::controllers;
using namespace dmrp::controllers::e3mop;
using dmrp::test::discs_window;
using dmrp::test::e3mop_limits;
using dmrp::test::Points;
using dmrp::test::straight;
using dmrp::test::wavering;
using dmrp::test::Window;
using dmrp::toolkit::pi;
using dmrp::toolkit::Stream;

std::vector<PathPoint> spline_of(const Points& points, std::optional<double> start_theta = {}, double step_m = 0.05) {
  std::vector<PathPoint> path;
  SplinePath().fit(points, start_theta, step_m, path);
  return path;
}

TEST_CASE("The field is interpolated between the cells' centres, with the exact gradient of the interpolation") {
  const Window window = discs_window({{0.5, 0.4}, {-1.0, 0.3}}, 0.2);
  for (std::uint32_t i = 0; i < Window::cells * Window::cells; i += 97) {
    const dmrp_vec2 center = window.field.lower() + 0.05 * dmrp_vec2{i % Window::cells + 0.5, i / Window::cells + 0.5};
    REQUIRE(window.field.at(center).distance_m == Approx(window.distances[i]).margin(1e-6));
    REQUIRE(window.field.of_cell(center) == window.distances[i]);
  }
  Stream random(1, "e3mop.slope");
  for (int k = 0; k < 500; ++k) {
    const dmrp_vec2 at = {random.uniform(-2.5, 2.5), random.uniform(-2.5, 2.5)};
    // within one patch of the interpolation
    const double h = 1e-7;
    const Clearance here = window.field.at(at);
    const double dx = (window.field.at({at.x + h, at.y}).distance_m - here.distance_m) / h;
    const double dy = (window.field.at({at.x, at.y + h}).distance_m - here.distance_m) / h;
    REQUIRE(here.gradient.x == Approx(dx).margin(1e-5));
    REQUIRE(here.gradient.y == Approx(dy).margin(1e-5));
  }
  CHECK(window.field.at({100.0, 0.0}).distance_m == window.field.at({window.field.upper().x, 0.0}).distance_m);
}

TEST_CASE("A moving disc occupies the area that it sweeps") {
  Window window = discs_window({{2.0, -2.0}}, 0.1);
  window.field.add_swept_disc({-1.0, 0.0}, {0.0, 0.0}, 0.3);
  CHECK(window.field.at({-0.5, 0.8}).distance_m == Approx(0.5).margin(0.01));
  CHECK(window.field.at({0.7, 0.0}).distance_m == Approx(0.4).margin(0.01));
  CHECK(window.field.at({-0.5, 0.1}).distance_m == 0.0);
  CHECK(window.field.at({2.0, -1.5}).distance_m == Approx(0.4).margin(0.05));  // and what stood there
  // half outside of the window
  window.field.add_swept_disc({2.5, 2.5}, {5.0, 5.0}, 0.3);
  CHECK(window.field.at({2.5, 1.7}).distance_m == Approx(0.5).margin(0.02));
}

TEST_CASE("A robot that stands too close to an obstacle may leave but come no closer") {
  const Window window = discs_window({{0.0, 0.55}}, 0.3);
  const FreeSpace from_afar(window.field, dmrp::Footprint(dmrp::test::e3mop_disc), 0.05, {-2.0, 0.0, 0.0});
  CHECK_FALSE(from_afar.can_stand({0.0, 0.0}));
  const FreeSpace from_there(window.field, dmrp::Footprint(dmrp::test::e3mop_disc), 0.05, {0.0, 0.0, 0.0});
  CHECK(from_there.can_stand({0.0, 0.0}));
  CHECK(from_there.can_stand({0.1, 0.0}));
  CHECK(from_there.can_stand({0.0, -0.1}));
  CHECK_FALSE(from_there.can_stand({0.0, 0.04}));
  CHECK_FALSE(from_there.can_stand({0.75, 0.55}) != from_afar.can_stand({0.75, 0.55}));
}

TEST_CASE("Whether a point is free depends on its own distance, not on that of its cell's centre") {
  const Window wall({0.0, 0.0, 0.0}, [](dmrp_vec2 point) { return point.y > 0.6; });
  const FreeSpace space(wall.field, dmrp::Footprint(dmrp::test::e3mop_disc), 0.05, {-2.0, -1.0, 0.0});
  for (double y = 0.0; y < 0.5; y += 0.003) {
    const dmrp_vec2 at = {0.51, y};
    CHECK(space.can_stand(at) == (wall.field.at(at).distance_m >= space.needed_m()));
  }
}

TEST_CASE("A long robot can stand where it fits at one heading alone") {
  // between two walls 0.8 m apart, which the robot is too long to face
  const std::vector<dmrp_vec2> corners = {{-0.45, -0.15}, {0.45, -0.15}, {0.45, 0.15}, {-0.45, 0.15}};
  const std::vector<dmrp_polygon> parts = {dmrp::test::polygon_of(corners)};
  const dmrp_footprint c_footprint = dmrp::test::polygon_footprint(parts, 0.475, 0.15);
  const dmrp::Footprint footprint(c_footprint);
  dmrp::test::FakeCostmap fake(80);
  for (double y = 0.025; y < 4.0; y += 0.05) fake.mark(1.575, y), fake.mark(2.425, y);
  const dmrp_costmap map = fake.c();
  const dmrp_pose robot = {2.0, 2.0, 0.5 * pi};
  const Window walls(robot, [](dmrp_vec2 point) { return std::abs(point.x - 2.0) > 0.4; });
  const FootprintCheck outline(CostmapView(map), footprint, 0.0, robot);
  const FreeSpace space(walls.field, footprint, 0.0, robot, &outline);
  const dmrp_vec2 at = {2.0, 2.3};
  CHECK_FALSE(space.is_free(directed(at, 0.0)));
  CHECK(space.is_free(directed(at, 0.5 * pi)));
  CHECK(space.can_stand(at));
  CHECK_FALSE(space.can_stand({2.35, 2.3}));
}

TEST_CASE("A path that ends too close to an obstacle leads to its last point where the robot can stand") {
  const Window wall({0.0, 0.0, 0.0}, [](dmrp_vec2 point) { return point.y > 0.6; });
  const FreeSpace space(wall.field, dmrp::Footprint(dmrp::test::e3mop_disc), 0.05, {0.0, 0.0, 0.0});
  LocalPlan plan;
  plan.prepare(dmrp::Limits(e3mop_limits), 0.1, wall.field);
  const std::vector<dmrp_vec2> path = {{0.0, 0.0}, {0.2, 0.0}, {0.4, 0.2}, {0.51, 0.37}};
  REQUIRE_FALSE(space.can_stand(path[3]));
  const auto goal = plan.choose_goal({0.0, 0.0}, wall.field, space, 0.25, path);
  REQUIRE(goal);
  CHECK(goal->at == path[2]);
  CHECK_FALSE((goal->is_path_end || goal->is_cut));
}

TEST_CASE("The objective's gradient agrees with finite differences") {
  Stream random(1, "e3mop.gradient");
  const Window window = discs_window({{0.0, 0.9}, {0.6, -0.8}, {-0.9, -0.7}}, 0.25);
  SmoothingSettings settings;
  settings.weight_smoothness = GENERATE(1.0, 40.0);
  const std::size_t fixed = GENERATE(1u, 3u);
  const Points points = wavering(random, window.field);
  SmoothingProblem problem;
  problem.set(points, fixed, window.field, settings);
  BandedMatrix<smoothing_bandwidth> hessian;
  std::vector<double> gradient;
  CHECK(problem.linearise(hessian, gradient) == Approx(problem.cost()));
  REQUIRE(gradient.size() == 2 * (points.size() - 1 - fixed));
  REQUIRE(hessian.size() == gradient.size());
  std::vector<double> step(gradient.size(), 0.0);
  for (std::size_t i = 0; i < step.size(); ++i) {
    const double h = 1e-7;
    step[i] = h;
    const double ahead = problem.try_step(step);
    step[i] = -h;
    const double behind = problem.try_step(step);
    step[i] = 0.0;
    problem.restore();
    REQUIRE(gradient[i] == Approx((ahead - behind) / (2.0 * h)).margin(1e-5));
  }
}

TEST_CASE("The normal matrix is J'J of all residuals") {
  // beside a straight wall the distance is linear, so that J'J is the whole second derivative
  const Window window({0.0, 0.0, 0.0}, [](dmrp_vec2 point) { return point.y > 0.6; });
  const Points points = straight({-1.0, 0.3}, {1.0, 0.2}, 21);
  SmoothingProblem problem;
  problem.set(points, 2, window.field, SmoothingSettings{});
  BandedMatrix<smoothing_bandwidth> hessian, ignored;
  std::vector<double> here, there;
  problem.linearise(hessian, here);
  std::vector<double> step(here.size(), 0.0);
  for (std::size_t j = 0; j < step.size(); ++j) {
    step[j] = 1e-4;
    problem.try_step(step);
    problem.linearise(ignored, there);
    step[j] = 0.0;
    for (std::size_t i = 0; i < step.size(); ++i) {
      const bool in_band = (i > j ? i - j : j - i) <= smoothing_bandwidth;
      REQUIRE((there[i] - here[i]) / 1e-4 == Approx(in_band ? hessian.symmetric(i, j) : 0.0).margin(1e-4));
    }
  }
}

TEST_CASE("A point that smoothing would move into collision keeps its position") {
  // around a post, with a smoothness weight far above the obstacle weight
  const Window window = discs_window({{0.0, 0.0}}, 0.3);
  Points before;
  for (int i = 0; i <= 20; ++i) {
    const double angle = pi - pi * i / 20.0;
    before.push_back(0.7 * dmrp::toolkit::from_angle(angle));
  }
  SmoothingSettings settings;
  settings.weight_smoothness = 1e5;
  settings.needed_m = 0.3;
  Points after = before;
  PathSmoother smoother;
  const SmoothingResult result = smoother.smooth(after, 1, window.field, settings);
  CHECK(result.cost < result.first_cost);
  CHECK(result.put_back > 0);
  int kept = 0;
  for (std::size_t i = 1; i + 1 < after.size(); ++i) {
    CHECK(window.field.at(after[i]).distance_m >= 0.3);
    kept += after[i] == before[i];
  }
  CHECK(kept == result.put_back);
}

TEST_CASE("A path beside a wall moves away from it, a free path becomes straight") {
  PathSmoother smoother;
  SmoothingSettings settings;
  settings.needed_m = 0.3;
  const Window wall({0.0, 0.0, 0.0}, [](dmrp_vec2 point) { return point.y < -0.4; });
  Points path = straight({-1.5, 0.0}, {1.5, 0.0}, 31);
  smoother.smooth(path, 1, wall.field, settings);
  for (std::size_t i = 3; i + 3 < path.size(); ++i) CHECK(wall.field.at(path[i]).distance_m > 0.49);

  const Window open({0.0, 0.0, 0.0}, [](dmrp_vec2) { return false; });
  Points bent = straight({-1.5, 0.0}, {1.5, 0.0}, 31);
  for (std::size_t i = 1; i + 1 < bent.size(); ++i) bent[i].y = 0.2 * std::sin(0.3 * static_cast<double>(i));
  smoother.smooth(bent, 1, open.field, settings);
  for (const dmrp_vec2 point : bent) CHECK(std::abs(point.y) < 1e-3);
}

TEST_CASE("The spline interpolates its points, starts in the given direction, and has a circle's curvature") {
  Points circle;
  for (int i = 0; i <= 20; ++i) circle.push_back(1.5 * dmrp::toolkit::from_angle(0.06 * i));
  const std::vector<PathPoint> path = spline_of(circle, pi / 2);
  CHECK(path.front().theta == Approx(pi / 2).margin(1e-6));
  for (const PathPoint& point : path) {
    CHECK(dmrp::toolkit::norm(point.at) == Approx(1.5).margin(1e-3));
    if (point.arc_m > 0.2 && point.arc_m < 1.5) CHECK(point.curvature == Approx(1.0 / 1.5).margin(0.02));
  }
  CHECK(path.back().arc_m == Approx(1.8).margin(2e-3));
  CHECK((path.back().at.x == Approx(circle.back().x) && path.back().at.y == Approx(circle.back().y)));
  const std::vector<PathPoint> line = spline_of({{0.0, 0.0}, {1.0, 1.0}});
  CHECK(line.size() == 29);
  CHECK(line[5].theta == Approx(pi / 4));
  CHECK(line[5].curvature == Approx(0.0).margin(1e-9));
}

TEST_CASE("On a straight line the profile is bang-bang") {
  const double length_m = GENERATE(0.2, 0.5, 3.0);
  const double start_speed = GENERATE(0.0, 0.5);
  std::vector<PathPoint> path = spline_of(straight({0.0, 0.0}, {length_m, 0.0}, 31), {}, 0.01);
  plan_speeds(path, start_speed, 0.0, e3mop_limits);
  const double a = e3mop_limits.a_max;
  const double top = std::min(e3mop_limits.v_max, std::sqrt(a * length_m + 0.5 * start_speed * start_speed));
  for (const PathPoint& point : path) {
    const double faster = std::sqrt(start_speed * start_speed + 2.0 * a * point.arc_m);
    const double braking = std::sqrt(std::max(0.0, 2.0 * a * (length_m - point.arc_m)));
    CHECK(point.speed == Approx(std::min({faster, braking, e3mop_limits.v_max})).margin(1e-6));
  }
  const double ends_m = (top * top - start_speed * start_speed + top * top) / (2.0 * a);
  const double time_s = (top - start_speed) / a + top / a + (length_m - ends_m) / top;
  CHECK(path.back().time_s == Approx(time_s).epsilon(0.01));
  if (length_m == 3.0) CHECK(speed_after(path, 0.1) == Approx(start_speed + 0.1).margin(0.01));
}

TEST_CASE("On a circle the profile turns at the limit") {
  Points circle;
  for (int i = 0; i <= 60; ++i) circle.push_back(0.5 * dmrp::toolkit::from_angle(0.1 * i));
  std::vector<PathPoint> path = spline_of(circle, pi / 2);
  plan_speeds(path, 0.0, 0.0, e3mop_limits);
  for (const PathPoint& point : path)
    if (point.arc_m > 0.7 && point.arc_m < 2.3) CHECK(point.speed == Approx(0.5).margin(0.02));
}

TEST_CASE("Profiles respect all limits") {
  Stream random(1, "e3mop.profile");
  for (int round = 0; round < 50; ++round) {
    // a smooth random path
    Points points = {{0.0, 0.0}};
    double theta = 0.0;
    double bend = 0.0;
    for (int i = 0; i < 30; ++i) {
      bend = std::clamp(bend + random.uniform(-0.4, 0.4), -1.5, 1.5);
      theta += 0.1 * bend;
      points.push_back(points.back() + 0.1 * dmrp::toolkit::from_angle(theta));
    }
    std::vector<PathPoint> path = spline_of(points, 0.0);
    plan_speeds(path, 0.0, 0.0, e3mop_limits);
    CHECK(path.front().speed == 0.0);
    CHECK(path.back().speed == 0.0);
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const PathPoint& p = path[i];
      const PathPoint& q = path[i + 1];
      const double ds = q.arc_m - p.arc_m;
      const double dt = q.time_s - p.time_s;
      REQUIRE(std::isfinite(q.time_s));
      REQUIRE(p.speed <= e3mop_limits.v_max + 1e-9);
      REQUIRE(p.speed * std::abs(p.curvature) <= e3mop_limits.omega_max + 1e-9);
      REQUIRE(std::abs(q.speed * q.speed - p.speed * p.speed) / (2.0 * ds) <= e3mop_limits.a_max + 1e-9);
      // the turning rate is interpolated linearly within a step
      REQUIRE(std::abs(q.curvature * q.speed - p.curvature * p.speed) / dt <= 1.3 * e3mop_limits.alpha_max);
    }
  }
}

TEST_CASE("A profile starts at the robot's speed and gives the time of the stop") {
  std::vector<PathPoint> path = spline_of(straight({0.0, 0.0}, {0.1, 0.0}, 3));
  plan_speeds(path, 0.8, 0.0, e3mop_limits);
  CHECK(path.front().speed == 0.8);  // too fast to stop in 0.1 m: the tracker brakes as hard as it may
  CHECK(speed_after(path, 10.0) == 0.0);
}

const dmrp_goal any_goal{};

dmrp_observation observation() {
  dmrp_observation c{};
  c.struct_size = sizeof(c);
  c.goal = &any_goal;
  c.dt_ns = 100'000'000;
  c.limits = &e3mop_limits;
  c.footprint = &dmrp::test::e3mop_disc;
  c.agent_stride = sizeof(dmrp_agent);
  return c;
}

void move(dmrp_observation& c, const dmrp::Command& command) {
  c.velocity = {command.v_x, 0.0, command.omega};
  DirectedPoint at = directed(c.pose);
  ArcStepper(command.v_x, command.omega, 0.1).step(at);
  c.pose = pose_of(at);
}

TEST_CASE("A robot that has stood at a wall for a second drives clear of it, as nearly toward its path as it can") {
  const Window wall({0.0, 0.0, 0.0}, [](dmrp_vec2 point) { return point.y > 0.3; });
  dmrp_observation c = observation();
  c.pose = {0.0, 0.02, 0.5};
  WayOut way_out;
  int waits = 0;
  bool is_taken = false;
  while (!is_taken && waits < 100) {
    const dmrp::Observation now(c);
    is_taken = way_out.take(now, {}, 0.5, FreeSpace(wall.field, now.footprint, 0.05, c.pose));
    ++waits;
  }
  CHECK((waits == 10 || waits == 11));
  for (int k = 0; k < 100 && way_out.is_taken(); ++k) {
    const dmrp::Observation now(c);
    move(c, way_out.drive(now, FreeSpace(wall.field, now.footprint, 0.05, c.pose)));
    REQUIRE(wall.field.at({c.pose.x, c.pose.y}).distance_m > 0.295);  // radius and padding, but for the tolerance
  }
  CHECK_FALSE(way_out.is_taken());
  CHECK(c.pose.x > 0.15);
  CHECK(c.pose.theta < 0.1);
}

TEST_CASE("The tracking controller returns to its path") {
  dmrp_observation c = observation();
  const double aside_m = GENERATE(-0.1, 0.0, 0.1);
  const double aside_rad = GENERATE(-0.5, 0.0, 0.5);
  c.pose = {0.0, aside_m, aside_rad};
  c.velocity = {0.4, 0.0, 0.0};
  for (int k = 0; k < 60; ++k) {
    std::vector<PathPoint> path = spline_of(straight({c.pose.x, 0.0}, {c.pose.x + 3.0, 0.0}, 31));
    plan_speeds(path, c.velocity.v_x, 0.0, e3mop_limits);
    const dmrp::Command command = follow(path, dmrp::Observation(c));
    REQUIRE(std::abs(command.v_x - c.velocity.v_x) <= 0.1 + 1e-9);
    REQUIRE(std::abs(command.omega - c.velocity.omega) <= 0.1 + 1e-9);
    REQUIRE((command.v_x >= 0.0 && command.v_x <= 0.8 && std::abs(command.omega) <= 1.0));
    move(c, command);
    REQUIRE(std::abs(c.pose.y) < 0.35);
  }
  CHECK(std::abs(c.pose.y) < 0.02);
  CHECK(std::abs(c.pose.theta) < 0.02);
  CHECK(c.velocity.v_x > 0.75);
}

}  // namespace e3mop_test
