// SPDX-License-Identifier: MIT
// The parts of the MPC: the problem's derivatives, the Riccati recursion against a dense solution, the interior point
// method on problems with known solutions, the association of obstacles and the initial guesses.
#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/random.hpp>

#include "controllers/motion/guide.hpp"
#include "controllers/mpc/association.hpp"
#include "controllers/mpc/feasibility.hpp"
#include "controllers/mpc/initial_guess.hpp"
#include "controllers/mpc/interior_point.hpp"
#include "tests/unit/controllers/fake_costmap.hpp"
#include "tests/unit/controllers/robot_body.hpp"

namespace mpc_test {

using namespace dmrp::controllers;
using namespace dmrp::controllers::mpc;
using dmrp::test::FakeCostmap;
using dmrp::toolkit::pi;
using dmrp::toolkit::Stream;

const dmrp_footprint disc = dmrp::test::disc_footprint(0.25);
const std::vector<dmrp_vec2> box_corners = {{-0.3, -0.2}, {0.4, -0.2}, {0.4, 0.2}, {-0.3, 0.2}};
const std::vector<dmrp_polygon> box_parts = {dmrp::test::polygon_of(box_corners)};
const dmrp_footprint box = dmrp::test::polygon_footprint(box_parts, 0.5, 0.2);

// Obstacles of all kinds, some of them moving.
struct KindsOfObstacles {
  std::vector<dmrp_vec2> vertices = {{1.0, 0.6}, {2.0, -0.7}, {2.8, -0.5}, {1.5, 1.0},
                                     {2.5, 1.0}, {2.0, 1.6},  {3.0, 0.2}};
  std::vector<Obstacle> all;

