// SPDX-License-Identifier: MIT
#include "controllers/mpc/problem.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::controllers::mpc {

namespace {

constexpr std::size_t bounds_count = 4;   // of a control
constexpr std::size_t rates_count = 4;    // of a control after another
constexpr std::size_t step_count = 2;     // of dt
constexpr std::size_t turning_count = 2;  // of the turning rate of a car

// sign * w[entry] + offset <= 0
Constraint bound(double sign, StageEntry entry, const StageVector& w, double offset) {
  Constraint c;
  c.value = sign * w[entry] + offset;
  c.gradient[entry] = sign;
  return c;
}

// sign * (w[to] - w[from]) - rate dt <= 0
Constraint rate_bound(double sign, StageEntry to, StageEntry from, const StageVector& w, double rate) {
  Constraint c;
  c.value = sign * (w[to] - w[from]) - rate * w[at_dt];
  c.gradient[to] = sign;
  c.gradient[from] = -sign;
  c.gradient[at_dt] = -rate;
  return c;
}

// sign * v tan(steering) / wheelbase - turning_max <= 0. The second derivative is neglected.
Constraint turning_bound(double sign, const Problem& problem, const StageVector& w) {
  const double tangent = std::tan(w[at_omega]);
  Constraint c;
  c.value = sign * w[at_v] * tangent / problem.wheelbase_m - problem.turning_max;
  c.gradient[at_v] = sign * tangent / problem.wheelbase_m;
  c.gradient[at_omega] = sign * w[at_v] * (1.0 + tangent * tangent) / problem.wheelbase_m;
  return c;
}

// The curvature of the distance: the reciprocal of the distance between a disc's centre and the closest corner of the
// obstacle; 0 if a side is closest. Polygonal footprints count as closest by a side: their curvature is neglected.
double corner_curvature(const Footprint& footprint, Vec2 robot, const Obstacle& obstacle, const Separation& apart) {
  if (footprint.part_count > 0) return 0.0;
  const double to_center_m = apart.distance_m + footprint.radius_m + obstacle.radius_m;
  if (to_center_m < 1e-3) return 0.0;
  const Vec2 nearest = robot - to_center_m * apart.gradient;
  for (std::uint32_t i = 0; i < obstacle.vertex_count; ++i)
    if (toolkit::squared_distance(nearest, obstacle.vertices[i]) < 1e-12) return 1.0 / to_center_m;
  return 0.0;
}

Constraint keep_away(const Problem& problem, const Obstacle& obstacle, std::size_t k, const StageVector& w) {
  const double stages_ahead = static_cast<double>(k);
  const double ahead_s = stages_ahead * w[at_dt];
  const Separation apart = separation(*problem.footprint, {w[at_x], w[at_y], w[at_theta]}, obstacle, ahead_s);
  Constraint c;
  c.is_elastic = true;
  c.value = (obstacle.is_agent ? 1.0 : problem.static_share) * problem.min_obstacle_dist_m - apart.distance_m;
  c.gradient[at_x] = -apart.gradient.x;
  c.gradient[at_y] = -apart.gradient.y;
  c.gradient[at_theta] = -apart.gradient_theta;
  c.gradient[at_dt] = stages_ahead * toolkit::dot(apart.gradient, obstacle.velocity);
  const Vec2 relative = Vec2{w[at_x], w[at_y]} - displacement(obstacle, ahead_s);
  c.curvature = corner_curvature(*problem.footprint, relative, obstacle, apart);
  const Vec2 tangent = toolkit::perpendicular(apart.gradient);
  c.tangent = {tangent.x, tangent.y, -stages_ahead * toolkit::dot(tangent, obstacle.velocity)};
  return c;
}

}  // namespace

std::array<double, 3> Problem::terminal_error(const State& last) const {
  return {last.x - goal.x, last.y - goal.y, fixes_heading ? toolkit::wrap(last.theta - goal.theta) : 0.0};
}

double Problem::fastest_turn() const {
  return is_car_like() ? std::min(turning_max, v_max * std::tan(omega_max) / wheelbase_m) : omega_max;
}

StageVector Problem::stage(const Trajectory& at, std::size_t k) const {
  const State& s = at.states[k];
  const Control& previous = k > 0 ? at.controls[k - 1] : before;
  const Control own = k < at.controls.size() ? at.controls[k] : Control{};
  return {s.x, s.y, s.theta, previous.v, previous.omega, at.dt_s, own.v, own.omega};
}

std::size_t Problem::constraint_count(std::size_t stages, std::size_t k) const {
  std::size_t count = obstacles[k].size();
  if (k == 0) count += step_count;
  if (k + 1 < stages) return count + bounds_count + rates_count + (is_car_like() ? turning_count : 0);
  return count + (ends_at_rest ? rates_count : 0);
}

