// SPDX-License-Identifier: MIT
// barrier_problem.hpp: the barrier problem of the interior point method: its variables, objective and optimality
// conditions.
//
// Every constraint gets a slack, every elastic constraint an excess, and every component of the terminal condition two
// variables for its error. Logarithmic barriers keep all of them positive.
#pragma once

#include "controllers/mpc/problem.hpp"
#include "controllers/mpc/riccati.hpp"

namespace dmrp::controllers::mpc {

// The variables of one constraint: value - excess + slack = 0, slack >= 0, multiplier >= 0; if it is elastic also
// excess >= 0 and multiplier <= obstacle_weight, otherwise excess = 0.
struct ConstraintPair {
  double slack = 1.0;
  double multiplier = 1.0;
  double excess = 0.0;
};

// The variables of one terminal component: error - over + under = 0, over >= 0, under >= 0, |multiplier| <= weight.
struct TerminalPair {
  double over = 1.0;
  double under = 1.0;
  double multiplier = 0.0;
};

// All variables except the multipliers of the transitions, and the problem's functions evaluated at them.
struct Point {
  Trajectory trajectory;
  std::vector<ConstraintPair> pairs;
  std::array<TerminalPair, 3> terminal;
  // evaluated
  std::vector<Constraint> constraints;
  std::vector<Transition> transitions;
  std::array<double, 3> terminal_error = {};

  void reserve(std::size_t states, std::size_t most_constraints) {
    trajectory.reserve(states);
    pairs.reserve(most_constraints);
    constraints.reserve(most_constraints);
    transitions.reserve(states);
  }
};

class BarrierProblem {
 public:
  void reserve(std::size_t states) { first_.reserve(states + 1); }

  // `problem` must outlive the use of this object.
  void begin(const Problem& problem, std::size_t stages);

  const Problem& problem() const { return *problem_; }
  std::size_t stage_count() const { return first_.size() - 1; }
  std::size_t constraint_count() const { return first_.back(); }
  // The constraints of stage k are those from first(k) to first(k + 1).
  std::size_t first(std::size_t k) const { return first_[k]; }

  // Sets the point's trajectory and the sizes of its lists.
  void place(const Trajectory& trajectory, Point& point) const;

  // Evaluates the constraints, transitions and terminal error at the point's trajectory.
  void evaluate(Point& point) const;

  // Sets slacks and multipliers to the central path of `barrier`, as far as the trajectory allows.
  void center(double barrier, Point& point) const;

  // The l1 norm of all equality constraints.
  double residual(const Point& point) const;

  // The objective with the barrier terms.
  double value(const Point& point, double barrier) const;

  // The largest residual of the optimality conditions (equation 5 of Wächter and Biegler, without its scaling).
  // `multipliers`: of the transitions.
  double optimality_error(const Point& point, const std::vector<StateVector>& multipliers, double barrier) const;

 private:
  const Problem* problem_ = nullptr;
  std::vector<std::size_t> first_;
};

}  // namespace dmrp::controllers::mpc