  KindsOfObstacles() {
    const auto add = [this](std::uint32_t first, std::uint32_t count, double radius_m, dmrp_vec2 velocity) {
      Obstacle obstacle;
      obstacle.vertices = vertices.data() + first;
      obstacle.vertex_count = count;
      obstacle.radius_m = radius_m;
      obstacle.velocity = velocity;
      obstacle.center = vertices[first];
      obstacle.reach_m = 2.0;
      all.push_back(obstacle);
    };
    add(0, 1, 0.0, {0.0, 0.0});
    add(1, 2, 0.0, {0.0, 0.0});
    add(3, 3, 0.0, {0.0, 0.0});
    add(6, 1, 0.3, {-0.8, 0.3});
  }
  KindsOfObstacles(const KindsOfObstacles&) = delete;
};

StageVector random_stage(Stream& random) {
  StageVector w;
  w[at_x] = random.uniform(-0.5, 3.0);
  w[at_y] = random.uniform(-0.3, 0.3);
  w[at_theta] = random.uniform(-4.0, 4.0);
  w[at_v_before] = random.uniform(-0.2, 0.8);
  w[at_omega_before] = random.uniform(-1.0, 1.0);
  w[at_dt] = random.uniform(0.05, 0.5);
  w[at_v] = random.uniform(-0.2, 0.8);
  w[at_omega] = random.uniform(-1.0, 1.0);
  return w;
}

StageVector nudged(StageVector w, std::size_t entry, double by) {
  w[entry] += by;
  return w;
}

Problem in_the_open(State start, State goal) {
  Problem problem;
  problem.footprint = &disc;
  problem.start = start;
  problem.goal = goal;
  problem.v_max = 0.8;
  return problem;
}

// The same robot, steered like a car.
Problem of_car(Problem problem) {
  problem.wheelbase_m = 0.5;
  problem.omega_max = 0.6;
  problem.turning_max = 0.9;
  return problem;
}

// The same robot with wheels that roll sideways too.
Problem of_holonomic(Problem problem) {
  problem.keeps_heading = true;
  problem.fixes_heading = false;
  problem.omega_max = 0.4;
  return problem;
}

Problem of_drive(int drive, const Problem& problem) {
  return drive == 0 ? problem : drive == 1 ? of_car(problem) : of_holonomic(problem);
}

struct Solved {
  Trajectory trajectory;
  SolverReport report;
};

Solved solve(Problem& problem, const std::vector<Obstacle>& obstacles = {}, std::size_t states = 20) {
  std::vector<dmrp_vec2> line;
  for (int i = 0; i <= 10; ++i)
    line.push_back({problem.start.x + 0.1 * i * (problem.goal.x - problem.start.x),
                    problem.start.y + 0.1 * i * (problem.goal.y - problem.start.y)});
  Solved solved;
  InitialGuess().along(problem, line, states, solved.trajectory);
  Association association;
  InteriorPoint solver;
  SolverSettings settings;
  settings.barrier_end = 1e-6;
  settings.tolerance = 1e-5;
  for (int i = 0; i < 5; ++i) {
    if (!association.associate(solved.trajectory, obstacles, {}, problem) && i > 0) break;
    solved.report = solver.solve(problem, settings, solved.trajectory);
  }
  return solved;
}

TEST_CASE("Gradients and curvatures of all constraints agree with finite differences") {
  const dmrp_footprint& footprint = GENERATE(0, 1) == 0 ? disc : box;
  const KindsOfObstacles around;
  Problem problem = of_drive(GENERATE(0, 1, 2), in_the_open({}, {}));
  problem.footprint = &footprint;
  problem.ends_at_rest = true;
  problem.obstacles.resize(4);
  for (std::size_t k = 1; k < 4; ++k)
    for (const Obstacle& obstacle : around.all) problem.obstacles[k].push_back(&obstacle);
  Stream random(1, "gradients");
  const double h = 1e-6;
  int curved = 0;
  for (int round = 0; round < 200; ++round) {
    const std::size_t k = random.below(4);
    const StageVector w = random_stage(random);
    const std::size_t count = problem.constraint_count(4, k);
    std::vector<Constraint> here(count), before(count), after(count);
    problem.constraints(4, k, w, here.data());
    for (std::size_t entry = 0; entry < stage_size; ++entry) {
      problem.constraints(4, k, nudged(w, entry, -h), before.data());
      problem.constraints(4, k, nudged(w, entry, h), after.data());
      for (std::size_t i = 0; i < count; ++i) {
        CAPTURE(round, k, entry, i);
        // no gradient exists where the closest feature changes: checks only where both one-sided slopes agree
        if (std::abs(before[i].gradient[entry] - after[i].gradient[entry]) > 1e-3) continue;
        CHECK(here[i].gradient[entry] == Approx((after[i].value - before[i].value) / (2.0 * h)).margin(1e-5));
      }
    }
    // for discs: the curvature gives the change of the gradient along the tangent
    if (&footprint != &disc) continue;
    for (std::size_t i = 0; i < count; ++i) {
      if (here[i].curvature == 0.0 || -here[i].value < 0.0) continue;
      const StageVector to = nudged(nudged(w, at_x, h * here[i].tangent[0]), at_y, h * here[i].tangent[1]);
      problem.constraints(4, k, to, after.data());
      if (after[i].curvature == 0.0) continue;
      ++curved;
      const double turn = (after[i].gradient[at_x] - here[i].gradient[at_x]) * here[i].tangent[0] +
                          (after[i].gradient[at_y] - here[i].gradient[at_y]) * here[i].tangent[1];
      CHECK(turn / h == Approx(-here[i].curvature).epsilon(1e-3));
      const double by_time = (after[i].gradient[at_dt] - here[i].gradient[at_dt]) / h;
      CHECK(by_time == Approx(-here[i].curvature * here[i].tangent[2]).epsilon(1e-3).margin(1e-6));
    }
  }
  if (&footprint == &disc) CHECK(curved > 50);
}

TEST_CASE("First and second derivatives of transitions agree with finite differences") {
  const Problem problem = of_drive(GENERATE(0, 1, 2), in_the_open({}, {}));
  Stream random(2, "transitions");
  const double h = 1e-5;
  for (int round = 0; round < 100; ++round) {
    const StageVector w = random_stage(random);
    const State next = {random.uniform(), random.uniform(), w[at_theta]};
    const double multipliers[3] = {random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)};
    const Transition t = problem.transition(w, next);
    const auto slopes = [&](const StageVector& at) {  // of multipliers' * transition
      const Transition x = problem.transition(at, next);
      StageVector s = {};
      s[at_x] = multipliers[0];
      s[at_y] = multipliers[1];
      s[at_theta] = multipliers[0] * x.x_by_theta + multipliers[1] * x.y_by_theta + multipliers[2];
      s[at_dt] = multipliers[0] * x.x_by_dt + multipliers[1] * x.y_by_dt + multipliers[2] * x.theta_by_dt;
      s[at_v] = multipliers[0] * x.x_by_v + multipliers[1] * x.y_by_v + multipliers[2] * x.theta_by_v;
      s[at_omega] = multipliers[0] * x.x_by_omega + multipliers[1] * x.y_by_omega + multipliers[2] * x.theta_by_omega;
      return s;
    };
    StageMatrix hessian = {};
    problem.add_transition_curvature(w, multipliers, hessian);
    const StageVector gradient = slopes(w);
    for (std::size_t i = 0; i < stage_size; ++i) {
      const auto before = problem.transition(nudged(w, i, -h), next).defect;
      const auto after = problem.transition(nudged(w, i, h), next).defect;
      double slope = 0.0;
      for (std::size_t d = 0; d < 3; ++d) slope += multipliers[d] * (after[d] - before[d]) / (2.0 * h);
      CHECK(gradient[i] == Approx(slope).margin(1e-6));
      const StageVector turned = slopes(nudged(w, i, h));
      for (std::size_t j = i; j < stage_size; ++j)
        CHECK(hessian[i][j] == Approx((turned[j] - gradient[j]) / h).margin(1e-4));
    }
    const double aside = problem.keeps_heading ? w[at_omega] * std::sin(w[at_theta]) : 0.0;
    CHECK(t.defect[0] == Approx(w[at_x] + w[at_dt] * (w[at_v] * std::cos(w[at_theta]) - aside) - next.x));
  }
}

