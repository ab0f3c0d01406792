// SPDX-License-Identifier: MIT
// trajectory.hpp: poses and controls of a unicycle on a grid of equal time steps.
#ifndef DMRP_CONTROLLERS_MPC_TRAJECTORY_HPP
#define DMRP_CONTROLLERS_MPC_TRAJECTORY_HPP

#include <cstddef>
#include <vector>

namespace dmrp::controllers::mpc {

struct State {
  double x = 0.0;
  double y = 0.0;
  double theta = 0.0;  // not wrapped: neighbours on a trajectory differ by less than a turn
};

struct Control {
  double v = 0.0;      // m/s
  double omega = 0.0;  // rad/s
};

// controls[k] holds from states[k] to states[k + 1], for dt_s.
struct Trajectory {
  std::vector<State> states;      // two or more
  std::vector<Control> controls;  // one less
  double dt_s = 0.0;

  std::size_t size() const { return states.size(); }
  double duration_s() const { return static_cast<double>(controls.size()) * dt_s; }
  void reserve(std::size_t states_at_most) {
    states.reserve(states_at_most);
    controls.reserve(states_at_most);
  }
};

}  // namespace dmrp::controllers::mpc

#endif
