// SPDX-License-Identifier: MIT
// interior_point.hpp: a primal-dual interior point method for the optimal control problem.
//
// Wächter, Biegler: On the implementation of an interior-point filter line-search algorithm for large-scale nonlinear
// programming, Mathematical Programming 106 (2006): the barrier and its reduction (equations 7, 8), the rule of the
// fraction to the boundary (8), inertia correction (3.1), the filter line search (2.3), without second-order
// corrections and restoration: elastic constraints take their place. Newton steps come from the Riccati recursion.
//
// Deterministic: bounded by iterations, never by time. Allocates nothing within what reserve() allowed for.
#ifndef DMRP_CONTROLLERS_MPC_INTERIOR_POINT_HPP
#define DMRP_CONTROLLERS_MPC_INTERIOR_POINT_HPP

#include "controllers/mpc/problem.hpp"
#include "controllers/mpc/riccati.hpp"

namespace dmrp::controllers::mpc {

struct SolverSettings {
  int iterations = 100;
  double tolerance = 1e-4;      // of the optimality conditions
  double barrier_start = 1e-1;  // lower for starts near the solution
  double barrier_end = 1e-5;    // of the order of the error of the cost, by active constraint
};

struct SolverReport {
  bool converged = false;
  int iterations = 0;
  double cost_s = 0.0;            // with the elastic terms
  double excess_m = 0.0;          // the greatest violation of an obstacle's constraint ...
  double terminal_error_m = 0.0;  // ... and what is left of the way to the goal
  double infeasibility = 0.0;     // sum of what is left of all others
};

class InteriorPoint {
 public:
  void reserve(std::size_t states, std::size_t constraints);

  // Improves `trajectory`, which has the size that it shall keep.
  SolverReport solve(const Problem& problem, const SolverSettings& settings, Trajectory& trajectory);

 private:
  // What belongs to a constraint beside its value: value - excess + slack = 0, slack >= 0, its multiplier >= 0, and
  // where it is elastic excess >= 0 and multiplier <= obstacle_weight.
  struct Pair {
    double slack = 1.0;
    double multiplier = 1.0;
    double excess = 0.0;
  };
  // error - over + under = 0, over >= 0, under >= 0, |multiplier| <= weight, for each terminal component.
  struct Terminal {
    double over = 1.0;
    double under = 1.0;
    double multiplier = 0.0;
  };
  struct Point {
    Trajectory trajectory;
    std::vector<Pair> pairs;
    std::array<Terminal, 3> terminal;
    // evaluated there
    std::vector<Constraint> constraints;
    std::vector<Transition> transitions;
    std::array<double, 3> terminal_error = {};
  };
  struct PairStep {
    double slack = 0.0;
    double multiplier = 0.0;
    double excess = 0.0;
  };

  struct Merit {
    double residual;
    double value;
  };

  void evaluate(Point& point) const;
  void begin(const Trajectory& trajectory);
  void assemble();
  void assemble_stage(std::size_t k);
  bool factor();
  void find_steps();
  double largest_step(bool primal) const;
  double residual(const Point& point) const;  // l1 norm of what shall be zero
  double barrier_value(const Point& point) const;
  double slope() const;  // of the barrier value along the step
  bool search();
  bool passes_filter(const Merit& merit) const;
  void move(double step, const Point& from, Point& to) const;
  void move_multipliers(double primal_step, double dual_step);
  double optimality_error(double barrier) const;
  SolverReport report(bool converged, int iterations) const;

  const Problem* problem_ = nullptr;
  RiccatiRecursion riccati_;
  std::vector<std::size_t> first_;  // constraint of each stage, and their count
  Point now_;
  Point next_;
  std::vector<StateVector> multipliers_;  // of the transitions
  std::vector<PairStep> pair_steps_;
  std::array<PairStep, 3> terminal_steps_;  // slack: over; excess: under
  double barrier_ = 0.1;
  std::vector<Merit> filter_;  // what no step may lead back to
  double shift_ = 0.0;
};

}  // namespace dmrp::controllers::mpc

#endif