TEST_CASE("Transitions wrap angles") {
  const Problem problem = in_the_open({}, {});
  StageVector w = {};
  w[at_theta] = 3.1;
  w[at_dt] = 0.5;
  w[at_omega] = 0.2;
  CHECK(problem.transition(w, {0.0, 0.0, -2.0 * pi + 3.1}).defect[2] == Approx(0.1));
  CHECK(in_the_open({}, {0.0, 0.0, -3.1}).terminal_error({0.0, 0.0, 3.1})[2] == Approx(6.2 - 2.0 * pi));
}

TEST_CASE("The Riccati recursion agrees with a dense factorisation") {
  Stream random(3, "riccati");
  constexpr std::size_t stages = 6;
  constexpr int z_size = static_cast<int>(state_size);
  for (int round = 0; round < 20; ++round) {
    const Problem problem = in_the_open({}, {});
    RiccatiRecursion riccati;
    riccati.stages().resize(stages);
    for (QuadraticStage& stage : riccati.stages()) {
      Eigen::Matrix<double, 8, 8> root;
      for (int i = 0; i < 64; ++i) root(i / 8, i % 8) = random.uniform(-1.0, 1.0);
      const Eigen::Matrix<double, 8, 8> hessian = root * root.transpose();
      for (std::size_t i = 0; i < stage_size; ++i) {
        stage.gradient[i] = random.uniform(-1.0, 1.0);
        for (std::size_t j = 0; j < stage_size; ++j)
          stage.hessian[i][j] = hessian(static_cast<int>(i), static_cast<int>(j));
      }
      stage.transition = problem.transition(random_stage(random), {random.uniform(), random.uniform(), 0.0});
    }
    REQUIRE(riccati.factor(0.0));
    riccati.solve();

    // over the controls and dt alone: they determine the states
    constexpr int unknowns = 2 * (static_cast<int>(stages) - 1) + 1;
    Eigen::MatrixXd z = Eigen::MatrixXd::Zero(z_size, unknowns + 1);  // the state as a function of the unknowns, and 1
    z(static_cast<int>(at_dt), unknowns - 1) = 1.0;
    Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(unknowns + 1, unknowns + 1);
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(unknowns + 1);
    for (std::size_t k = 0; k < stages; ++k) {
      const QuadraticStage& stage = riccati.stages()[k];
      Eigen::MatrixXd w = Eigen::MatrixXd::Zero(static_cast<int>(stage_size), unknowns + 1);
      w.topRows(z_size) = z;
      const bool is_last = k + 1 == stages;
      if (!is_last)
        for (int c = 0; c < 2; ++c) w(z_size + c, 2 * static_cast<int>(k) + c) = 1.0;
      for (std::size_t i = 0; i < stage_size; ++i) {
        gradient += stage.gradient[i] * w.row(static_cast<int>(i)).transpose();
        for (std::size_t j = 0; j < stage_size; ++j)
          hessian += stage.hessian[i][j] * w.row(static_cast<int>(i)).transpose() * w.row(static_cast<int>(j));
      }
      if (is_last) break;
      const Transition& t = stage.transition;
      Eigen::Matrix<double, 6, 8> step = Eigen::Matrix<double, 6, 8>::Zero();
      step(0, 0) = step(1, 1) = step(2, 2) = step(3, 6) = step(4, 7) = step(5, 5) = 1.0;
      step(0, 2) = t.x_by_theta, step(0, 5) = t.x_by_dt, step(0, 6) = t.x_by_v;
      step(1, 2) = t.y_by_theta, step(1, 5) = t.y_by_dt, step(1, 6) = t.y_by_v;
      step(2, 5) = t.theta_by_dt, step(2, 7) = t.theta_by_omega;
      z = step * w;
      for (int d = 0; d < 3; ++d) z(d, unknowns) += t.defect[static_cast<std::size_t>(d)];
    }
    const Eigen::VectorXd solution = hessian.topLeftCorner(unknowns, unknowns)
                                         .ldlt()
                                         .solve(-(gradient.head(unknowns) + hessian.col(unknowns).head(unknowns)));
    CHECK(riccati.steps()[0][at_dt] == Approx(solution(unknowns - 1)).epsilon(1e-6).margin(1e-9));
    for (std::size_t k = 0; k + 1 < stages; ++k) {
      CHECK(riccati.steps()[k][at_v] == Approx(solution(2 * static_cast<int>(k))).epsilon(1e-6).margin(1e-9));
      CHECK(riccati.steps()[k][at_omega] == Approx(solution(2 * static_cast<int>(k) + 1)).epsilon(1e-6).margin(1e-9));
    }
  }
}

