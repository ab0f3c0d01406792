// SPDX-License-Identifier: MIT
// velocity_window.hpp: samples of the velocities that a robot can reach within a given time.
#pragma once

#include <cstddef>
#include <dmrp/cpp/local_controller.hpp>
#include <vector>

namespace dmrp::controllers::dwa {

// `count` (at least two) evenly spaced values from the lowest to the highest, and 0 if it lies between them. Ascending.
void sample_range(double lowest, double highest, std::size_t count, std::vector<double>& values);

// The dynamic window: the values of v and omega within the limits that the accelerations allow after `reach_s`. (One
// control period in the dynamic window approach.)
struct VelocityWindow {
  std::vector<double> v;      // m/s
  std::vector<double> omega;  // rad/s

  // `v_most` bounds v in addition to the limits.
  void sample(const Observation& now, double reach_s, double v_most, std::size_t v_count, std::size_t omega_count);
};

}  // namespace dmrp::controllers::dwa
