// SPDX-License-Identifier: MIT
#include "controllers/mpc/barrier_problem.hpp"

#include <algorithm>
#include <cmath>

namespace dmrp::controllers::mpc {

namespace {

// The least initial slack of a constraint.
double least_slack(double barrier) {
  return 0.1 * std::sqrt(barrier);
}

}  // namespace

void BarrierProblem::begin(const Problem& problem, std::size_t stages) {
  problem_ = &problem;
  first_.resize(stages + 1);
  first_[0] = 0;
  for (std::size_t k = 0; k < stages; ++k) first_[k + 1] = first_[k] + problem.constraint_count(stages, k);
}

void BarrierProblem::place(const Trajectory& trajectory, Point& point) const {
  point.trajectory = trajectory;
  point.pairs.resize(constraint_count());
  point.constraints.resize(constraint_count());
  point.transitions.resize(stage_count() - 1);
}

void BarrierProblem::evaluate(Point& point) const {
  const Trajectory& trajectory = point.trajectory;
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    const StageVector w = problem_->stage(trajectory, k);
    problem_->constraints(trajectory.size(), k, w, point.constraints.data() + first_[k]);
    if (k + 1 < trajectory.size()) point.transitions[k] = problem_->transition(w, trajectory.states[k + 1]);
  }
  point.terminal_error = problem_->terminal_error(trajectory.states.back());
}

void BarrierProblem::center(double barrier, Point& point) const {
  const double mu = barrier;
  const double weight = problem_->obstacle_weight;
  for (std::size_t i = 0; i < point.pairs.size(); ++i) {
    const Constraint& c = point.constraints[i];
    ConstraintPair& pair = point.pairs[i];
    pair.excess = 0.0;
    if (c.is_elastic) {
      // the excess that minimises weight * excess - mu log(excess) - mu log(excess - value)
      const double h = weight * c.value;
      pair.excess = (h + 2.0 * mu + std::sqrt(h * h + 4.0 * mu * mu)) / (2.0 * weight);
      pair.slack = pair.excess - c.value;
    } else {
      pair.slack = std::max(-c.value, least_slack(mu));
    }
    pair.multiplier = mu / pair.slack;
  }
  const std::array<double, 3> weights = problem_->terminal_weights();
  for (std::size_t i = 0; i < 3; ++i) {
    TerminalPair& terminal = point.terminal[i];
    terminal = {};
    if (weights[i] == 0.0) continue;
    const double e = weights[i] * point.terminal_error[i];
    terminal.over = (e + mu + std::sqrt(e * e + mu * mu)) / (2.0 * weights[i]);
    terminal.under = terminal.over - point.terminal_error[i];
    terminal.multiplier = weights[i] - mu / terminal.over;
  }
}

double BarrierProblem::residual(const Point& point) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < point.pairs.size(); ++i) {
    const ConstraintPair& pair = point.pairs[i];
    sum += std::abs(point.constraints[i].value + pair.slack - pair.excess);
  }
  for (const Transition& t : point.transitions)
    for (const double defect : t.defect) sum += std::abs(defect);
  const std::array<double, 3> weights = problem_->terminal_weights();
  for (std::size_t i = 0; i < 3; ++i)
    if (weights[i] > 0.0) sum += std::abs(point.terminal_error[i] - point.terminal[i].over + point.terminal[i].under);
  return sum;
}

double BarrierProblem::value(const Point& point, double barrier) const {
  double cost = point.trajectory.duration_s();
  double logarithms = 0.0;
  for (std::size_t i = 0; i < point.pairs.size(); ++i) {
    const ConstraintPair& pair = point.pairs[i];
    logarithms += std::log(pair.slack);
    if (!point.constraints[i].is_elastic) continue;
    logarithms += std::log(pair.excess);
    cost += problem_->obstacle_weight * pair.excess;
  }
  const std::array<double, 3> weights = problem_->terminal_weights();
  for (std::size_t i = 0; i < 3; ++i) {
    if (weights[i] == 0.0) continue;
    const TerminalPair& t = point.terminal[i];
    cost += weights[i] * (t.over + t.under);
    logarithms += std::log(t.over) + std::log(t.under);
  }
  return cost - barrier * logarithms;
}

double BarrierProblem::optimality_error(const Point& point, const std::vector<StateVector>& multipliers,
                                        double barrier) const {
  double worst = 0.0;
  const auto see = [&worst](double value) { worst = std::max(worst, std::abs(value)); };
  const std::size_t stages = point.trajectory.size();
  for (std::size_t k = 0; k < stages; ++k) {
    StageVector gradient = {};
    for (std::size_t i = first_[k]; i < first_[k + 1]; ++i) {
      const Constraint& c = point.constraints[i];
      const ConstraintPair& pair = point.pairs[i];
      for (std::size_t a = 0; a < stage_size; ++a) gradient[a] += pair.multiplier * c.gradient[a];
      see(c.value + pair.slack - pair.excess);
      see(pair.slack * pair.multiplier - barrier);
      if (c.is_elastic) see(pair.excess * (problem_->obstacle_weight - pair.multiplier) - barrier);
    }
    if (k + 1 < stages) {
      const Transition& t = point.transitions[k];
      const StateVector& y = multipliers[k + 1];
      gradient[at_x] += y[at_x];
      gradient[at_y] += y[at_y];
      gradient[at_theta] += t.x_by_theta * y[at_x] + t.y_by_theta * y[at_y] + y[at_theta];
      gradient[at_dt] += t.x_by_dt * y[at_x] + t.y_by_dt * y[at_y] + t.theta_by_dt * y[at_theta] + y[at_dt];
      see(gradient[at_v] + t.x_by_v * y[at_x] + t.y_by_v * y[at_y] + y[at_v_before] + t.theta_by_v * y[at_theta]);
      see(gradient[at_omega] + t.x_by_omega * y[at_x] + t.y_by_omega * y[at_y] + t.theta_by_omega * y[at_theta] +
          y[at_omega_before]);
      for (const double defect : t.defect) see(defect);
    } else {
      gradient[at_dt] += static_cast<double>(stages - 1);
      for (std::size_t i = 0; i < 3; ++i) gradient[i] += point.terminal[i].multiplier;
    }
    if (k == 0) {
      see(gradient[at_dt]);
      continue;
    }
    for (std::size_t a = 0; a < state_size; ++a) see(gradient[a] - multipliers[k][a]);
  }
  const std::array<double, 3> weights = problem_->terminal_weights();
  for (std::size_t i = 0; i < 3; ++i) {
    if (weights[i] == 0.0) continue;
    const TerminalPair& t = point.terminal[i];
    see(point.terminal_error[i] - t.over + t.under);
    see(t.over * (weights[i] - t.multiplier) - barrier);
    see(t.under * (weights[i] + t.multiplier) - barrier);
  }
  return worst;
}

}  // namespace dmrp::controllers::mpc
