// SPDX-License-Identifier: MIT
// velocity_window.hpp: samples of the velocities that a robot can reach within a given time.
#pragma once

#include <cstddef>
#include <vector>

#include "controllers/motion/unicycle.hpp"

namespace dmrp::controllers::dwa {

// A velocity, constant over the simulated time.
struct Sample {
  double v = 0.0;      // m/s, forward
  double omega = 0.0;  // rad/s
  double v_y = 0.0;    // m/s, left; 0 unless the drive is holonomic
};

inline double speed_of(const Sample& sample) {
  return std::hypot(sample.v, sample.v_y);
}

// `count` (at least two) evenly spaced values from the lowest to the highest, and 0 if it lies between them. Ascending.
void sample_range(double lowest, double highest, std::size_t count, std::vector<double>& values);

// The numbers of samples of each velocity; each at least two.
struct SampleCounts {
  std::size_t v_x = 2;
  std::size_t v_y = 2;  // holonomic drives only
  std::size_t omega = 2;
};

// The dynamic window: the values of v_x, v_y and omega within the limits that the accelerations allow after `reach_s`.
// (One control period in the dynamic window approach.)
struct VelocityWindow {
  std::vector<double> v;      // m/s, forward
  std::vector<double> v_y;    // m/s, left; 0 alone unless the drive is holonomic
  std::vector<double> omega;  // rad/s

  // `v_most` bounds v and v_y in addition to the limits.
  void sample(const Observation& now, double reach_s, double v_most, const SampleCounts& counts);

  // The sample of three of these values. The accelerations of a holonomic drive reach a disc of velocities: values in
  // the corners of the window are moved to its edge.
  Sample at(double v_ahead, double v_left, double turning) const {
    if (v_y.size() == 1) return {v_ahead, turning, v_left};
    const Vec2 reached = toward(center_, Vec2{v_ahead, v_left}, reach_m_s_);
    return {reached.x, turning, reached.y};
  }

 private:
  Vec2 center_ = {0.0, 0.0};  // the current velocity, within the limits
  double reach_m_s_ = 0.0;
};

}  // namespace dmrp::controllers::dwa
