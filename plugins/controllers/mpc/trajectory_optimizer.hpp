// SPDX-License-Identifier: MIT
// trajectory_optimizer.hpp: the outer iterations of mpc_local_planner: adapt the grid, associate obstacles, solve.
#pragma once

#include "controllers/mpc/association.hpp"
#include "controllers/mpc/initial_guess.hpp"
#include "controllers/mpc/interior_point.hpp"

namespace dmrp::controllers::mpc {

// When the grid gains or loses a state.
struct GridRule {
  double dt_ref = 0.3;         // s
  double dt_hyst_ratio = 0.1;  // tolerated deviation from dt_ref, relative
  std::size_t min_size = 2;    // states
  std::size_t max_size = 50;
};

struct OptimizerSettings {
  int outer_iterations = 5;
  GridRule grid;
  AssociationRule association;
  SolverSettings solver;
};

struct OptimizerReport {
  double infeasibility = 0.0;  // of the last solution
  int iterations = 0;          // of the solver, in all outer iterations
};

// The size of the grid for the next solution: one state more or less, or the same.
std::size_t adapted_size(const Trajectory& trajectory, const GridRule& rule);

// Reuses its buffers.
class TrajectoryOptimizer {
 public:
  void reserve(std::size_t states, std::size_t constraints, std::size_t obstacles);

  // Optimises `trajectory` in place; ends when neither the grid nor the association changes. `barrier_start`: of the
  // first solution. Fills problem.obstacles with pointers into `obstacles`.
  OptimizerReport optimise(const OptimizerSettings& settings, double barrier_start,
                           const std::vector<Obstacle>& obstacles, Problem& problem, Trajectory& trajectory);

  InitialGuess& guess() { return guess_; }

 private:
  Association association_;
  InitialGuess guess_;
  InteriorPoint solver_;
};

}  // namespace dmrp::controllers::mpc