TEST_CASE("An indefinite reduced Hessian is detected, and a shift makes it positive definite") {
  RiccatiRecursion riccati;
  riccati.stages().resize(3);
  for (QuadraticStage& stage : riccati.stages()) {
    stage = {};
    for (std::size_t i = 0; i < stage_size; ++i) stage.hessian[i][i] = i == at_v ? -1.0 : 1.0;
  }
  CHECK_FALSE(riccati.factor(0.0));
  CHECK(riccati.factor(2.0));
}

TEST_CASE("Driving straight at full speed takes the length over the speed") {
  Problem problem = in_the_open({0.0, 0.0, 0.0}, {2.0, 0.0, 0.0});
  problem.before = {0.8, 0.0};
  const Solved solved = solve(problem);
  CHECK(solved.report.converged);
  CHECK(solved.trajectory.duration_s() == Approx(2.5).epsilon(1e-3));
  CHECK(problem.violation(solved.trajectory) < 1e-4);
}

TEST_CASE("From rest to rest the speeds are a trapezoid within the acceleration limits") {
  Problem problem = in_the_open({0.0, 0.0, 0.0}, {2.0, 0.0, 0.0});
  problem.ends_at_rest = true;
  problem.fixes_heading = false;
  const Solved solved = solve(problem, {}, 40);
  CHECK(solved.report.converged);
  CHECK(problem.violation(solved.trajectory) < 1e-4);
  // the continuous solution takes 2 / 0.8 + 0.8 / 1; controls held from the start of each step save less than a step
  CHECK(solved.trajectory.duration_s() == Approx(3.3).margin(0.15));
  CHECK(solved.trajectory.controls.front().v <= solved.trajectory.dt_s + 1e-6);
  CHECK(solved.trajectory.controls.back().v <= solved.trajectory.dt_s + 1e-6);
}

