// SPDX-License-Identifier: MIT
// riccati.hpp: solves the quadratic problem of one Newton step stage by stage.
//
// The Karush-Kuhn-Tucker system is banded except for dt, which all stages share. Here dt and the previous control are
// components of the state (dt stays constant; the previous control is the last control), so that the Riccati recursion
// of linear-quadratic control solves the system in one backward and one forward sweep: Rao, Wright, Rawlings:
// Application of interior-point methods to model predictive control, J. Optimization Theory and Applications 99 (1998).
// The reduced Hessian is positive definite if and only if the control blocks of all stages and the entry of dt at the
// start are.
#pragma once

#include "controllers/mpc/problem.hpp"

namespace dmrp::controllers::mpc {

using StateVector = std::array<double, state_size>;
using StateMatrix = std::array<std::array<double, state_size>, state_size>;  // symmetric, both halves filled

// One stage of the quadratic problem: 1/2 w' hessian w + gradient' w, and the transition to the next stage. At the last
// stage the control's entries are ignored.
struct QuadraticStage {
  StageMatrix hessian;
  StageVector gradient;
  Transition transition;
};

class RiccatiRecursion {
 public:
  // The stages, for the caller to fill in.
  std::vector<QuadraticStage>& stages() { return stages_; }

  // The backward sweep, with `shift` added to the Hessian's diagonal. False if the reduced Hessian is not positive
  // definite; solve() must not be called then.
  bool factor(double shift);

  // The forward sweep: computes the step of every stage and the multipliers of the transition into it.
  void solve();
  const std::vector<StageVector>& steps() const { return steps_; }
  const std::vector<StateVector>& multipliers() const { return multipliers_; }

  void reserve(std::size_t stages);

 private:
  // The optimal cost from a state z on, 1/2 z' hessian z + gradient' z, and the optimal control feedback z +
  // feedforward.
  struct CostToGo {
    StateMatrix hessian;
    StateVector gradient;
    std::array<StateVector, 2> feedback;
    std::array<double, 2> feedforward;
  };
  void end_at(const QuadraticStage& stage, double shift, CostToGo& out) const;
  bool step_back(const QuadraticStage& stage, double shift, const CostToGo& next, CostToGo& out) const;

  std::vector<QuadraticStage> stages_;
  std::vector<CostToGo> cost_to_go_;
  std::vector<StageVector> steps_;
  std::vector<StateVector> multipliers_;
  double start_dt_ = 0.0;  // the step of dt
};

}  // namespace dmrp::controllers::mpc
