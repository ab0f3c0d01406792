// SPDX-License-Identifier: MIT
#include "controllers/mpc/newton_step.hpp"

#include <algorithm>

namespace dmrp::controllers::mpc {

namespace {

// A step covers at most this fraction of the distance to the boundary, where a slack or a multiplier would be zero.
constexpr double boundary_fraction = 0.99;

}  // namespace

void NewtonStep::reserve(std::size_t states, std::size_t constraints) {
  riccati_.reserve(states);
  pair_steps_.reserve(constraints);
}

void NewtonStep::assemble_stage(const BarrierProblem& barriers, const Point& at, double barrier, std::size_t k) {
  const Problem& problem = barriers.problem();
  QuadraticStage& stage = riccati_.stages()[k];
  stage.hessian = {};
  stage.gradient = {};
  for (std::size_t i = barriers.first(k); i < barriers.first(k + 1); ++i) {
    const Constraint& c = at.constraints[i];
    const ConstraintPair& pair = at.pairs[i];
    double inverse = pair.slack / pair.multiplier;
    double offset = c.value + barrier / pair.multiplier;
    if (c.is_elastic) {
      const double rest = problem.obstacle_weight - pair.multiplier;
      inverse += pair.excess / rest;
      offset -= barrier / rest;
    }
    const double sigma = 1.0 / inverse;
    const double pull = pair.multiplier + sigma * offset;
    for (std::size_t a = 0; a < stage_size; ++a) {
      if (c.gradient[a] == 0.0) continue;
      stage.gradient[a] += pull * c.gradient[a];
      const double row = sigma * c.gradient[a];
      for (std::size_t b = a; b < stage_size; ++b) stage.hessian[a][b] += row * c.gradient[b];
    }
    if (c.curvature == 0.0) continue;
    constexpr std::array<StageEntry, 3> entries = {at_x, at_y, at_dt};
    const double bend = -pair.multiplier * c.curvature;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = a; b < 3; ++b) stage.hessian[entries[a]][entries[b]] += bend * c.tangent[a] * c.tangent[b];
  }
}

void NewtonStep::assemble(const BarrierProblem& barriers, const Point& at, const std::vector<StateVector>& multipliers,
                          double barrier) {
  const Problem& problem = barriers.problem();
  const std::size_t last = barriers.stage_count() - 1;
  riccati_.stages().resize(last + 1);
  pair_steps_.resize(barriers.constraint_count());
  for (std::size_t k = 0; k <= last; ++k) {
    assemble_stage(barriers, at, barrier, k);
    if (k == last) break;
    QuadraticStage& stage = riccati_.stages()[k];
    stage.transition = at.transitions[k];
    const StageVector w = problem.stage(at.trajectory, k);
    problem.add_transition_curvature(w, multipliers[k + 1].data(), stage.hessian);
  }
  QuadraticStage& stage = riccati_.stages()[last];
  stage.gradient[at_dt] += static_cast<double>(last);
  const std::array<double, 3> weights = problem.terminal_weights();
  for (std::size_t i = 0; i < 3; ++i) {
    if (weights[i] == 0.0) continue;
    const TerminalPair& t = at.terminal[i];
    const double over_side = weights[i] - t.multiplier;
    const double under_side = weights[i] + t.multiplier;
    const double sigma = 1.0 / (t.over / over_side + t.under / under_side);
    stage.gradient[i] += t.multiplier + sigma * (at.terminal_error[i] - barrier / over_side + barrier / under_side);
    stage.hessian[i][i] += sigma;
  }
}

void NewtonStep::solve(const BarrierProblem& barriers, const Point& at, double barrier) {
  const Problem& problem = barriers.problem();
  riccati_.solve();
  for (std::size_t k = 0; k < barriers.stage_count(); ++k) {
    const StageVector& w = riccati_.steps()[k];
    for (std::size_t i = barriers.first(k); i < barriers.first(k + 1); ++i) {
      const Constraint& c = at.constraints[i];
      const ConstraintPair& pair = at.pairs[i];
      ConstraintPair& step = pair_steps_[i];
      double change = 0.0;  // of the constraint's value
      for (std::size_t a = 0; a < stage_size; ++a) change += c.gradient[a] * w[a];
      if (c.is_elastic) {
        const double rest = problem.obstacle_weight - pair.multiplier;
        step.multiplier = (change + c.value + barrier / pair.multiplier - barrier / rest) /
                          (pair.slack / pair.multiplier + pair.excess / rest);
        step.excess = (barrier + pair.excess * step.multiplier) / rest - pair.excess;
        step.slack = (barrier - pair.slack * step.multiplier) / pair.multiplier - pair.slack;
      } else {
        step.multiplier = (change + c.value + barrier / pair.multiplier) * pair.multiplier / pair.slack;
        step.slack = -(c.value + pair.slack) - change;
        step.excess = 0.0;
      }
    }
  }
  const std::array<double, 3> weights = problem.terminal_weights();
  for (std::size_t i = 0; i < 3; ++i) {
    TerminalPair& step = terminal_steps_[i];
    step = {0.0, 0.0, 0.0};
    if (weights[i] == 0.0) continue;
    const TerminalPair& t = at.terminal[i];
    const double over_side = weights[i] - t.multiplier;
    const double under_side = weights[i] + t.multiplier;
    const double change = riccati_.steps().back()[i];
    step.multiplier = (change + at.terminal_error[i] - barrier / over_side + barrier / under_side) /
                      (t.over / over_side + t.under / under_side);
    step.over = (barrier + t.over * step.multiplier) / over_side - t.over;
    step.under = (barrier - t.under * step.multiplier) / under_side - t.under;
  }
}

