// SPDX-License-Identifier: MIT
#include "controllers/mpc/initial_guess.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "controllers/motion/drive_ability.hpp"

namespace dmrp::controllers::mpc {

namespace {

// Skips points closer to the previous one or to the goal: their direction is unreliable.
constexpr double near_m = 0.25;

// Larger turns are made in place.
constexpr double sharp_rad = 0.5;

double distance(const State& a, const State& b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

// Leads from `a` to `b` in `dt_s`, without the limits.
double second_control(const Problem& problem, const State& a, const State& b, double dt_s) {
  const double turned = b.theta - a.theta;
  if (problem.keeps_heading) return ((b.y - a.y) * std::cos(a.theta) - (b.x - a.x) * std::sin(a.theta)) / dt_s;
  if (!problem.is_car_like()) return turned / dt_s;
  const double ahead_m = (b.x - a.x) * std::cos(a.theta) + (b.y - a.y) * std::sin(a.theta);
  return std::atan(turned * problem.wheelbase_m / std::max(std::abs(ahead_m), 1e-3));
}

// The angle closest to `near_to` with the direction `angle`.
double unwrapped(double angle, double near_to) {
  return near_to + toolkit::difference(near_to, angle);
}

}  // namespace

void InitialGuess::reserve(std::size_t points) {
  nodes_.reserve(2 * points);
}

void InitialGuess::along(const Problem& problem, const std::vector<Vec2>& points, std::size_t states, Trajectory& out) {
  nodes_.clear();
  nodes_.push_back({problem.start, 0.0});
  const auto turn_to = [&](double theta) {
    State turned = nodes_.back().state;
    const double angle = theta - turned.theta;
    turned.theta = theta;
    append(turned, std::abs(angle) / problem.fastest_turn());
  };
  // a car-like robot turns along its tightest arc
  const auto drive_arc_to = [&](const State& to) {
    const double radius_m = problem.wheelbase_m / std::tan(problem.omega_max);
    face_by_arc(nodes_.back().state, {to.x, to.y}, radius_m, sharp_rad, [&](const State& state, double length_m) {
      append(state, std::max(length_m / problem.v_max, length_m / radius_m / problem.fastest_turn()));
    });
  };
  for (std::size_t i = 1; i <= points.size(); ++i) {
    const bool is_goal = i == points.size();
    State next = is_goal ? problem.goal : State{points[i].x, points[i].y, 0.0};
    if (problem.is_car_like() && i == 1) drive_arc_to(next);
    if (problem.keeps_heading) next.theta = problem.start.theta;
    const State last = nodes_.back().state;
    const double leg_m = distance(last, next);
    const double to_goal_m = distance(next, problem.goal);
    if (!is_goal && (leg_m < near_m || to_goal_m < near_m)) continue;
    if (leg_m < 1e-3) continue;
    if (problem.keeps_heading) {
      append(next, leg_m / problem.v_max);
      continue;
    }
    next.theta = unwrapped(std::atan2(next.y - last.y, next.x - last.x), last.theta);
    if (nodes_.size() == 1 && !problem.is_car_like() && std::abs(next.theta - last.theta) > sharp_rad)
      turn_to(next.theta);
    const double turn = std::abs(next.theta - nodes_.back().state.theta);
    append(next, std::max(leg_m / problem.v_max, turn / problem.fastest_turn()));
  }
  if (problem.fixes_heading) {
    const double theta = unwrapped(problem.goal.theta, nodes_.back().state.theta);
    if (!problem.is_car_like() && std::abs(theta - nodes_.back().state.theta) > sharp_rad)
      turn_to(theta);
    else if (nodes_.size() > 1)
      nodes_.back().state.theta = theta;
  }
  sample(problem, states, out);
}

void InitialGuess::shifted(const Problem& problem, double elapsed_s, Trajectory& trajectory) {
  nodes_.clear();
  nodes_.push_back({problem.start, 0.0});
  const std::size_t states = trajectory.size();
  const double turns =
      problem.start.theta -
      between(trajectory.states[0], trajectory.states[1], std::min(1.0, elapsed_s / trajectory.dt_s)).theta;
  const double whole_turns = 2.0 * toolkit::pi * std::round(turns / (2.0 * toolkit::pi));
  for (std::size_t k = 1; k < states; ++k) {
    const double t_s = static_cast<double>(k) * trajectory.dt_s - elapsed_s;
    // a state right after the start would force the prediction error to vanish within that short time
    if (t_s < 0.5 * trajectory.dt_s && k + 1 < states) continue;
    State state = trajectory.states[k];
    state.theta += whole_turns;
    nodes_.push_back({state, std::max(t_s, 1e-3)});
  }
  State end = problem.goal;
  const State& last = nodes_.back().state;
  const double leg_m = distance(last, end);
  end.theta = problem.fixes_heading ? unwrapped(end.theta, last.theta) : last.theta;
  append(end, std::max(leg_m / problem.v_max, std::abs(end.theta - last.theta) / problem.fastest_turn()));
  sample(problem, states, trajectory);
}

void InitialGuess::resized(const Problem& problem, std::size_t states, Trajectory& trajectory) {
  nodes_.clear();
  for (std::size_t k = 0; k < trajectory.size(); ++k)
    nodes_.push_back({trajectory.states[k], static_cast<double>(k) * trajectory.dt_s});
  sample(problem, states, trajectory);
}

// Samples the nodes at equal time steps; the controls lead from each state to the next as closely as the limits allow.
void InitialGuess::sample(const Problem& problem, std::size_t states, Trajectory& out) const {
  const double whole_s = std::max(nodes_.back().t_s, 1e-2 * static_cast<double>(states - 1));
  out.dt_s = std::clamp(whole_s / static_cast<double>(states - 1), problem.dt_min_s, problem.dt_max_s);
  out.states.resize(states);
  out.controls.resize(states - 1);
  std::size_t node = 0;
  for (std::size_t k = 0; k < states; ++k) {
    const double t_s = static_cast<double>(k) * whole_s / static_cast<double>(states - 1);
    while (node + 2 < nodes_.size() && nodes_[node + 1].t_s <= t_s) ++node;
    if (node + 1 >= nodes_.size()) {
      out.states[k] = nodes_.back().state;
      continue;
    }
    const Node& a = nodes_[node];
    const Node& b = nodes_[node + 1];
    const double span_s = b.t_s - a.t_s;
    out.states[k] = between(a.state, b.state, span_s > 0.0 ? std::clamp((t_s - a.t_s) / span_s, 0.0, 1.0) : 1.0);
  }
  for (std::size_t k = 0; k + 1 < states; ++k) {
    const State& a = out.states[k];
    const State& b = out.states[k + 1];
    const double ahead_m = (b.x - a.x) * std::cos(a.theta) + (b.y - a.y) * std::sin(a.theta);
    out.controls[k] = {std::clamp(ahead_m / out.dt_s, problem.v_min, problem.v_max),
                       std::clamp(second_control(problem, a, b, out.dt_s), -problem.omega_max, problem.omega_max)};
  }
}

}  // namespace dmrp::controllers::mpc
