// SPDX-License-Identifier: MIT
#include "tests/unit/controllers/mpc/recorded_problems.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "controllers/mpc/association.hpp"
#include "controllers/mpc/initial_guess.hpp"
#include "controllers/mpc/interior_point.hpp"
#include "tests/unit/controllers/robot_body.hpp"

namespace dmrp::test {

using namespace controllers;
using namespace controllers::mpc;
using toolkit::Stream;

namespace {

const dmrp_footprint disc = disc_footprint(0.25);
constexpr double period_s = 0.1;
constexpr double look_ahead_m = 2.5;
constexpr double path_m = 8.0;
constexpr int periods = 80;
constexpr int periods_between_records = 9;

struct Shape {
  std::vector<dmrp_vec2> vertices;
  double radius_m = 0.0;
  dmrp_vec2 velocity = {0.0, 0.0};
};

Shape box_at(dmrp_vec2 center, double half_x, double half_y, double turn) {
  Shape shape;
  for (const dmrp_vec2 corner : {dmrp_vec2{-half_x, -half_y}, {half_x, -half_y}, {half_x, half_y}, {-half_x, half_y}})
    shape.vertices.push_back(center + toolkit::rotate(corner, turn));
  return shape;
}

std::vector<Shape> mall_like(Stream& random) {
  std::vector<Shape> shapes;
  const double half_width = random.uniform(0.7, 2.0);
  shapes.push_back({{{-2.0, half_width}, {12.0, half_width}}});
  shapes.push_back({{{-2.0, -half_width}, {12.0, -half_width}}});
  for (int i = 0; i < 3; ++i) {
    const double side = random.chance(0.5) ? 1.0 : -1.0;
    shapes.push_back(box_at({random.uniform(1.5, 9.0), side * (half_width - 0.2)}, 0.3, 0.2, 0.0));
  }
  for (int i = 0; i < 3; ++i) {
    Shape person;
    person.vertices = {{random.uniform(3.0, 12.0), random.uniform(-1.0, 1.0) * half_width}};
    person.radius_m = 0.3;
    person.velocity = {random.uniform(-1.3, 0.3), random.uniform(-0.3, 0.3)};
    shapes.push_back(person);
  }
  return shapes;
}

std::vector<Shape> cluttered(Stream& random) {
  std::vector<Shape> shapes;
  for (int i = 0; i < 12; ++i) {
    const dmrp_vec2 at = {random.uniform(0.9, 10.0), random.uniform(-1.6, 1.6)};
    if (random.chance(0.6))
      shapes.push_back({{at}, random.uniform(0.0, 0.1)});
    else
      shapes.push_back(box_at(at, random.uniform(0.1, 0.3), random.uniform(0.1, 0.3), random.uniform(0.0, 3.0)));
  }
  return shapes;
}

// One drive along the x axis.
class Recorder {
 public:
  Recorder(std::uint64_t seed, std::size_t world)
      : random_(seed, "recorded_problems", world),
        shapes_(world % 2 == 0 ? mall_like(random_) : cluttered(random_)),
        pose_{0.0, random_.uniform(-0.1, 0.1), random_.uniform(-0.4, 0.4)} {}

  void drive(std::size_t count, std::vector<RecordedProblem>& out) {
    for (int period = 0; period < periods && out.size() < count; ++period) {
      RecordedProblem now = pose_problem(period * period_s);
      if (now.problem.goal.x - pose_.x < 0.3) return;
      const bool is_warm = !last_.states.empty();
      InitialGuess guess;
      if (is_warm) {
        now.start = last_;
        guess.shifted(now.problem, period_s, now.start);
      } else {
        guess.along(now.problem, {{pose_.x, 0.0}, {0.5 * (pose_.x + now.problem.goal.x), 0.0}}, 20, now.start);
      }
      now.is_warm = is_warm;
      Association().associate(now.start, *now.obstacles, {}, now.problem);
      last_ = now.start;
      SolverSettings settings;
      if (is_warm) settings.barrier_start = 1e-2;
      const SolverReport report = InteriorPoint().solve(now.problem, settings, last_);
      if (period % periods_between_records == 0) out.push_back(now);
      if (!report.converged) last_ = {};
      drive_on();
    }
  }

 private:
  RecordedProblem pose_problem(double t_s) const {
    RecordedProblem now;
    auto vertices = std::make_shared<std::vector<dmrp_vec2>>();
    auto obstacles = std::make_shared<std::vector<Obstacle>>();
    for (const Shape& shape : shapes_)
      for (const dmrp_vec2 vertex : shape.vertices) vertices->push_back(vertex + t_s * shape.velocity);
    const dmrp_vec2* next = vertices->data();
    for (const Shape& shape : shapes_) {
      Obstacle obstacle;
      obstacle.vertices = next;
      obstacle.vertex_count = static_cast<std::uint32_t>(shape.vertices.size());
      obstacle.radius_m = shape.radius_m;
      obstacle.velocity = shape.velocity;
      obstacle.center = next[0];
      for (std::uint32_t i = 0; i < obstacle.vertex_count; ++i)
        obstacle.reach_m = std::max(obstacle.reach_m, toolkit::distance(next[0], next[i]));
      next += obstacle.vertex_count;
      obstacles->push_back(obstacle);
    }
    now.vertices = vertices;
    now.obstacles = obstacles;
    now.problem.footprint = &disc;
    now.problem.v_max = 0.8;
    now.problem.start = pose_;
    now.problem.before = applied_;
    now.problem.goal = {std::min(path_m, pose_.x + look_ahead_m), 0.0, 0.0};
    now.problem.ends_at_rest = now.problem.goal.x == path_m;
    now.problem.fixes_heading = !now.problem.ends_at_rest;
    return now;
  }

  void drive_on() {
    const Control wanted = last_.controls.empty() ? Control{} : last_.controls[0];
    applied_.v += std::clamp(wanted.v - applied_.v, -period_s, period_s);
    applied_.omega += std::clamp(wanted.omega - applied_.omega, -period_s, period_s);
    pose_.theta += 0.5 * applied_.omega * period_s;
    pose_.x += applied_.v * std::cos(pose_.theta) * period_s;
    pose_.y += applied_.v * std::sin(pose_.theta) * period_s;
    pose_.theta += 0.5 * applied_.omega * period_s;
  }

  Stream random_;
  std::vector<Shape> shapes_;
  State pose_;
  Control applied_;
  Trajectory last_;
};

}  // namespace

std::vector<RecordedProblem> record_problems(std::uint64_t seed, std::size_t count) {
  std::vector<RecordedProblem> out;
  for (std::size_t world = 0; out.size() < count; ++world) Recorder(seed, world).drive(count, out);
  return out;
}

}  // namespace dmrp::test
