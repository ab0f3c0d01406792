// SPDX-License-Identifier: MIT
// initial_guess.hpp: trajectories at which the solver starts.
#pragma once

#include <dmrp/cpp/local_controller.hpp>

#include "controllers/mpc/problem.hpp"

namespace dmrp::controllers::mpc {

// Builds trajectories from states with times, sampled at equal steps. Reuses its buffers.
class InitialGuess {
 public:
  void reserve(std::size_t points);

  // From the problem's start along the points (the first one is the robot's position on the path) to its goal, at the
  // speed limits. Turns in place at the start and at the goal if the headings differ much from the path's direction.
  void along(const Problem& problem, const std::vector<Vec2>& points, std::size_t states, Trajectory& out);

  // What is left of a trajectory after `elapsed_s`, from the problem's start to its goal: a straight leg joins the old
  // end to the new one.
  void shifted(const Problem& problem, double elapsed_s, Trajectory& trajectory);

  // The same trajectory with another number of states.
  void resized(const Problem& problem, std::size_t states, Trajectory& trajectory);

 private:
  struct Node {
    State state;
    double t_s;
  };
  void append(const State& state, double after_s) { nodes_.push_back({state, nodes_.back().t_s + after_s}); }
  void sample(const Problem& problem, std::size_t states, Trajectory& out) const;

  std::vector<Node> nodes_;
};

}  // namespace dmrp::controllers::mpc
