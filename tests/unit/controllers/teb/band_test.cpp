// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "controllers/teb/band_optimizer.hpp"
#include "tests/unit/controllers/robot_body.hpp"

namespace band_test {

using namespace dmrp;
using namespace dmrp::controllers;
using namespace dmrp::controllers::teb;

dmrp_limits test_limits() {
  return dmrp::test::differential_limits(-0.2, 0.8, 1.0, 1.0, 1.0);
}

// A band that violates every constraint a little.
TimedElasticBand ragged_band(toolkit::Stream& random, int poses) {
  TimedElasticBand band;
  band.begin({0.0, 0.0, random.uniform(-0.5, 0.5)});
  for (int i = 1; i < poses; ++i)
    band.append({0.25 * i + random.uniform(-0.1, 0.1), random.uniform(-0.3, 0.3), random.uniform(-1.0, 1.0)},
                random.uniform(0.15, 0.45));
  return band;
}

// Obstacles of every shape, one of them moving.
struct Surroundings {
  std::vector<Vec2> vertices = {{1.0, 0.7}, {1.5, -0.6}, {2.5, -0.5}, {3.0, 0.5},
                                {3.5, 0.5}, {3.3, 0.9},  {2.0, 0.6},  {0.1, 0.5}};
  std::vector<Obstacle> obstacles;
  Surroundings() {
    const auto add = [this](std::size_t first, std::uint32_t count, double radius_m, Vec2 velocity) {
      Obstacle obstacle;
      obstacle.vertices = vertices.data() + first;
      obstacle.vertex_count = count;
      obstacle.radius_m = radius_m;
      obstacle.velocity = velocity;
      obstacle.center = vertices[first];
      obstacle.reach_m = count > 1 ? 1.1 : 0.0;
      obstacles.push_back(obstacle);
    };
    add(0, 1, 0.0, {0.0, 0.0});
    add(1, 2, 0.0, {0.0, 0.0});
    add(3, 3, 0.0, {0.0, 0.0});
    add(6, 1, 0.3, {-0.4, -0.1});
    add(7, 1, 0.0, {0.0, 0.0});  // the start is too near to it
  }
};

// The largest difference between an analytic derivative and a central difference, relative to the derivative's size.
template <class Function, std::size_t size>
double derivative_error(const std::array<double, size>& by, std::array<double, size> at, const Function& value) {
  double worst = 0.0;
  for (std::size_t i = 0; i < size; ++i) {
    const double step = 1e-6;
    const double middle = at[i];
    at[i] = middle + step;
    const double up = value(at);
    at[i] = middle - step;
    const double down = value(at);
    at[i] = middle;
    worst = std::max(worst, std::abs((up - down) / (2.0 * step) - by[i]) / (1.0 + std::abs(by[i])));
  }
  return worst;
}

DirectedPose directed(double x, double y, double theta) {
  return {{x, y}, theta, {std::cos(theta), std::sin(theta)}};
}

std::array<double, 11> random_block(toolkit::Stream& random) {
  std::array<double, 11> block;
  for (std::size_t i = 0; i < block.size(); ++i)
    block[i] = i % 4 == 3 ? random.uniform(0.1, 0.6) : random.uniform(-1.0, 1.0);
  return block;
}

struct HolonomicMotion {
  Motion motion;
  Velocity aside;
};

HolonomicMotion holonomic_at(const double* v) {
  HolonomicMotion at;
  holonomic_motion_between<true>(directed(v[0], v[1], v[2]), directed(v[4], v[5], v[6]), v[3], at.motion, at.aside);
  return at;
}

Motion motion_at(const double* v) {
  Motion motion;
  motion_between<true>(directed(v[0], v[1], v[2]), directed(v[4], v[5], v[6]), v[3], motion);
  return motion;
}

TEST_CASE("TEB: every residual's derivatives agree with finite differences") {
  toolkit::Stream random(1, "teb.residuals");
  for (int round = 0; round < 200; ++round) {
    const std::array<double, 11> all = random_block(random);
    std::array<double, 7> pair;
    std::copy_n(all.begin(), 7, pair.begin());
    const auto a = [](const auto& v) { return directed(v[0], v[1], v[2]); };
    const auto b = [](const auto& v) { return directed(v[4], v[5], v[6]); };
    const double tolerance = 2e-5;

    const Motion motion = motion_at(pair.data());
    CHECK(derivative_error(motion.v_by, pair, [](const auto& v) { return motion_at(v.data()).v; }) < tolerance);
    CHECK(derivative_error(motion.omega_by, pair, [](const auto& v) { return motion_at(v.data()).omega; }) < tolerance);
    CHECK(derivative_error(non_holonomic(a(pair), b(pair)).by, pair,
                           [&](const auto& v) { return non_holonomic(a(v), b(v)).error; }) < tolerance);
    CHECK(derivative_error(forward(a(pair), b(pair)).by, pair,
                           [&](const auto& v) { return forward(a(v), b(v)).error; }) < tolerance);
    CHECK(derivative_error(length(a(pair), b(pair)).by, pair, [&](const auto& v) { return length(a(v), b(v)).error; }) <
          tolerance);

    const HolonomicMotion holonomic = holonomic_at(pair.data());
    CHECK(derivative_error(holonomic.motion.v_by, pair, [](const auto& v) { return holonomic_at(v.data()).motion.v; }) <
          tolerance);
    CHECK(derivative_error(holonomic.aside.by, pair, [](const auto& v) { return holonomic_at(v.data()).aside.value; }) <
          tolerance);
    if (std::abs(pair[6] - pair[2]) > 0.1) {
      CHECK(derivative_error(turning_radius(a(pair), b(pair)).by, pair,
                             [&](const auto& v) { return turning_radius(a(v), b(v)).error; }) < tolerance);
    }

    const auto starting = [](const auto& v) {
      const Motion m = motion_at(v.data());
      return end_acceleration(0.3, m.v, m.v_by, v[3], 1.0);
    };
    const auto stopping = [](const auto& v) {
      const Motion m = motion_at(v.data());
      return end_acceleration(0.0, m.omega, m.omega_by, v[3], -1.0);
    };
    CHECK(derivative_error(starting(pair).by, pair, [&](const auto& v) { return starting(v).error; }) < tolerance);
    CHECK(derivative_error(stopping(pair).by, pair, [&](const auto& v) { return stopping(v).error; }) < tolerance);

    const auto v_change = [](const auto& v) {
      const Motion first = motion_at(v.data());
      const Motion second = motion_at(v.data() + 4);
      return acceleration(first.v, first.v_by, second.v, second.v_by, v[3], v[7]);
    };
    const auto omega_change = [](const auto& v) {
      const Motion first = motion_at(v.data());
      const Motion second = motion_at(v.data() + 4);
      return acceleration(first.omega, first.omega_by, second.omega, second.omega_by, v[3], v[7]);
    };
    CHECK(derivative_error(v_change(all).by, all, [&](const auto& v) { return v_change(v).error; }) < tolerance);
    CHECK(derivative_error(omega_change(all).by, all, [&](const auto& v) { return omega_change(v).error; }) <
          tolerance);
  }
}

TEST_CASE("TEB: penalties begin a margin inside their bounds, and at zero where the bound is zero") {
  CHECK(within(0.74, 0.0, 0.8, 0.05).error == 0.0);
  CHECK(within(0.76, 0.0, 0.8, 0.05).error == Approx(0.01));
  CHECK(within(0.76, 0.0, 0.8, 0.05).slope == 1.0);
  CHECK(within(0.0, 0.0, 0.8, 0.05).error == 0.0);
  CHECK(within(-0.1, 0.0, 0.8, 0.05).error == Approx(0.1));
  CHECK(within(-0.16, -0.2, 0.8, 0.05).error == Approx(0.01));
  CHECK(within(-0.16, -0.2, 0.8, 0.05).slope == -1.0);
  CHECK(above(0.56, 0.5, 0.05).error == 0.0);
  CHECK(above(0.5, 0.5, 0.05).error == Approx(0.05));
}

TEST_CASE("TEB: the gradient of a band's cost agrees with finite differences, and the ends are fixed") {
  toolkit::Stream random(2, "teb.gradient");
  const dmrp_limits limits = test_limits();
  const std::vector<dmrp_vec2> outline = {{0.3, 0.2}, {-0.3, 0.2}, {-0.3, -0.2}, {0.3, -0.2}};
  const std::vector<dmrp_polygon> parts = {dmrp::test::polygon_of(outline)};
  const dmrp_footprint footprints[] = {dmrp::test::disc_footprint(0.25),
                                       dmrp::test::polygon_footprint(parts, 0.37, 0.2)};
  const Surroundings surroundings;
  const std::vector<Vec2> via_points = {{0.6, 0.1}, {1.4, 0.2}};
  for (int round = 0; round < 20; ++round) {
    const dmrp_footprint& footprint = footprints[round % 2];
    Scene scene = {&limits, &footprint, &surroundings.obstacles, &via_points};
    scene.start_velocity = {0.4, 0.0, -0.2};
    scene.stops_at_goal = round % 4 < 2;
    scene.preferred_turn = round % 3 == 0 ? Turn::left : Turn::any;
    Parameters tuning;
    tuning.weight_shortest_path = 0.7;
    tuning.inflation_dist = 0.9;
    TimedElasticBand band = ragged_band(random, 9);
    BandProblem problem;
    problem.begin(band, scene, tuning, 2.0);
    problem.keep();
    BandedMatrix<band_width> hessian;
    std::vector<double> gradient;
    const double cost = problem.linearise(hessian, gradient);
    REQUIRE(gradient.size() == 4 * 9 - 1);
    CHECK(problem.try_step(std::vector<double>(gradient.size(), 0.0)) == Approx(cost));
    double largest = 0.0;
    for (const double g : gradient) largest = std::max(largest, std::abs(g));
    for (std::size_t i = 0; i < gradient.size(); ++i) {
      const bool held = i < 3 || i + 3 >= gradient.size();
      if (held) {
        CHECK(gradient[i] == 0.0);
        CHECK(hessian.at(i, i) == 1.0);
        continue;
      }
      std::vector<double> step(gradient.size(), 0.0);
      step[i] = 1e-6;
      const double up = problem.try_step(step);
      step[i] = -1e-6;
      const double down = problem.try_step(step);
      CAPTURE(round, i);
      CHECK(std::abs((up - down) / 2e-6 - gradient[i]) < 2e-5 * (1.0 + largest));
    }
  }
}

TEST_CASE("TEB: a new band takes the time of its legs and turns at full speed") {
  const dmrp_limits limits = test_limits();
  const Parameters tuning;
  TimedElasticBand band;
  lay_out(band, {0.0, 0.0, 0.0}, {-2.0, 0.0, toolkit::pi}, {{-0.5, 0.0}, {-1.0, 0.0}, {-1.5, 0.0}}, limits, tuning);
  CHECK(band.pose(0).theta == 0.0);
  CHECK(std::abs(band.pose(1).theta) == Approx(toolkit::pi));
  CHECK(band.pose(band.size() - 1).x == -2.0);
  CHECK(band.duration_s() > std::max(toolkit::pi, 2.0 / 0.8));  // limits of 1 rad/s and 0.8 m/s
  CHECK(band.duration_s() < toolkit::pi + 2.0 / 0.8);
}

TEST_CASE("TEB: resizing keeps the intervals near dt_ref, the duration and the ends") {
  toolkit::Stream random(3, "teb.resize");
  Parameters tuning;
  for (int round = 0; round < 100; ++round) {
    TimedElasticBand band;
    band.begin({0.0, 0.0, 0.0});
    const int poses = 2 + static_cast<int>(random.below(20));
    for (int i = 1; i < poses; ++i) band.append({0.2 * i, 0.0, 0.0}, random.uniform(0.02, 1.6));
    const double duration_s = band.duration_s();
    const Pose end = band.pose(band.size() - 1);
    resize(band, tuning);
    CHECK(band.duration_s() == Approx(duration_s));
    CHECK(band.pose(band.size() - 1).x == end.x);
    CHECK(band.dt.size() + 1 == band.size());
    for (const double dt : band.dt) CHECK(dt <= tuning.dt_ref + tuning.dt_hysteresis + 0.1);
  }
  tuning.max_samples = 12;
  TimedElasticBand band;
  band.begin({0.0, 0.0, 0.0});
  band.append({9.0, 0.0, 0.0}, 30.0);
  resize(band, tuning);
  CHECK(band.size() == 12);
}

TEST_CASE("TEB: moving the ends drops the poses that the robot has passed") {
  TimedElasticBand band;
  band.begin({0.0, 0.0, 0.0});
  for (int i = 1; i <= 8; ++i) band.append({0.2 * i, 0.0, 0.0}, 0.3);
  move_ends(band, {0.42, 0.03, 0.1}, {1.8, 0.1, 0.0}, 3);
  CHECK(band.size() == 7);
  CHECK(band.pose(0).y == 0.03);
  CHECK(band.pose(1).x == Approx(0.6));
  CHECK(band.pose(6).x == 1.8);
  CHECK(band.dt.size() == 6);
}

TEST_CASE("TEB: poses are linked to all close obstacles and to the closest one on each side") {
  TimedElasticBand band;
  band.begin({0.0, 0.0, 0.0});
  band.append({1.0, 0.0, 0.0}, 1.0);
  band.append({2.0, 0.0, 0.0}, 1.0);
  const std::vector<Vec2> at = {{1.0, 0.9}, {1.0, 1.1}, {1.0, -1.0}, {1.0, 0.6}, {1.0, 3.5}, {1.3, -5.0}};
  std::vector<Obstacle> obstacles(at.size());
  for (std::size_t i = 0; i < at.size(); ++i) {
    obstacles[i].vertices = &at[i];
    obstacles[i].vertex_count = 1;
    obstacles[i].center = at[i];
  }
  obstacles[5].velocity = {0.0, 5.0};  // with the robot when that is at the pose
  Parameters tuning;                   // forced within 0.75 m, cut off at 2.5 m
  std::vector<ObstacleLink> links;
  ObstacleLinker linker;
  linker.link(band, false, dmrp::test::disc_footprint(0.2), obstacles, tuning, links);
  REQUIRE(links.size() == 5);
  CHECK(links[0].obstacle == 0);  // 0.7 m
  CHECK(links[1].obstacle == 3);  // 0.4 m
  CHECK(links[2].obstacle == 5);
  CHECK(links[2].is_dynamic);
  CHECK(links[2].ahead_s == 1.0);
  CHECK(links[3].obstacle == 1);  // left, 0.9 m
  CHECK(links[4].obstacle == 2);  // right, 0.8 m
  tuning.include_dynamic_obstacles = false;
  linker.link(band, false, dmrp::test::disc_footprint(0.2), obstacles, tuning, links);
  for (const ObstacleLink& link : links) CHECK_FALSE(link.is_dynamic);
}

TEST_CASE("TEB: an optimised band is fast, smooth, clear of obstacles and within the limits") {
  dmrp_limits limits = test_limits();
  limits.v_min = 0.0;
  const dmrp_footprint footprint = dmrp::test::disc_footprint(0.25);
  const std::vector<Vec2> at = {{1.5, 0.05}};
  Obstacle post;
  post.vertices = at.data();
  post.vertex_count = 1;
  post.center = at[0];
  const std::vector<Obstacle> obstacles = {post};
  const std::vector<Vec2> none;
  Scene scene = {&limits, &footprint, &obstacles, &none};
  Parameters tuning;
  tuning.min_obstacle_dist = 0.2;
  tuning.inflation_dist = 0.3;
  tuning.obstacle_association_cutoff_factor = 10.0;
  tuning.weight_kinematics_forward_drive = 1000.0;
  TimedElasticBand band;
  BandOptimizer optimizer;
  lay_out(band, {0.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, {}, limits, tuning);
  for (int cycle = 0; cycle < 5; ++cycle) REQUIRE(optimizer.optimise(band, scene, tuning));
  double nearest_m = 1e9;
  double lowest_m = 0.0;
  for (std::size_t i = 0; i + 1 < band.size(); ++i) {
    const Motion motion = [&] {
      Motion m;
      const Pose a = band.pose(i), b = band.pose(i + 1);
      motion_between<false>(directed(a.x, a.y, a.theta), directed(b.x, b.y, b.theta), band.dt[i], m);
      return m;
    }();
    CHECK(motion.v < 0.85);
    CHECK(motion.v > -0.02);
    CHECK(std::abs(motion.omega) < 1.1);
    nearest_m = std::min(nearest_m, toolkit::distance(band.position(i), at[0]));
    lowest_m = std::min(lowest_m, band.y[i]);
  }
  CHECK(nearest_m > 0.4);   // radius and nearly all of the distance
  CHECK(lowest_m < -0.3);   // past the post on the side where its centre leaves more room
  CHECK(lowest_m > -0.65);  // and no farther than needed
  CHECK(band.duration_s() < 5.5);
  CHECK(band.duration_s() > 3.7);
}

}  // namespace band_test
