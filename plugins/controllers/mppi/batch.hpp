// SPDX-License-Identifier: MIT
// batch.hpp: the sampled control sequences of a cycle and the trajectories that they lead to.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "controllers/mppi/noise.hpp"

namespace dmrp::controllers::mppi {

// One velocity of the robot in its own frame.
struct Velocity {
  float v_x = 0.0f;  // m/s
  float v_y = 0.0f;  // m/s; holonomic only
  float omega = 0.0f;
};

struct Limits {
  float v_min = 0.0f;  // m/s
  float v_max = 0.0f;
  float v_y_max = 0.0f;
  float omega_max = 0.0f;
  float a_max = 0.0f;
  float alpha_max = 0.0f;
};

// How controls are sampled, and the robot that they drive.
struct Model {
  int steps = 56;
  float step_s = 0.05f;
  bool holonomic = false;
  Velocity deviation;  // standard deviations
  Limits limits;
  float slowest_m_s = -std::numeric_limits<float>::infinity();  // no sample drives forward more slowly than this
};

// A velocity per step.
using Sequence = std::vector<Velocity>;

// A number for each sample and step. `lanes` samples stand side by side, then the steps of their block follow.
class Field {
 public:
  void resize(int blocks, int steps) {
    steps_ = steps;
    values_.assign(static_cast<std::size_t>(blocks) * static_cast<std::size_t>(steps), Lanes::Zero());
  }
  Lanes& row(int block, int step) { return values_[place(block, step)]; }
  const Lanes& row(int block, int step) const { return values_[place(block, step)]; }

  float& at(int sample, int step) { return row(sample / lanes, step)[sample % lanes]; }
  float at(int sample, int step) const { return row(sample / lanes, step)[sample % lanes]; }

 private:
  std::size_t place(int block, int step) const {
    return static_cast<std::size_t>(block) * static_cast<std::size_t>(steps_) + static_cast<std::size_t>(step);
  }

  std::vector<Lanes> values_;
  int steps_ = 0;
};

// Control i of a sample is driven from step i + 1 on; step 0 still has the robot's velocity now. Pose i is that after
// step i, relative to the robot's position now, axes as the world's.
struct Batch {
  void resize(int samples, const Model& model);

  int samples() const { return blocks * lanes; }

  int blocks = 0;
  int steps = 0;
  Velocity now;
  Field v_x, v_y, omega;  // controls; v_y of holonomic robots only
  Field x, y, theta;      // poses
};

// Samples controls about a mean, within the accelerations, and drives them.
void sample(const Model& model, const Sequence& mean, const Noise& noise, std::uint32_t cycle, Velocity now,
            float theta, Batch& batch);

}  // namespace dmrp::controllers::mppi
