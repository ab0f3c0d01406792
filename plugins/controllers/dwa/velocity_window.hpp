// SPDX-License-Identifier: MIT
// velocity_window.hpp: the velocities that a robot can reach within a while.
#ifndef DMRP_CONTROLLERS_DWA_VELOCITY_WINDOW_HPP
#define DMRP_CONTROLLERS_DWA_VELOCITY_WINDOW_HPP

#include <cstddef>
#include <dmrp/cpp/local_controller.hpp>
#include <vector>

namespace dmrp::controllers::dwa {

// `count` values (two at least) evenly from the lowest to the highest, ascending; zero among them where it is between.
void sample_range(double lowest, double highest, std::size_t count, std::vector<double>& values);

// The dynamic window: v and omega that the accelerations allow after `reach_s` (one control period, for the approach
// that bears the name), inside the limits.
struct VelocityWindow {
  std::vector<double> v;      // m/s
  std::vector<double> omega;  // rad/s

  // v at most `v_most`.
  void sample(const Observation& now, double reach_s, double v_most, std::size_t v_count, std::size_t omega_count);
};

}  // namespace dmrp::controllers::dwa

#endif