TEST_CASE("A holonomic robot drives straight to its side at its speed there, and keeps its heading") {
  Problem problem = of_holonomic(in_the_open({0.0, 0.0, 0.5}, {-2.0 * std::sin(0.5), 2.0 * std::cos(0.5), 0.5}));
  const Solved solved = solve(problem);
  CHECK(solved.report.converged);
  CHECK(solved.report.terminal_error_m < 1e-3);
  for (const State& state : solved.trajectory.states) {
    CHECK(state.theta == 0.5);
    CHECK(std::abs(std::cos(0.5) * state.x + std::sin(0.5) * state.y) < 1e-3);
  }
  // 2 m at 0.4 m/s, but for the first step, whose speed is what 1 m/s^2 allows
  const double dt_s = solved.trajectory.dt_s;
  CHECK(solved.trajectory.duration_s() == Approx(2.0 / 0.4 + dt_s * (1.0 - dt_s / 0.4)).epsilon(1e-3));
}

TEST_CASE("A car drives a half turn along its tightest arc, no faster than it may turn") {
  Problem problem = of_car(in_the_open({0.0, 0.0, 0.0}, {0.0, 2.0, 3.141592653589793}));
  const Solved solved = solve(problem, {}, 30);
  CHECK(solved.report.converged);
  CHECK(solved.report.terminal_error_m < 0.02);
  for (const Control& control : solved.trajectory.controls) {
    CHECK(std::abs(control.omega) < problem.omega_max + 1e-6);
    CHECK(std::abs(control.v * std::tan(control.omega) / problem.wheelbase_m) < problem.turning_max + 1e-6);
  }
}

TEST_CASE("The trajectory passes through a gap between two points, and around a single point") {
  Problem problem = in_the_open({0.0, 0.0, 0.0}, {2.0, 0.0, 0.0});
  problem.before = {0.8, 0.0};
  std::vector<dmrp_vec2> points = {{1.0, 0.4}, {1.0, -0.36}};
  if (GENERATE(0, 1) == 1) points = {{1.0, 0.03}};
  std::vector<Obstacle> obstacles;
  for (const dmrp_vec2& point : points) {
    obstacles.emplace_back();
    obstacles.back().vertices = &point;
    obstacles.back().vertex_count = 1;
    obstacles.back().center = point;
  }
  const Solved solved = solve(problem, obstacles);
  CHECK(solved.report.converged);
  CHECK(solved.report.excess_m < 1e-3);
  CHECK(solved.report.terminal_error_m < 1e-3);
  CHECK(problem.violation(solved.trajectory) < 1e-4);
  for (const State& state : solved.trajectory.states)
    for (const dmrp_vec2& point : points) CHECK(std::hypot(state.x - point.x, state.y - point.y) > 0.35 - 1e-3);
}

TEST_CASE("Infeasible problems have a solution") {
  Problem problem = in_the_open({0.0, 0.0, 0.0}, {2.0, 0.0, 0.0});
  std::vector<dmrp_vec2> vertices;
  std::vector<Obstacle> obstacles(1);
  SECTION("a start too near to a wall leads away from it") {
    vertices = {{-1.0, 0.27}, {3.0, 0.27}};
    problem.goal.y = -0.5;
  }
  SECTION("a goal within an obstacle") {
    vertices = {{2.0, -0.1}, {2.1, 0.1}};
  }
  SECTION("a wall between here and there") {
    vertices = {{1.0, -5.0}, {1.0, 5.0}};
  }
  SECTION("a stop nearer than the robot can brake") {
    vertices = {{0.0, 9.0}, {1.0, 9.0}};
    problem.before = {0.8, 0.5};
    problem.goal = {0.05, 0.0, 0.0};
    problem.ends_at_rest = true;
  }
  obstacles[0].vertices = vertices.data();
  obstacles[0].vertex_count = 2;
  obstacles[0].center = vertices[0];
  obstacles[0].reach_m = 10.0;
  const Solved solved = solve(problem, obstacles);
  CHECK(problem.violation(solved.trajectory) < 1e-2);
  CHECK(std::isfinite(solved.report.cost_s));
  for (const Control& control : solved.trajectory.controls) {
    CHECK(control.v > -1e-6);
    CHECK(control.v < 0.8 + 1e-6);
    CHECK(std::abs(control.omega) < 1.0 + 1e-6);
  }
}

