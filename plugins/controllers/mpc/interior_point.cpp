// SPDX-License-Identifier: MIT
#include "controllers/mpc/interior_point.hpp"

#include <algorithm>
#include <cmath>

namespace dmrp::controllers::mpc {

namespace {

// Barrier reduction: min(factor * barrier, barrier^power), once the optimality error is below error_factor * barrier.
constexpr double barrier_factor = 0.2;
constexpr double barrier_power = 1.5;
constexpr double barrier_error_factor = 10.0;

// The shift added to the Hessian's diagonal if the reduced Hessian is not positive definite, or if the line search
// fails (along directions in which the duration does not change, the objective is flat and steps get too long).
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

}  // namespace

void InteriorPoint::reserve(std::size_t states, std::size_t constraints) {
  barriers_.reserve(states);
  step_.reserve(states, constraints);
  now_.reserve(states, constraints);
  next_.reserve(states, constraints);
  multipliers_.reserve(states);
  filter_.reserve(200);
}

SolverReport InteriorPoint::solve(const Problem& problem, const SolverSettings& settings, Trajectory& trajectory) {
  double barrier = settings.barrier_start;
  double shift = 0.0;
  bool converged = false;
  int iterations = 0;
  begin(problem, trajectory, barrier);
  for (; iterations < settings.iterations; ++iterations) {
    barrier = reduced_barrier(barrier, settings);
    converged = barrier <= settings.barrier_end &&
                barriers_.optimality_error(now_, multipliers_, settings.barrier_end) <= settings.tolerance;
    if (converged) break;
    step_.assemble(barriers_, now_, multipliers_, barrier);
    if (!advance(barrier, shift)) break;
    shift = shift > least_shift ? shift_decay * shift : 0.0;
  }
  trajectory = now_.trajectory;
  return report(converged, iterations);
}

void InteriorPoint::begin(const Problem& problem, const Trajectory& trajectory, double barrier) {
  barriers_.begin(problem, trajectory.size());
  for (Point* point : {&now_, &next_}) barriers_.place(trajectory, *point);
  barriers_.evaluate(now_);
  barriers_.center(barrier, now_);
  // zero multipliers of the transitions make the first step a convex problem
  multipliers_.assign(trajectory.size(), StateVector{});
  filter_.clear();
}

// Reduces the barrier as long as the point solves its barrier problem well enough.
double InteriorPoint::reduced_barrier(double barrier, const SolverSettings& settings) {
  while (barrier > settings.barrier_end &&
         barriers_.optimality_error(now_, multipliers_, barrier) <= barrier_error_factor * barrier) {
    barrier = std::max(settings.barrier_end, std::min(barrier_factor * barrier, std::pow(barrier, barrier_power)));
    filter_.clear();
  }
  return barrier;
}

// Moves along the Newton step; raises the shift until the line search accepts a step. False if it accepts none.
bool InteriorPoint::advance(double barrier, double& shift) {
  for (int i = 0; i < most_shifts; ++i) {
    if (i > 0) shift = std::max(first_shift, shift_growth * shift_growth * shift);
    while (!step_.factor(shift)) {
      shift = std::max(first_shift, shift_growth * shift);
      if (!(shift < greatest_shift)) return false;
    }
    step_.solve(barriers_, now_, barrier);
    if (search(barrier)) return true;
  }
  return false;
}

// Halves the step length until the filter accepts the point, and moves there. False if it accepts none.
bool InteriorPoint::search(double barrier) {
  double length = step_.largest_step(barriers_, now_, barrier, true);
  const Merit before = {barriers_.residual(now_), barriers_.value(now_, barrier)};
  const double slope = step_.slope(barriers_, now_, barrier);
  const double rounding = 1e-10 * (1.0 + std::abs(before.value));
  for (int i = 0; i <= most_halvings; ++i, length *= 0.5) {
    step_.move(length, now_, next_);
    barriers_.evaluate(next_);
    const Merit after = {barriers_.residual(next_), barriers_.value(next_, barrier)};
    if (!passes_filter(after)) continue;
    // a step that mainly promises a lower value must achieve it; any other must lower the residual or the value
    const bool is_descent =
        slope < 0.0 && std::pow(-slope * length, cost_power) > std::pow(before.residual, residual_power);
    if (is_descent ? after.value > before.value + sufficient_decrease * length * slope + rounding
                   : after.residual > (1.0 - filter_margin) * before.residual + 1e-12 &&
                         after.value > before.value - filter_margin * before.residual + rounding)
      continue;
    if (!is_descent)
      filter_.push_back({(1.0 - filter_margin) * before.residual, before.value - filter_margin * before.residual});
    const double dual_length = step_.largest_step(barriers_, now_, barrier, false);
    std::swap(now_, next_);
    step_.move_multipliers(length, dual_length, now_, multipliers_);
    return true;
  }
  return false;
}

bool InteriorPoint::passes_filter(const Merit& merit) const {
  return std::none_of(filter_.begin(), filter_.end(), [&](const Merit& forbidden) {
    return merit.residual >= forbidden.residual && merit.value >= forbidden.value;
  });
}

SolverReport InteriorPoint::report(bool converged, int iterations) const {
  const Problem& problem = barriers_.problem();
  SolverReport out;
  out.converged = converged;
  out.iterations = iterations;
  out.cost_s = now_.trajectory.duration_s();
  for (const Constraint& c : now_.constraints) {
    if (!c.is_elastic) continue;
    out.excess_m = std::max(out.excess_m, c.value);
    out.cost_s += problem.obstacle_weight * std::max(0.0, c.value);
  }
  const std::array<double, 3> weights = problem.terminal_weights();
  for (std::size_t i = 0; i < 3; ++i) out.cost_s += weights[i] * std::abs(now_.terminal_error[i]);
  out.terminal_error_m = std::hypot(now_.terminal_error[0], now_.terminal_error[1]);
  out.infeasibility = barriers_.residual(now_);
  return out;
}

}  // namespace dmrp::controllers::mpc
