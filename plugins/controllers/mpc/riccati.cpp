// SPDX-License-Identifier: MIT
#include "controllers/mpc/riccati.hpp"

#include <cmath>

namespace dmrp::controllers::mpc {

namespace {

// Pivots below this count as not positive.
constexpr double least_pivot = 1e-10;

// Transition' x: a linear function of the next state, expressed in this stage's entries.
template <class Vector>
StageVector pull_back(const Transition& t, const Vector& next) {
  StageVector w;
  w[at_x] = next[at_x];
  w[at_y] = next[at_y];
  w[at_theta] = t.x_by_theta * next[at_x] + t.y_by_theta * next[at_y] + next[at_theta];
  w[at_v_before] = 0.0;
  w[at_omega_before] = 0.0;
  w[at_dt] = t.x_by_dt * next[at_x] + t.y_by_dt * next[at_y] + t.theta_by_dt * next[at_theta] + next[at_dt];
  w[at_v] = t.x_by_v * next[at_x] + t.y_by_v * next[at_y] + next[at_v_before] + t.theta_by_v * next[at_theta];
  w[at_omega] =
      t.x_by_omega * next[at_x] + t.y_by_omega * next[at_y] + t.theta_by_omega * next[at_theta] + next[at_omega_before];
  return w;
}

StateVector push_forward(const Transition& t, const StageVector& w) {
  StateVector next;
  next[at_x] = w[at_x] + t.x_by_theta * w[at_theta] + t.x_by_dt * w[at_dt] + t.x_by_v * w[at_v] +
               t.x_by_omega * w[at_omega] + t.defect[0];
  next[at_y] = w[at_y] + t.y_by_theta * w[at_theta] + t.y_by_dt * w[at_dt] + t.y_by_v * w[at_v] +
               t.y_by_omega * w[at_omega] + t.defect[1];
  next[at_theta] =
      w[at_theta] + t.theta_by_dt * w[at_dt] + t.theta_by_omega * w[at_omega] + t.defect[2] + t.theta_by_v * w[at_v];
  next[at_v_before] = w[at_v];
  next[at_omega_before] = w[at_omega];
  next[at_dt] = w[at_dt];
  return next;
}

// dt is one variable of the whole problem: it gets the shift at the last stage only.
bool takes_shift(std::size_t entry) {
  return entry == at_x || entry == at_y || entry == at_theta || entry == at_v || entry == at_omega;
}

}  // namespace

void RiccatiRecursion::reserve(std::size_t stages) {
  stages_.reserve(stages);
  cost_to_go_.reserve(stages);
  steps_.reserve(stages);
  multipliers_.reserve(stages);
}

void RiccatiRecursion::end_at(const QuadraticStage& stage, double shift, CostToGo& out) const {
  for (std::size_t i = 0; i < state_size; ++i) {
    for (std::size_t j = i; j < state_size; ++j) out.hessian[i][j] = out.hessian[j][i] = stage.hessian[i][j];
    if (takes_shift(i) || i == at_dt) out.hessian[i][i] += shift;
    out.gradient[i] = stage.gradient[i];
  }
}

bool RiccatiRecursion::step_back(const QuadraticStage& stage, double shift, const CostToGo& next, CostToGo& out) const {
  const Transition& t = stage.transition;
  // Q = hessian + T' P T, q = gradient + T' (P d + p)
  std::array<StageVector, state_size> half;  // rows of P T
  for (std::size_t i = 0; i < state_size; ++i) half[i] = pull_back(t, next.hessian[i]);
  StageMatrix q_matrix = stage.hessian;
  StageVector column_of_half;
  for (std::size_t j = 0; j < stage_size; ++j) {
    if (j == at_v_before || j == at_omega_before) continue;
    StateVector column;
    for (std::size_t i = 0; i < state_size; ++i) column[i] = half[i][j];
    column_of_half = pull_back(t, column);
    for (std::size_t i = 0; i <= j; ++i) q_matrix[i][j] += column_of_half[i];
    if (takes_shift(j)) q_matrix[j][j] += shift;
  }
  StateVector ahead = next.gradient;
  for (std::size_t i = 0; i < state_size; ++i)
    for (std::size_t d = 0; d < 3; ++d) ahead[i] += next.hessian[i][d] * t.defect[d];
  StageVector q = pull_back(t, ahead);
  for (std::size_t i = 0; i < stage_size; ++i) q[i] += stage.gradient[i];

  // the optimal control as a function of the state
  const double a = q_matrix[at_v][at_v];
  const double b = q_matrix[at_v][at_omega];
  const double c = q_matrix[at_omega][at_omega];
  const double rest = c - b * b / a;
  if (!(a > least_pivot) || !(rest > least_pivot)) return false;
  const auto best = [&](double v_side, double omega_side, double& v, double& omega) {
    omega = -(omega_side - b / a * v_side) / rest;
    v = -(v_side + b * omega) / a;
  };
  for (std::size_t i = 0; i < state_size; ++i)
    best(q_matrix[i][at_v], q_matrix[i][at_omega], out.feedback[0][i], out.feedback[1][i]);
  best(q[at_v], q[at_omega], out.feedforward[0], out.feedforward[1]);

  for (std::size_t i = 0; i < state_size; ++i) {
    for (std::size_t j = i; j < state_size; ++j) {
      const double p =
          q_matrix[i][j] + q_matrix[i][at_v] * out.feedback[0][j] + q_matrix[i][at_omega] * out.feedback[1][j];
      out.hessian[i][j] = out.hessian[j][i] = p;
    }
    out.gradient[i] = q[i] + q_matrix[i][at_v] * out.feedforward[0] + q_matrix[i][at_omega] * out.feedforward[1];
  }
  return true;
}

bool RiccatiRecursion::factor(double shift) {
  cost_to_go_.resize(stages_.size());
  end_at(stages_.back(), shift, cost_to_go_.back());
  for (std::size_t k = stages_.size() - 1; k-- > 0;)
    if (!step_back(stages_[k], shift, cost_to_go_[k + 1], cost_to_go_[k])) return false;
  // at the start only dt is free
  const double pivot = cost_to_go_[0].hessian[at_dt][at_dt];
  start_dt_ = -cost_to_go_[0].gradient[at_dt] / pivot;
  return pivot > least_pivot && std::isfinite(start_dt_);
}

void RiccatiRecursion::solve() {
  steps_.resize(stages_.size());
  multipliers_.resize(stages_.size());
  StateVector z = {};
  z[at_dt] = start_dt_;
  for (std::size_t k = 0; k < stages_.size(); ++k) {
    const CostToGo& go = cost_to_go_[k];
    for (std::size_t i = 0; i < state_size; ++i) {
      steps_[k][i] = z[i];
      multipliers_[k][i] = go.gradient[i];
      for (std::size_t j = 0; j < state_size; ++j) multipliers_[k][i] += go.hessian[i][j] * z[j];
    }
    const bool is_last = k + 1 == stages_.size();
    for (std::size_t c = 0; c < 2; ++c) {
      double& control = steps_[k][at_v + c];
      control = is_last ? 0.0 : go.feedforward[c];
      if (is_last) continue;
      for (std::size_t j = 0; j < state_size; ++j) control += go.feedback[c][j] * z[j];
    }
    if (!is_last) z = push_forward(stages_[k].transition, steps_[k]);
  }
}

}  // namespace dmrp::controllers::mpc