TEST_CASE("All close obstacles are associated, and of the others the closest one on each side") {
  const std::vector<dmrp_vec2> points = {{1.0, 0.6}, {1.0, -0.5}, {1.0, 1.5}, {1.0, 2.2}, {1.0, -1.2}, {1.0, 9.0}};
  std::vector<Obstacle> obstacles;
  for (const dmrp_vec2& point : points) {
    obstacles.emplace_back();
    obstacles.back().vertices = &point;
    obstacles.back().vertex_count = 1;
    obstacles.back().center = point;
  }
  Problem problem = in_the_open({0.0, 0.0, 0.0}, {2.0, 0.0, 0.0});
  Trajectory trajectory;
  trajectory.dt_s = 0.3;
  trajectory.states = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 0.0, pi}};
  trajectory.controls.resize(2);
  Association association;
  CHECK(association.associate(trajectory, obstacles, {}, problem));
  using List = std::vector<const Obstacle*>;
  CHECK(problem.obstacles[0].empty());
  CHECK(problem.obstacles[1] == List{&obstacles[0], &obstacles[1], &obstacles[2], &obstacles[4]});
  CHECK(problem.obstacles[2] == List{&obstacles[0], &obstacles[1], &obstacles[4], &obstacles[2]});  // turned about
  CHECK_FALSE(association.associate(trajectory, obstacles, {}, problem));
}

