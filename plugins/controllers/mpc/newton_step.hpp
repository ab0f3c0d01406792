// SPDX-License-Identifier: MIT
// newton_step.hpp: the Newton step of the barrier problem: assembled stage by stage, solved by the Riccati recursion.
//
// Eliminates the slacks, excesses and constraint multipliers, so that the quadratic problem is one over the stages
// alone.
#pragma once

#include "controllers/mpc/barrier_problem.hpp"
#include "controllers/mpc/riccati.hpp"

namespace dmrp::controllers::mpc {

// The functions take the point for which assemble() was called.
class NewtonStep {
 public:
  void reserve(std::size_t states, std::size_t constraints);

  // The quadratic problem at a point with these multipliers of the transitions.
  void assemble(const BarrierProblem& barriers, const Point& at, const std::vector<StateVector>& multipliers,
                double barrier);

  // Factors with `shift` added to the Hessian's diagonal. False if the reduced Hessian is not positive definite.
  bool factor(double shift) { return riccati_.factor(shift); }

  // Computes the step of all variables.
  void solve(const BarrierProblem& barriers, const Point& at, double barrier);

  // The largest step length, at most 1, by the fraction-to-the-boundary rule: for slacks and excesses, or for the
  // multipliers.
  double largest_step(const BarrierProblem& barriers, const Point& at, double barrier, bool primal) const;

  // The derivative of the barrier problem's value along the step.
  double slope(const BarrierProblem& barriers, const Point& at, double barrier) const;

  // Sets `to` to `from` plus `length` times the step; the multipliers stay.
  void move(double length, const Point& from, Point& to) const;

  // Moves the multipliers of the constraints by `dual_step`, those of the transitions by `primal_step`.
  void move_multipliers(double primal_step, double dual_step, Point& point,
                        std::vector<StateVector>& multipliers) const;

 private:
  void assemble_stage(const BarrierProblem& barriers, const Point& at, double barrier, std::size_t k);

  RiccatiRecursion riccati_;
  std::vector<ConstraintPair> pair_steps_;
  std::array<TerminalPair, 3> terminal_steps_;
};

}  // namespace dmrp::controllers::mpc
