// SPDX-License-Identifier: MIT
// problem.hpp: the optimal control problem of one control period, as a nonlinear program.
//
// Rösmann, Makarow, Bertram: Online Motion Planning Based on Nonlinear Model Predictive Control with Non-Euclidean
// Rotation Groups, ECC 2021, section III: states and controls on a grid whose one time step dt is a variable,
//
//   minimise (N - 1) dt   subject to   s(k + 1) = s(k) + dt f(s(k), u(k)),  s(0) and s(N - 1) given,
//
// bounds on speeds, accelerations and dt, and min_obstacle_dist - distance <= 0 at every state. Angles are wrapped in
// what follows a state and in the terminal condition.
//
// Two kinds of constraints are elastic, so that there is always an answer: an obstacle's may be violated at
// obstacle_weight seconds a metre, the terminal state missed at position_weight and heading_weight. These are exact
// penalties: where the constraints can be met they are.
//
// Everything is said stage by stage: over the vector w(k) of the state, the control before it, dt, and the control.
// Whoever solves it (the interior point method here, IPOPT in the tests) sees it through the functions below.
#ifndef DMRP_CONTROLLERS_MPC_PROBLEM_HPP
#define DMRP_CONTROLLERS_MPC_PROBLEM_HPP

#include <array>
#include <cstddef>
#include <vector>

#include "controllers/motion/obstacles.hpp"
#include "controllers/mpc/trajectory.hpp"

namespace dmrp::controllers::mpc {

// The entries of a stage vector. The first state_size of them say all that the later stages depend on.
enum StageEntry : std::size_t { at_x, at_y, at_theta, at_v_before, at_omega_before, at_dt, at_v, at_omega };
inline constexpr std::size_t state_size = 6;
inline constexpr std::size_t stage_size = 8;
using StageVector = std::array<double, stage_size>;

// Symmetric; entries (i, j) with i <= j are used.
using StageMatrix = std::array<std::array<double, stage_size>, stage_size>;

// value <= 0, or value <= excess at obstacle_weight * excess where it is elastic.
// The second derivative of the value is -curvature * tangent tangent', the tangent being over (x, y, dt).
struct Constraint {
  double value = 0.0;
  StageVector gradient = {};
  double curvature = 0.0;
  std::array<double, 3> tangent = {};
  bool is_elastic = false;
};

// s(k) + dt f(s(k), u(k)) - s(k + 1), the angle wrapped, and its derivatives by the entries named. (By x, y and theta
// of stage k it is 1; by those of stage k + 1, -1.)
struct Transition {
  std::array<double, 3> defect = {};
  double x_by_theta = 0.0, x_by_dt = 0.0, x_by_v = 0.0;
  double y_by_theta = 0.0, y_by_dt = 0.0, y_by_v = 0.0;
  double theta_by_dt = 0.0, theta_by_omega = 0.0;
};

struct Problem {
  State start;
  Control before;  // applied now
  State goal;
  bool fixes_heading = true;  // at the goal
  bool ends_at_rest = false;

  double v_min = 0.0, v_max = 1.0, omega_max = 1.0;  // m/s, rad/s
  double a_max = 1.0, alpha_max = 1.0;               // m/s^2, rad/s^2
  double dt_min_s = 0.0, dt_max_s = 10.0;
  double min_obstacle_dist_m = 0.1;  // beyond the outlines

  double obstacle_weight = 50.0;  // s/m
  double position_weight = 20.0;  // s/m
  double heading_weight = 5.0;    // s/rad

  const Footprint* footprint = nullptr;
  // The obstacles looked at, per state; as many lists as states (see associate()). The first state's is empty.
  std::vector<std::vector<const Obstacle*>> obstacles;

  // Seconds for what is left of the terminal condition, in its three components.
  std::array<double, 3> terminal_weights() const {
    return {position_weight, position_weight, fixes_heading ? heading_weight : 0.0};
  }
  std::array<double, 3> terminal_error(const State& last) const;

  // The vector of stage k; without a control at the last one.
  StageVector stage(const Trajectory& at, std::size_t k) const;

  std::size_t constraint_count(std::size_t stages, std::size_t k) const;
  // Writes constraint_count() of them.
  void constraints(std::size_t stages, std::size_t k, const StageVector& w, Constraint* out) const;

  Transition transition(const StageVector& w, const State& next) const;

  // Adds the second derivative of multipliers' * transition.
  void add_transition_curvature(const StageVector& w, const double* multipliers, StageMatrix& hessian) const;

  // (N - 1) dt and the elastic terms, at best: what a solution is judged by.
  double cost(const Trajectory& at) const;
  // The greatest excess of the constraints that are not elastic, and of the transitions.
  double violation(const Trajectory& at) const;
};

}  // namespace dmrp::controllers::mpc

#endif