TEST_CASE("A new guess leads along the points, a shifted trajectory to the new goal") {
  Problem problem = in_the_open({0.0, 0.0, 0.0}, {2.0, 2.0, 0.5 * pi});
  const std::vector<dmrp_vec2> corner = {{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {2.0, 2.0}};
  InitialGuess guess;
  Trajectory trajectory;
  guess.along(problem, corner, 21, trajectory);
  REQUIRE(trajectory.size() == 21);
  CHECK(trajectory.duration_s() == Approx(5.0).margin(0.7));
  CHECK(trajectory.states.front().x == 0.0);
  CHECK(trajectory.states.back().y == 2.0);
  CHECK(trajectory.states.back().theta == Approx(0.5 * pi));
  for (const State& state : trajectory.states) CHECK(std::min(std::abs(state.y), std::abs(state.x - 2.0)) < 1e-6);

  const double duration_s = trajectory.duration_s();
  problem.start = {0.08, 0.0, 2.0 * pi};  // a turn more than before, as a wrapped pose can have it
  problem.goal.y = 2.08;
  guess.shifted(problem, 0.1, trajectory);
  CHECK(trajectory.duration_s() == Approx(duration_s).margin(0.05));
  CHECK(trajectory.states.front().x == 0.08);
  CHECK(trajectory.states.back().y == 2.08);
  for (std::size_t k = 0; k + 1 < trajectory.size(); ++k)
    CHECK(std::abs(trajectory.states[k + 1].theta - trajectory.states[k].theta) < 1.0);
}

TEST_CASE("The guide leads around obstacles and reports unreachable points") {
  FakeCostmap fake(120);
  for (int row = 0; row < 90; ++row) fake.mark(3.01, 0.05 * row + 0.01);
  dmrp_costmap c = fake.c();
  const CostmapView map(c);
  const dmrp_vec2 from = map.center(30, 40);
  const dmrp_vec2 to = map.center(90, 40);
  Guide guide;
  guide.spread(map, from, 0.27, 0.4);
  REQUIRE(guide.reaches(map, to));
  std::vector<dmrp_vec2> way;
  guide.path_to(map, to, way);
  double highest_m = 0.0;
  for (const dmrp_vec2 point : way) {
    highest_m = std::max(highest_m, point.y);
    CHECK(map.distance_of(map.cost(point)) >= 0.25);
  }
  CHECK(highest_m > map.center(60, 90).y);
  for (int row = 90; row < 120; ++row) fake.mark(3.01, 0.05 * row + 0.01);
  c = fake.c();
  guide.spread(map, from, 0.27, 0.4);
  CHECK_FALSE(guide.reaches(map, to));
}

TEST_CASE("The guide connects exactly the points that its search reaches") {
  dmrp::toolkit::Stream random(16, "connects");
  int connected = 0;
  for (int round = 0; round < 10; ++round) {
    FakeCostmap fake(60);
    for (int i = 0; i < 12; ++i) fake.mark(random.uniform(0.0, 3.0), random.uniform(0.0, 3.0));
    dmrp_costmap c = fake.c();
    const CostmapView map(c);
    const dmrp_vec2 from = {random.uniform(0.0, 3.0), random.uniform(0.0, 3.0)};
    Guide guide;
    guide.spread(map, from, 0.3, 0.4);
    for (int k = 0; k < 40; ++k) {
      const dmrp_vec2 to = {random.uniform(-0.1, 3.1), random.uniform(-0.1, 3.1)};
      const bool connects = guide.connects(map, from, to, 0.3);
      CHECK(connects == guide.reaches(map, to));
      if (!connects) continue;
      ++connected;
      guide.connects(map, to, from, 0.6);  // what the search found stays
      std::vector<dmrp_vec2> way;
      guide.path_to(map, to, way);
      CHECK(dmrp::toolkit::distance(way.front(), from) < 0.4);
    }
  }
  CHECK(connected > 50);
  CHECK(connected < 350);
}

// Agents, a wall along x = 1 and a corner at (0.6, 0.28); the robot stands at the origin.
struct Room {
  std::vector<dmrp_vec2> vertices = {{1.0, -2.0}, {1.0, 2.0}, {0.6, 0.28}};
  std::vector<Obstacle> obstacles;
  dmrp_limits limits = dmrp::test::differential_limits(0.0, 0.8, 1.0, 1.0, 1.0);
  dmrp_goal goal{};
  FakeCostmap costmap = FakeCostmap(10);

  Room() {
    for (const auto& [first, count] : {std::pair{0u, 2u}, std::pair{2u, 1u}}) {
      Obstacle& obstacle = obstacles.emplace_back();
      obstacle.vertices = vertices.data() + first;
      obstacle.vertex_count = count;
      obstacle.center = count == 2 ? dmrp_vec2{1.0, 0.0} : vertices[first];
      obstacle.reach_m = count == 2 ? 2.0 : 0.0;
      obstacle.is_agent = true;
    }
  }
  Room(const Room&) = delete;

  dmrp_observation at(const dmrp_pose& pose) const {
    dmrp_observation c{};
    c.struct_size = sizeof(c);
    c.pose = pose;
    c.dt_ns = 100'000'000;
    c.limits = &limits;
    c.footprint = &disc;
    c.goal = &goal;
    c.agent_stride = sizeof(dmrp_agent);
    return c;
  }

  bool allows(const std::vector<State>& states) const {
    const dmrp_observation c = at(states.front());
    const dmrp::Observation now(c);
    const dmrp_costmap map = costmap.c();
    FootprintCheck footprint(CostmapView(map), disc, 0.0, now.pose);
    Trajectory trajectory;
    trajectory.states = states;
    trajectory.controls.resize(states.size() - 1);
    trajectory.dt_s = 1.0;
    return is_collision_free(trajectory, 100, {now, obstacles, footprint});
  }
};

TEST_CASE("A trajectory with states on both sides of a wall is not free") {
  const Room room;
  CHECK(room.allows({{0.5, -1.0, 0.0}, {0.6, -1.0, 0.0}}));
  CHECK_FALSE(room.allows({{0.5, -1.0, 0.0}, {1.5, -1.0, 0.0}}));
}

TEST_CASE("A robot close to one obstacle comes no closer to it, nor to another one") {
  const Room room;
  const State beside_wall = {0.74, -0.5, 0.5 * pi};  // 1 cm from the wall, farther from the corner
  CHECK(room.allows({beside_wall, {0.74, -0.4, 0.5 * pi}}));
  CHECK(room.allows({beside_wall, {0.70, -0.4, 0.5 * pi}}));
  CHECK_FALSE(room.allows({beside_wall, {0.744, -0.4, 0.5 * pi}}));
  CHECK_FALSE(room.allows({beside_wall, {0.70, 0.04, 0.5 * pi}}));  // 1 cm from the corner
}

TEST_CASE("A trajectory that touches a static obstacle within the solver's tolerance is free") {
  Room room;
  for (Obstacle& obstacle : room.obstacles) obstacle.is_agent = false;
  CHECK(room.allows({{0.5, -1.0, 0.0}, {0.7502, -1.0, 0.0}}));
  CHECK_FALSE(room.allows({{0.5, -1.0, 0.0}, {0.755, -1.0, 0.0}}));
}

}  // namespace mpc_test
