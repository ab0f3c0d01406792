// SPDX-License-Identifier: MIT
#include "controllers/mpc/trajectory_optimizer.hpp"

namespace dmrp::controllers::mpc {

namespace {

// The first barrier of a solution that starts at the one before, with a slightly different grid or association.
constexpr double barrier_again = 1e-3;

}  // namespace

std::size_t adapted_size(const Trajectory& trajectory, const GridRule& rule) {
  const std::size_t size = trajectory.size();
  if (trajectory.dt_s > rule.dt_ref * (1.0 + rule.dt_hyst_ratio) && size < rule.max_size) return size + 1;
  if (trajectory.dt_s < rule.dt_ref * (1.0 - rule.dt_hyst_ratio) && size > rule.min_size) return size - 1;
  return size;
}

void TrajectoryOptimizer::reserve(std::size_t states, std::size_t constraints, std::size_t obstacles) {
  solver_.reserve(states, constraints);
  association_.reserve(obstacles);
  guess_.reserve(obstacles);
}

OptimizerReport TrajectoryOptimizer::optimise(const OptimizerSettings& settings, double barrier_start,
                                              const std::vector<Obstacle>& obstacles, Problem& problem,
                                              Trajectory& trajectory) {
  OptimizerReport report;
  SolverSettings solver = settings.solver;
  solver.barrier_start = barrier_start;
  for (int i = 0; i < settings.outer_iterations; ++i) {
    const std::size_t size = adapted_size(trajectory, settings.grid);
    const bool is_resized = size != trajectory.size();
    if (is_resized) guess_.resized(problem, size, trajectory);
    const bool differs = association_.associate(trajectory, obstacles, settings.association, problem);
    if (i > 0 && !is_resized && !differs) break;
    const SolverReport solved = solver_.solve(problem, solver, trajectory);
    report.infeasibility = solved.infeasibility;
    report.iterations += solved.iterations;
    solver.barrier_start = barrier_again;
  }
  return report;
}

}  // namespace dmrp::controllers::mpc
