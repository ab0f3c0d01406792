// SPDX-License-Identifier: MIT
// problem.hpp: the optimal control problem of one control period as a nonlinear program.
//
// Rösmann, Makarow, Bertram: Online Motion Planning Based on Nonlinear Model Predictive Control with Non-Euclidean
// Rotation Groups, ECC 2021, section III: states and controls on a grid with one variable time step dt,
//
//   minimise (N - 1) dt   subject to   s(k + 1) = s(k) + dt f(s(k), u(k)),  s(0) and s(N - 1) given,
//
// for a unicycle, for upstream's simple car with the steering angle as its second control, or for a holonomic robot that
// keeps its heading, with the speed to the left as its second control; bounds on speeds, accelerations and dt, and min_obstacle_dist - distance <= 0 at every state. Angle differences in
// the transitions and in the terminal condition are wrapped.
//
// Two kinds of constraints are elastic, so that a solution always exists: violating an obstacle constraint costs
// obstacle_weight seconds per metre, missing the terminal state costs position_weight and heading_weight. Both are
// exact penalties: if the constraints can be met, the solution meets them.
//
// All functions work stage by stage, on the vector w(k) of the state, the previous control, dt, and the control. The
// interior point method and, in the tests, IPOPT use the same functions.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "controllers/motion/obstacles.hpp"
#include "controllers/mpc/trajectory.hpp"

namespace dmrp::controllers::mpc {

// The entries of a stage vector. Later stages depend on the first state_size entries of the next vector only.
enum StageEntry : std::size_t { at_x, at_y, at_theta, at_v_before, at_omega_before, at_dt, at_v, at_omega };
inline constexpr std::size_t state_size = 6;
inline constexpr std::size_t stage_size = 8;
using StageVector = std::array<double, stage_size>;

// Symmetric; entries (i, j) with i <= j are used.
using StageMatrix = std::array<std::array<double, stage_size>, stage_size>;

// value <= 0; if elastic, value <= excess at the cost obstacle_weight * excess.
// The second derivative of the value is -curvature * tangent tangent', with the tangent over (x, y, dt).
struct Constraint {
  double value = 0.0;
  StageVector gradient = {};
  double curvature = 0.0;
  std::array<double, 3> tangent = {};
  bool is_elastic = false;
};

// The defect s(k) + dt f(s(k), u(k)) - s(k + 1), with wrapped angle, and its derivatives by entries of stage k. (Those
// by x, y and theta of stage k are 1 in their own component; by those of stage k + 1, -1.)
struct Transition {
  std::array<double, 3> defect = {};
  double x_by_theta = 0.0, x_by_dt = 0.0, x_by_v = 0.0, x_by_omega = 0.0;
  double y_by_theta = 0.0, y_by_dt = 0.0, y_by_v = 0.0, y_by_omega = 0.0;
  double theta_by_dt = 0.0, theta_by_v = 0.0, theta_by_omega = 0.0;
};

struct Problem {
  State start = {0.0, 0.0, 0.0};
  Control before;  // the control applied now
  State goal = {0.0, 0.0, 0.0};
  bool fixes_heading = true;  // at the goal
  bool ends_at_rest = false;

  double v_min = 0.0, v_max = 1.0, omega_max = 1.0;  // m/s, rad/s
  double a_max = 1.0, alpha_max = 1.0;               // m/s^2, rad/s^2
  // Of a car-like robot, otherwise 0. Then omega is the steering angle, omega_max its largest value and alpha_max its
  // largest rate, and turning_max bounds the turning rate.
  double wheelbase_m = 0.0;
  double turning_max = 0.0;  // rad/s
  // A holonomic robot keeps its heading. Then omega is the speed to the left, omega_max its largest value (m/s) and
  // alpha_max its largest change (m/s^2).
  bool keeps_heading = false;
  double dt_min_s = 0.0, dt_max_s = 10.0;
  double min_obstacle_dist_m = 0.1;  // between the outlines
  double static_share = 1.0;         // of it, that obstacles demand which are no agents

  double obstacle_weight = 50.0;  // s/m
  double position_weight = 20.0;  // s/m
  double heading_weight = 5.0;    // s/rad

  const Footprint* footprint = nullptr;
  // The obstacles that constrain each state (see Association); at least as many lists as states, the first one empty.
  std::vector<std::vector<const Obstacle*>> obstacles;

  bool is_car_like() const { return wheelbase_m > 0.0; }
  // The fastest turn of a robot at full speed (rad/s).
  double fastest_turn() const;

  // The penalty weights of the terminal condition's three components.
  std::array<double, 3> terminal_weights() const {
    return {position_weight, position_weight, fixes_heading ? heading_weight : 0.0};
  }
  std::array<double, 3> terminal_error(const State& last) const;

  // The vector of stage k; its control entries are 0 at the last stage.
  StageVector stage(const Trajectory& at, std::size_t k) const;

  std::size_t constraint_count(std::size_t stages, std::size_t k) const;
  // Writes constraint_count() constraints.
  void constraints(std::size_t stages, std::size_t k, const StageVector& w, Constraint* out) const;

  Transition transition(const StageVector& w, const State& next) const;

  // Adds the second derivative of multipliers' * transition to the Hessian.
  void add_transition_curvature(const StageVector& w, const double* multipliers, StageMatrix& hessian) const;

  // The objective: (N - 1) dt and the penalties of the elastic constraints.
  double cost(const Trajectory& at) const;
  // The largest violation of a constraint that is not elastic, or of a transition.
  double violation(const Trajectory& at) const;
};

}  // namespace dmrp::controllers::mpc
