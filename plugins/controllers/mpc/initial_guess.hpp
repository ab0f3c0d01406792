// SPDX-License-Identifier: MIT
// initial_guess.hpp: trajectories to start the solver from.
#ifndef DMRP_CONTROLLERS_MPC_INITIAL_GUESS_HPP
#define DMRP_CONTROLLERS_MPC_INITIAL_GUESS_HPP

#include <dmrp/values.h>

#include "controllers/mpc/problem.hpp"

namespace dmrp::controllers::mpc {

// Poses with the times at which they are passed; nothing allocates once the buffers have grown.
class InitialGuess {
 public:
  void reserve(std::size_t points);

  // From the problem's start along the points (the first is the robot's place on the path) to its goal, each leg as
  // fast as the limits of speed allow; turns on the spot where the way does not begin or end in the robot's heading.
  void along(const Problem& problem, const std::vector<dmrp_vec2>& points, std::size_t states, Trajectory& out);

  // What is left of a trajectory `elapsed_s` later, from the problem's start to its goal: the old end is tied to the
  // new one by a straight leg.
  void shifted(const Problem& problem, double elapsed_s, Trajectory& trajectory);

  // The same trajectory on another number of states.
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

#endif
