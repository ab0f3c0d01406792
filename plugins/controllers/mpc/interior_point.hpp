// SPDX-License-Identifier: MIT
// interior_point.hpp: a primal-dual interior point method for the optimal control problem.
//
// Wächter, Biegler: On the implementation of an interior-point filter line-search algorithm for large-scale nonlinear
// programming, Mathematical Programming 106 (2006): the barrier and its reduction (equations 7, 8), the
// fraction-to-the-boundary rule (8), inertia correction (3.1), the filter line search (2.3). Second-order corrections
// and the restoration phase are not needed, because the obstacle and terminal constraints are elastic.
//
// Deterministic: bounded by iterations, not by time. Does not allocate within the sizes given to reserve().
#pragma once

#include "controllers/mpc/barrier_problem.hpp"
#include "controllers/mpc/newton_step.hpp"

namespace dmrp::controllers::mpc {

struct SolverSettings {
  int iterations = 100;
  double tolerance = 1e-4;      // of the optimality conditions
  double barrier_start = 1e-1;  // smaller for starts near the solution
  double barrier_end = 1e-5;    // about the error in the cost per active constraint
};

struct SolverReport {
  bool converged = false;
  int iterations = 0;
  double cost_s = 0.0;            // with the penalties of the elastic constraints
  double excess_m = 0.0;          // the largest violation of an obstacle constraint
  double terminal_error_m = 0.0;  // the remaining distance from the goal
  double infeasibility = 0.0;     // the l1 norm of the residuals of all other constraints
};

class InteriorPoint {
 public:
  void reserve(std::size_t states, std::size_t constraints);

  // Improves `trajectory`; its size does not change.
  SolverReport solve(const Problem& problem, const SolverSettings& settings, Trajectory& trajectory);

 private:
  struct Merit {
    double residual;
    double value;
  };

  void begin(const Problem& problem, const Trajectory& trajectory, double barrier);
  double reduced_barrier(double barrier, const SolverSettings& settings);
  bool advance(double barrier, double& shift);
  bool search(double barrier);
  bool passes_filter(const Merit& merit) const;
  SolverReport report(bool converged, int iterations) const;

  BarrierProblem barriers_;
  NewtonStep step_;
  Point now_;
  Point next_;                            // the line search's trial point
  std::vector<StateVector> multipliers_;  // of the transitions
  std::vector<Merit> filter_;             // no step may lead back to a point dominated by one of these
};

}  // namespace dmrp::controllers::mpc
