// SPDX-License-Identifier: MIT
// noise.hpp: normally distributed disturbances of the samples' controls, drawn by counting.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace dmrp::controllers::mppi {

// Samples are computed in blocks of this many, side by side.
inline constexpr int lanes = 16;

// A number for each sample of a block.
using Lanes = Eigen::Array<float, lanes, 1>;

// Rows of standard normal numbers, one number a sample. A row is a window of one fixed table, which begins at a place
// drawn by Philox under the key of the trial's seed and the robot, at the counter of cycle, step and axis. So rows cost
// one draw each, and the same names give the same numbers whatever was drawn before.
class Noise {
 public:
  void start(std::uint64_t seed, std::int32_t robot);

  // The begin of a row. Axes: 0 forward, 1 sideways, 2 turning.
  std::uint32_t row(std::uint32_t cycle, std::uint32_t step, std::uint32_t axis) const;

  // The numbers of one block of samples in a row.
  Eigen::Map<const Lanes> block(std::uint32_t row, int block) const;

 private:
  std::array<std::uint32_t, 2> key_ = {};
  const float* table_ = nullptr;
};

}  // namespace dmrp::controllers::mppi
