// SPDX-License-Identifier: MIT
#include "controllers/mpc/interior_point.hpp"

#include <algorithm>
#include <cmath>

namespace dmrp::controllers::mpc {

namespace {

// Barrier reduction: min(share * barrier, barrier^power), once the error is below factor * barrier.
constexpr double barrier_share = 0.2;
constexpr double barrier_power = 1.5;
constexpr double barrier_error_factor = 10.0;

// A step takes at most this much of the way to where a slack or a multiplier would be zero.
constexpr double boundary_share = 0.99;

// What is added to the Hessian's diagonal: where it is not convex, and where the step is too long for the linear model
// (directions in which the time does not change are flat).
constexpr double first_shift = 1e-4;
constexpr double shift_growth = 8.0;
constexpr double shift_decay = 1.0 / 5.0;
constexpr double least_shift = 1e-7;
constexpr double greatest_shift = 1e8;

// Line search.
constexpr double sufficient_decrease = 1e-4;
constexpr double filter_margin = 1e-5;
constexpr double cost_power = 2.3;
constexpr double residual_power = 1.1;
constexpr int most_halvings = 3;
constexpr int most_shifts = 5;

// What an inactive constraint's slack is at least as the solution begins.
double least_slack(double barrier) {
  return 0.1 * std::sqrt(barrier);
}

}  // namespace

void InteriorPoint::reserve(std::size_t states, std::size_t constraints) {
  riccati_.reserve(states);
  first_.reserve(states + 1);
  multipliers_.reserve(states);
  pair_steps_.reserve(constraints);
  filter_.reserve(200);
  for (Point* point : {&now_, &next_}) {
    point->trajectory.reserve(states);
    point->pairs.reserve(constraints);
    point->constraints.reserve(constraints);
    point->transitions.reserve(states);
  }
}

void InteriorPoint::evaluate(Point& point) const {
  const Trajectory& trajectory = point.trajectory;
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    const StageVector w = problem_->stage(trajectory, k);
    problem_->constraints(trajectory.size(), k, w, point.constraints.data() + first_[k]);
    if (k + 1 < trajectory.size()) point.transitions[k] = problem_->transition(w, trajectory.states[k + 1]);
  }
  point.terminal_error = problem_->terminal_error(trajectory.states.back());
}

