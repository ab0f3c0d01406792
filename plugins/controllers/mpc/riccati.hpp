// SPDX-License-Identifier: MIT
// riccati.hpp: the quadratic problem of one Newton step, solved stage by stage.
//
// The Karush-Kuhn-Tucker system is banded but for dt, which every stage shares. Here dt and the control before travel
// along as parts of the state (dt stays, the control before is the last control), so that the Riccati recursion of
// linear-quadratic control solves it in one sweep back and one forth: Rao, Wright, Rawlings: Application of
// interior-point methods to model predictive control, J. Optimization Theory and Applications 99 (1998). The reduced
// Hessian is positive definite if and only if the control blocks of all stages are, and dt's own entry at the start.
#ifndef DMRP_CONTROLLERS_MPC_RICCATI_HPP
#define DMRP_CONTROLLERS_MPC_RICCATI_HPP

#include "controllers/mpc/problem.hpp"

namespace dmrp::controllers::mpc {

using StateVector = std::array<double, state_size>;
using StateMatrix = std::array<std::array<double, state_size>, state_size>;  // symmetric, both halves filled

// Of the quadratic problem: 1/2 w' hessian w + gradient' w, and where w leads. At the last stage the control's entries
// are ignored.
struct QuadraticStage {
  StageMatrix hessian;
  StageVector gradient;
  Transition transition;
};

class RiccatiRecursion {
 public:
  // The problem's stages, to be filled in.
  std::vector<QuadraticStage>& stages() { return stages_; }

  // Backward sweep with `shift` added to the Hessian's diagonal. False where the reduced Hessian is not positive
  // definite; solve() must not be called then.
  bool factor(double shift);

  // Forward sweep: the step of every stage, and the multipliers of the transition that leads to it (of the state's
  // entries, given values at stage 0).
  void solve();
  const std::vector<StageVector>& steps() const { return steps_; }
  const std::vector<StateVector>& multipliers() const { return multipliers_; }

  void reserve(std::size_t stages);

 private:
  // What is left to pay from a state on: 1/2 z' hessian z + gradient' z, and the control that pays it.
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

#endif