void Problem::constraints(std::size_t stages, std::size_t k, const StageVector& w, Constraint* out) const {
  if (k == 0) {
    *out++ = bound(-1.0, at_dt, w, dt_min_s);
    *out++ = bound(1.0, at_dt, w, -dt_max_s);
  }
  if (k + 1 < stages) {
    for (const double sign : {1.0, -1.0}) {
      *out++ = rate_bound(sign, at_v, at_v_before, w, a_max);
      *out++ = rate_bound(sign, at_omega, at_omega_before, w, alpha_max);
    }
    *out++ = bound(1.0, at_v, w, -v_max);
    *out++ = bound(-1.0, at_v, w, v_min);
    *out++ = bound(1.0, at_omega, w, -omega_max);
    *out++ = bound(-1.0, at_omega, w, -omega_max);
    if (is_car_like())
      for (const double sign : {1.0, -1.0}) *out++ = turning_bound(sign, *this, w);
  } else if (ends_at_rest) {
    for (const double sign : {1.0, -1.0}) {
      *out = bound(sign, at_v_before, w, -a_max * w[at_dt]);
      (out++)->gradient[at_dt] = -a_max;
      *out = bound(sign, at_omega_before, w, -alpha_max * w[at_dt]);
      (out++)->gradient[at_dt] = -alpha_max;
    }
  }
  for (const Obstacle* obstacle : obstacles[k]) *out++ = keep_away(*this, *obstacle, k, w);
}

Transition Problem::transition(const StageVector& w, const State& next) const {
  const double c = std::cos(w[at_theta]);
  const double s = std::sin(w[at_theta]);
  const double dt = w[at_dt];
  const double v = w[at_v];
  const double left = keeps_heading ? w[at_omega] : 0.0;
  const double tangent = is_car_like() ? std::tan(w[at_omega]) : 0.0;
  const double turning = is_car_like() ? v * tangent / wheelbase_m : keeps_heading ? 0.0 : w[at_omega];
  const double x_step_m = dt * v * c - dt * left * s;
  const double y_step_m = dt * v * s + dt * left * c;
  Transition t;
  t.defect = {w[at_x] + x_step_m - next.x, w[at_y] + y_step_m - next.y,
              toolkit::wrap(w[at_theta] + dt * turning - next.theta)};
  t.x_by_theta = -y_step_m;
  t.x_by_dt = v * c - left * s;
  t.x_by_v = dt * c;
  t.y_by_theta = x_step_m;
  t.y_by_dt = v * s + left * c;
  t.y_by_v = dt * s;
  t.theta_by_dt = turning;
  if (is_car_like()) {
    t.theta_by_v = dt * tangent / wheelbase_m;
    t.theta_by_omega = dt * v * (1.0 + tangent * tangent) / wheelbase_m;
  } else if (keeps_heading) {
    t.x_by_omega = -dt * s;
    t.y_by_omega = dt * c;
  } else {
    t.theta_by_omega = dt;
  }
  return t;
}

void Problem::add_transition_curvature(const StageVector& w, const double* multipliers, StageMatrix& hessian) const {
  const double c = std::cos(w[at_theta]);
  const double s = std::sin(w[at_theta]);
  const double along = multipliers[0] * c + multipliers[1] * s;    // the multiplier along the heading ...
  const double across = -multipliers[0] * s + multipliers[1] * c;  // ... and across it
  hessian[at_theta][at_theta] -= along * w[at_dt] * w[at_v];
  hessian[at_theta][at_dt] += across * w[at_v];
  hessian[at_theta][at_v] += across * w[at_dt];
  hessian[at_dt][at_v] += along;
  if (is_car_like()) {
    const double turning = multipliers[2] / wheelbase_m;
    const double tangent = std::tan(w[at_omega]);
    const double slope = 1.0 + tangent * tangent;
    hessian[at_dt][at_v] += turning * tangent;
    hessian[at_dt][at_omega] += turning * w[at_v] * slope;
    hessian[at_v][at_omega] += turning * w[at_dt] * slope;
    hessian[at_omega][at_omega] += turning * w[at_dt] * w[at_v] * 2.0 * tangent * slope;
  } else if (keeps_heading) {
    hessian[at_theta][at_theta] -= across * w[at_dt] * w[at_omega];
    hessian[at_theta][at_dt] -= along * w[at_omega];
    hessian[at_theta][at_omega] -= along * w[at_dt];
    hessian[at_dt][at_omega] += across;
  } else {
    hessian[at_dt][at_omega] += multipliers[2];
  }
}

double Problem::cost(const Trajectory& at) const {
  double sum = at.duration_s();
  const std::array<double, 3> error = terminal_error(at.states.back());
  const std::array<double, 3> weights = terminal_weights();
  for (std::size_t i = 0; i < error.size(); ++i) sum += weights[i] * std::abs(error[i]);
  for (std::size_t k = 1; k < at.size(); ++k) {
    const StageVector w = stage(at, k);
    for (const Obstacle* obstacle : obstacles[k])
      sum += obstacle_weight * std::max(0.0, keep_away(*this, *obstacle, k, w).value);
  }
  return sum;
}

double Problem::violation(const Trajectory& at) const {
  double worst = 0.0;
  std::vector<Constraint> stage_constraints;
  for (std::size_t k = 0; k < at.size(); ++k) {
    const StageVector w = stage(at, k);
    stage_constraints.resize(constraint_count(at.size(), k));
    constraints(at.size(), k, w, stage_constraints.data());
    for (const Constraint& c : stage_constraints)
      if (!c.is_elastic) worst = std::max(worst, c.value);
    if (k + 1 == at.size()) break;
    for (const double defect : transition(w, at.states[k + 1]).defect) worst = std::max(worst, std::abs(defect));
  }
  return worst;
}

}  // namespace dmrp::controllers::mpc