double NewtonStep::largest_step(const BarrierProblem& barriers, const Point& at, double barrier, bool primal) const {
  const Problem& problem = barriers.problem();
  const double fraction = std::max(boundary_fraction, 1.0 - barrier);
  double step = 1.0;
  const auto keep_positive = [&](double value, double change) {
    if (change < 0.0) step = std::min(step, -fraction * value / change);
  };
  const double weight = problem.obstacle_weight;
  for (std::size_t i = 0; i < at.pairs.size(); ++i) {
    const ConstraintPair& pair = at.pairs[i];
    const ConstraintPair& change = pair_steps_[i];
    const bool is_elastic = at.constraints[i].is_elastic;
    if (primal) {
      keep_positive(pair.slack, change.slack);
      if (is_elastic) keep_positive(pair.excess, change.excess);
    } else {
      keep_positive(pair.multiplier, change.multiplier);
      if (is_elastic) keep_positive(weight - pair.multiplier, -change.multiplier);
    }
  }
  const std::array<double, 3> weights = problem.terminal_weights();
  for (std::size_t i = 0; i < 3; ++i) {
    if (weights[i] == 0.0) continue;
    const TerminalPair& t = at.terminal[i];
    const TerminalPair& change = terminal_steps_[i];
    if (primal) {
      keep_positive(t.over, change.over);
      keep_positive(t.under, change.under);
    } else {
      keep_positive(weights[i] - t.multiplier, -change.multiplier);
      keep_positive(weights[i] + t.multiplier, change.multiplier);
    }
  }
  return step;
}

double NewtonStep::slope(const BarrierProblem& barriers, const Point& at, double barrier) const {
  const Problem& problem = barriers.problem();
  double sum = static_cast<double>(at.trajectory.controls.size()) * riccati_.steps()[0][at_dt];
  for (std::size_t i = 0; i < at.pairs.size(); ++i) {
    const ConstraintPair& pair = at.pairs[i];
    sum -= barrier * pair_steps_[i].slack / pair.slack;
    if (!at.constraints[i].is_elastic) continue;
    sum += (problem.obstacle_weight - barrier / pair.excess) * pair_steps_[i].excess;
  }
  const std::array<double, 3> weights = problem.terminal_weights();
  for (std::size_t i = 0; i < 3; ++i) {
    if (weights[i] == 0.0) continue;
    const TerminalPair& t = at.terminal[i];
    sum += (weights[i] - barrier / t.over) * terminal_steps_[i].over;
    sum += (weights[i] - barrier / t.under) * terminal_steps_[i].under;
  }
  return sum;
}

void NewtonStep::move(double length, const Point& from, Point& to) const {
  for (std::size_t k = 0; k < from.trajectory.size(); ++k) {
    const StageVector& w = riccati_.steps()[k];
    const State& s = from.trajectory.states[k];
    to.trajectory.states[k] = {s.x + length * w[at_x], s.y + length * w[at_y], s.theta + length * w[at_theta]};
    if (k + 1 == from.trajectory.size()) break;
    const Control& u = from.trajectory.controls[k];
    to.trajectory.controls[k] = {u.v + length * w[at_v], u.omega + length * w[at_omega]};
  }
  to.trajectory.dt_s = from.trajectory.dt_s + length * riccati_.steps()[0][at_dt];
  for (std::size_t i = 0; i < from.pairs.size(); ++i) {
    to.pairs[i].slack = from.pairs[i].slack + length * pair_steps_[i].slack;
    to.pairs[i].excess = from.pairs[i].excess + length * pair_steps_[i].excess;
    to.pairs[i].multiplier = from.pairs[i].multiplier;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    to.terminal[i].over = from.terminal[i].over + length * terminal_steps_[i].over;
    to.terminal[i].under = from.terminal[i].under + length * terminal_steps_[i].under;
    to.terminal[i].multiplier = from.terminal[i].multiplier;
  }
}

void NewtonStep::move_multipliers(double primal_step, double dual_step, Point& point,
                                  std::vector<StateVector>& multipliers) const {
  for (std::size_t i = 0; i < point.pairs.size(); ++i)
    point.pairs[i].multiplier += dual_step * pair_steps_[i].multiplier;
  for (std::size_t i = 0; i < 3; ++i) point.terminal[i].multiplier += dual_step * terminal_steps_[i].multiplier;
  for (std::size_t k = 0; k < multipliers.size(); ++k)
    for (std::size_t i = 0; i < state_size; ++i)
      multipliers[k][i] += primal_step * (riccati_.multipliers()[k][i] - multipliers[k][i]);
}

}  // namespace dmrp::controllers::mpc
