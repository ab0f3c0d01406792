// SPDX-License-Identifier: MIT
// trajectory.hpp: states and controls of a robot on a grid of equal time steps.
#pragma once

#include <cstddef>
#include <dmrp/cpp/local_controller.hpp>
#include <vector>

namespace dmrp::controllers::mpc {

// theta is not wrapped: consecutive states of a trajectory differ by less than a full turn.
using State = Pose;

inline State between(const State& a, const State& b, double share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.theta + share * (b.theta - a.theta)};
}

struct Control {
  double v = 0.0;      // m/s
  double omega = 0.0;  // rad/s; of a car-like robot the steering angle, rad; of a holonomic one the speed to the left
};

// controls[k] leads from states[k] to states[k + 1] in dt_s.
struct Trajectory {
  std::vector<State> states;      // two or more, or none
  std::vector<Control> controls;  // one less
  double dt_s = 0.0;

  std::size_t size() const { return states.size(); }
  bool empty() const { return states.empty(); }
  double duration_s() const { return static_cast<double>(controls.size()) * dt_s; }
  void reserve(std::size_t most_states) {
    states.reserve(most_states);
    controls.reserve(most_states);
  }
  void clear() {
    states.clear();
    controls.clear();
  }
  // Drops the first `count` states and their controls.
  void drop_front(std::size_t count) {
    states.erase(states.begin(), states.begin() + static_cast<std::ptrdiff_t>(count));
    controls.erase(controls.begin(), controls.begin() + static_cast<std::ptrdiff_t>(count));
  }
};

}  // namespace dmrp::controllers::mpc