// Slacks and multipliers on the central path of the first barrier, as far as the trajectory allows.
void InteriorPoint::begin(const Trajectory& trajectory) {
  const std::size_t stages = trajectory.size();
  first_.resize(stages + 1);
  first_[0] = 0;
  for (std::size_t k = 0; k < stages; ++k) first_[k + 1] = first_[k] + problem_->constraint_count(stages, k);
  for (Point* point : {&now_, &next_}) {
    point->trajectory = trajectory;
    point->pairs.resize(first_[stages]);
    point->constraints.resize(first_[stages]);
    point->transitions.resize(stages - 1);
  }
  pair_steps_.resize(first_[stages]);
  riccati_.stages().resize(stages);
  evaluate(now_);

  const double mu = barrier_;
  const double weight = problem_->obstacle_weight;
  for (std::size_t i = 0; i < now_.pairs.size(); ++i) {
    const Constraint& c = now_.constraints[i];
    Pair& pair = now_.pairs[i];
    pair.excess = 0.0;
    if (c.is_elastic) {
      // minimises weight * excess - mu log(excess) - mu log(excess - value)
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
    Terminal& terminal = now_.terminal[i];
    terminal = {};
    if (weights[i] == 0.0) continue;
    const double e = weights[i] * now_.terminal_error[i];
    terminal.over = (e + mu + std::sqrt(e * e + mu * mu)) / (2.0 * weights[i]);
    terminal.under = terminal.over - now_.terminal_error[i];
    terminal.multiplier = weights[i] - mu / terminal.over;
  }
  // those of the transitions follow from the rest, at best; zero makes the first step a convex one
  multipliers_.assign(stages, StateVector{});
}

void InteriorPoint::assemble_stage(std::size_t k) {
  QuadraticStage& stage = riccati_.stages()[k];
  stage.hessian = {};
  stage.gradient = {};
  for (std::size_t i = first_[k]; i < first_[k + 1]; ++i) {
    const Constraint& c = now_.constraints[i];
    const Pair& pair = now_.pairs[i];
    double inverse = pair.slack / pair.multiplier;
    double offset = c.value + barrier_ / pair.multiplier;
    if (c.is_elastic) {
      const double rest = problem_->obstacle_weight - pair.multiplier;
      inverse += pair.excess / rest;
      offset -= barrier_ / rest;
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

void InteriorPoint::assemble() {
  const std::size_t last = riccati_.stages().size() - 1;
  for (std::size_t k = 0; k <= last; ++k) {
    assemble_stage(k);
    if (k == last) break;
    QuadraticStage& stage = riccati_.stages()[k];
    stage.transition = now_.transitions[k];
    const StageVector w = problem_->stage(now_.trajectory, k);
    problem_->add_transition_curvature(w, multipliers_[k + 1].data(), stage.hessian);
  }
  QuadraticStage& stage = riccati_.stages()[last];
  stage.gradient[at_dt] += static_cast<double>(last);
  const std::array<double, 3> weights = problem_->terminal_weights();
  for (std::size_t i = 0; i < 3; ++i) {
    if (weights[i] == 0.0) continue;
    const Terminal& t = now_.terminal[i];
    const double over_side = weights[i] - t.multiplier;
    const double under_side = weights[i] + t.multiplier;
    const double sigma = 1.0 / (t.over / over_side + t.under / under_side);
    stage.gradient[i] += t.multiplier + sigma * (now_.terminal_error[i] - barrier_ / over_side + barrier_ / under_side);
    stage.hessian[i][i] += sigma;
  }
}

// Shifts the Hessian until it is convex where it counts. False where nothing helps.
bool InteriorPoint::factor() {
  while (!riccati_.factor(shift_)) {
    shift_ = std::max(first_shift, shift_growth * shift_);
    if (!(shift_ < greatest_shift)) return false;
  }
  return true;
}

void InteriorPoint::find_steps() {
  riccati_.solve();
  for (std::size_t k = 0; k + 1 < first_.size(); ++k) {
    const StageVector& w = riccati_.steps()[k];
    for (std::size_t i = first_[k]; i < first_[k + 1]; ++i) {
      const Constraint& c = now_.constraints[i];
      const Pair& pair = now_.pairs[i];
      PairStep& step = pair_steps_[i];
      double change = 0.0;  // of the value
      for (std::size_t a = 0; a < stage_size; ++a) change += c.gradient[a] * w[a];
      if (c.is_elastic) {
        const double rest = problem_->obstacle_weight - pair.multiplier;
        step.multiplier = (change + c.value + barrier_ / pair.multiplier - barrier_ / rest) /
                          (pair.slack / pair.multiplier + pair.excess / rest);
        step.excess = (barrier_ + pair.excess * step.multiplier) / rest - pair.excess;
        step.slack = (barrier_ - pair.slack * step.multiplier) / pair.multiplier - pair.slack;
      } else {
        step.multiplier = (change + c.value + barrier_ / pair.multiplier) * pair.multiplier / pair.slack;
        step.slack = -(c.value + pair.slack) - change;
        step.excess = 0.0;
      }
    }
  }
  const std::array<double, 3> weights = problem_->terminal_weights();
  for (std::size_t i = 0; i < 3; ++i) {
    PairStep& step = terminal_steps_[i];
    step = {};
    if (weights[i] == 0.0) continue;
    const Terminal& t = now_.terminal[i];
    const double over_side = weights[i] - t.multiplier;
    const double under_side = weights[i] + t.multiplier;
    const double change = riccati_.steps().back()[i];
    step.multiplier = (change + now_.terminal_error[i] - barrier_ / over_side + barrier_ / under_side) /
                      (t.over / over_side + t.under / under_side);
    step.slack = (barrier_ + t.over * step.multiplier) / over_side - t.over;
    step.excess = (barrier_ - t.under * step.multiplier) / under_side - t.under;
  }
}

double InteriorPoint::largest_step(bool primal) const {
  const double share = std::max(boundary_share, 1.0 - barrier_);
  double step = 1.0;
  const auto keep_positive = [&](double value, double change) {
    if (change < 0.0) step = std::min(step, -share * value / change);
  };
  const double weight = problem_->obstacle_weight;
  for (std::size_t i = 0; i < now_.pairs.size(); ++i) {
    const Pair& pair = now_.pairs[i];
    const PairStep& change = pair_steps_[i];
    const bool is_elastic = now_.constraints[i].is_elastic;
    if (primal) {
      keep_positive(pair.slack, change.slack);
      if (is_elastic) keep_positive(pair.excess, change.excess);
    } else {
      keep_positive(pair.multiplier, change.multiplier);
      if (is_elastic) keep_positive(weight - pair.multiplier, -change.multiplier);
    }
  }
  const std::array<double, 3> weights = problem_->terminal_weights();
  for (std::size_t i = 0; i < 3; ++i) {
    if (weights[i] == 0.0) continue;
    const Terminal& t = now_.terminal[i];
    const PairStep& change = terminal_steps_[i];
    if (primal) {
      keep_positive(t.over, change.slack);
      keep_positive(t.under, change.excess);
    } else {
      keep_positive(weights[i] - t.multiplier, -change.multiplier);
      keep_positive(weights[i] + t.multiplier, change.multiplier);
    }
  }
  return step;
}

double InteriorPoint::residual(const Point& point) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < point.pairs.size(); ++i) {
    const Pair& pair = point.pairs[i];
    sum += std::abs(point.constraints[i].value + pair.slack - pair.excess);
  }
  for (const Transition& t : point.transitions)
    for (const double defect : t.defect) sum += std::abs(defect);
  const std::array<double, 3> weights = problem_->terminal_weights();
  for (std::size_t i = 0; i < 3; ++i)
    if (weights[i] > 0.0) sum += std::abs(point.terminal_error[i] - point.terminal[i].over + point.terminal[i].under);
  return sum;
}

double InteriorPoint::barrier_value(const Point& point) const {
  double cost = point.trajectory.duration_s();
  double logarithms = 0.0;
  for (std::size_t i = 0; i < point.pairs.size(); ++i) {
    const Pair& pair = point.pairs[i];
    logarithms += std::log(pair.slack);
    if (!point.constraints[i].is_elastic) continue;
    logarithms += std::log(pair.excess);
    cost += problem_->obstacle_weight * pair.excess;
  }
  const std::array<double, 3> weights = problem_->terminal_weights();
  for (std::size_t i = 0; i < 3; ++i) {
    if (weights[i] == 0.0) continue;
    const Terminal& t = point.terminal[i];
    cost += weights[i] * (t.over + t.under);
    logarithms += std::log(t.over) + std::log(t.under);
  }
  return cost - barrier_ * logarithms;
}

double InteriorPoint::slope() const {
  double sum = static_cast<double>(now_.trajectory.controls.size()) * riccati_.steps()[0][at_dt];
  for (std::size_t i = 0; i < now_.pairs.size(); ++i) {
    const Pair& pair = now_.pairs[i];
    sum -= barrier_ * pair_steps_[i].slack / pair.slack;
    if (!now_.constraints[i].is_elastic) continue;
    sum += (problem_->obstacle_weight - barrier_ / pair.excess) * pair_steps_[i].excess;
  }
  const std::array<double, 3> weights = problem_->terminal_weights();
  for (std::size_t i = 0; i < 3; ++i) {
    if (weights[i] == 0.0) continue;
    const Terminal& t = now_.terminal[i];
    sum += (weights[i] - barrier_ / t.over) * terminal_steps_[i].slack;
    sum += (weights[i] - barrier_ / t.under) * terminal_steps_[i].excess;
  }
  return sum;
}

void InteriorPoint::move(double step, const Point& from, Point& to) const {
  for (std::size_t k = 0; k < from.trajectory.size(); ++k) {
    const StageVector& w = riccati_.steps()[k];
    const State& s = from.trajectory.states[k];
    to.trajectory.states[k] = {s.x + step * w[at_x], s.y + step * w[at_y], s.theta + step * w[at_theta]};
    if (k + 1 == from.trajectory.size()) break;
    const Control& u = from.trajectory.controls[k];
    to.trajectory.controls[k] = {u.v + step * w[at_v], u.omega + step * w[at_omega]};
  }
  to.trajectory.dt_s = from.trajectory.dt_s + step * riccati_.steps()[0][at_dt];
  for (std::size_t i = 0; i < from.pairs.size(); ++i) {
    to.pairs[i].slack = from.pairs[i].slack + step * pair_steps_[i].slack;
    to.pairs[i].excess = from.pairs[i].excess + step * pair_steps_[i].excess;
    to.pairs[i].multiplier = from.pairs[i].multiplier;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    to.terminal[i].over = from.terminal[i].over + step * terminal_steps_[i].slack;
    to.terminal[i].under = from.terminal[i].under + step * terminal_steps_[i].excess;
    to.terminal[i].multiplier = from.terminal[i].multiplier;
  }
}

bool InteriorPoint::passes_filter(const Merit& merit) const {
  return std::none_of(filter_.begin(), filter_.end(), [&](const Merit& forbidden) {
    return merit.residual >= forbidden.residual && merit.value >= forbidden.value;
  });
}

// Backtracks from the longest step until the filter takes it, and moves. False where it takes none: stays.
bool InteriorPoint::search() {
  double step = largest_step(true);
  const Merit before = {residual(now_), barrier_value(now_)};
  const double rise = slope();
  const double rounding = 1e-10 * (1.0 + std::abs(before.value));
  for (int i = 0; i <= most_halvings; ++i, step *= 0.5) {
    move(step, now_, next_);
    evaluate(next_);
    const Merit after = {residual(next_), barrier_value(next_)};
    if (!passes_filter(after)) continue;
    // where the step promises less cost rather than less infeasibility, it has to keep that
    const bool is_descent =
        rise < 0.0 && std::pow(-rise * step, cost_power) > std::pow(before.residual, residual_power);
    if (is_descent ? after.value > before.value + sufficient_decrease * step * rise + rounding
                   : after.residual > (1.0 - filter_margin) * before.residual + 1e-12 &&
                         after.value > before.value - filter_margin * before.residual + rounding)
      continue;
    if (!is_descent)
      filter_.push_back({(1.0 - filter_margin) * before.residual, before.value - filter_margin * before.residual});
    const double dual_step = largest_step(false);
    std::swap(now_, next_);
    move_multipliers(step, dual_step);
    return true;
  }
  return false;
}

void InteriorPoint::move_multipliers(double primal_step, double dual_step) {
  for (std::size_t i = 0; i < now_.pairs.size(); ++i) now_.pairs[i].multiplier += dual_step * pair_steps_[i].multiplier;
  for (std::size_t i = 0; i < 3; ++i) now_.terminal[i].multiplier += dual_step * terminal_steps_[i].multiplier;
  for (std::size_t k = 0; k < multipliers_.size(); ++k)
    for (std::size_t i = 0; i < state_size; ++i)
      multipliers_[k][i] += primal_step * (riccati_.multipliers()[k][i] - multipliers_[k][i]);
}

// The greatest residual of the optimality conditions (equation 5 of Wächter and Biegler, without its scaling).
double InteriorPoint::optimality_error(double barrier) const {
  double worst = 0.0;
  const auto see = [&worst](double value) { worst = std::max(worst, std::abs(value)); };
  const std::size_t stages = now_.trajectory.size();
  for (std::size_t k = 0; k < stages; ++k) {
    StageVector gradient = {};
    for (std::size_t i = first_[k]; i < first_[k + 1]; ++i) {
      const Constraint& c = now_.constraints[i];
      const Pair& pair = now_.pairs[i];
      for (std::size_t a = 0; a < stage_size; ++a) gradient[a] += pair.multiplier * c.gradient[a];
      see(c.value + pair.slack - pair.excess);
      see(pair.slack * pair.multiplier - barrier);
      if (c.is_elastic) see(pair.excess * (problem_->obstacle_weight - pair.multiplier) - barrier);
    }
    if (k + 1 < stages) {
      const Transition& t = now_.transitions[k];
      const StateVector& y = multipliers_[k + 1];
      gradient[at_x] += y[at_x];
      gradient[at_y] += y[at_y];
      gradient[at_theta] += t.x_by_theta * y[at_x] + t.y_by_theta * y[at_y] + y[at_theta];
      gradient[at_dt] += t.x_by_dt * y[at_x] + t.y_by_dt * y[at_y] + t.theta_by_dt * y[at_theta] + y[at_dt];
      see(gradient[at_v] + t.x_by_v * y[at_x] + t.y_by_v * y[at_y] + y[at_v_before]);
      see(gradient[at_omega] + t.theta_by_omega * y[at_theta] + y[at_omega_before]);
      for (const double defect : t.defect) see(defect);
    } else {
      gradient[at_dt] += static_cast<double>(stages - 1);
      for (std::size_t i = 0; i < 3; ++i) gradient[i] += now_.terminal[i].multiplier;
    }
    if (k == 0) {
      see(gradient[at_dt]);
      continue;
    }
    for (std::size_t a = 0; a < state_size; ++a) see(gradient[a] - multipliers_[k][a]);
  }
  const std::array<double, 3> weights = problem_->terminal_weights();
  for (std::size_t i = 0; i < 3; ++i) {
    if (weights[i] == 0.0) continue;
    const Terminal& t = now_.terminal[i];
    see(now_.terminal_error[i] - t.over + t.under);
    see(t.over * (weights[i] - t.multiplier) - barrier);
    see(t.under * (weights[i] + t.multiplier) - barrier);
  }
  return worst;
}

SolverReport InteriorPoint::report(bool converged, int iterations) const {
  SolverReport out;
  out.converged = converged;
  out.iterations = iterations;
  out.cost_s = now_.trajectory.duration_s();
  for (const Constraint& c : now_.constraints) {
    if (!c.is_elastic) continue;
    out.excess_m = std::max(out.excess_m, c.value);
    out.cost_s += problem_->obstacle_weight * std::max(0.0, c.value);
  }
  const std::array<double, 3> weights = problem_->terminal_weights();
  for (std::size_t i = 0; i < 3; ++i) out.cost_s += weights[i] * std::abs(now_.terminal_error[i]);
  out.terminal_error_m = std::hypot(now_.terminal_error[0], now_.terminal_error[1]);
  out.infeasibility = residual(now_);
  return out;
}

SolverReport InteriorPoint::solve(const Problem& problem, const SolverSettings& settings, Trajectory& trajectory) {
  problem_ = &problem;
  barrier_ = settings.barrier_start;
  filter_.clear();
  shift_ = 0.0;
  begin(trajectory);
  bool converged = false;
  int iterations = 0;
  for (; iterations < settings.iterations; ++iterations) {
    while (barrier_ > settings.barrier_end && optimality_error(barrier_) <= barrier_error_factor * barrier_) {
      barrier_ = std::max(settings.barrier_end, std::min(barrier_share * barrier_, std::pow(barrier_, barrier_power)));
      filter_.clear();
    }
    converged = barrier_ <= settings.barrier_end && optimality_error(settings.barrier_end) <= settings.tolerance;
    if (converged) break;
    assemble();
    bool moved = false;
    for (int i = 0; i < most_shifts && !moved; ++i) {
      if (i > 0) shift_ = std::max(first_shift, shift_growth * shift_growth * shift_);
      if (!factor()) break;
      find_steps();
      moved = search();
    }
    if (!moved) break;
    shift_ = shift_ > least_shift ? shift_decay * shift_ : 0.0;
  }
  trajectory = now_.trajectory;
  return report(converged, iterations);
}

}  // namespace dmrp::controllers::mpc
