// SPDX-License-Identifier: MIT
// optimizer.hpp: model predictive path integral control: the mean of sampled controls, weighted by their costs.
//
// Williams, Drews, Goldfain, Rehg, Theodorou: Information theoretic model predictive control: theory and applications
// to autonomous driving, IEEE Transactions on Robotics 34 (2018); weighting, clamping and smoothing as in nav2.
#pragma once

#include <array>

#include "controllers/mppi/batch.hpp"

namespace dmrp::controllers::mppi {

struct OptimizerSettings {
  float temperature = 0.3f;
  float gamma = 0.015f;  // weight of the control cost
};

class Optimizer {
 public:
  void start(const Model& model, const OptimizerSettings& settings);

  // Forgets all that is kept from cycle to cycle.
  void reset();

  // Replaces the sequence by the mean of the samples' controls. Adds the control costs to `costs`.
  void update(const Batch& batch, std::vector<float>& costs);

  // Once per cycle: smooths the sequence, and drops the steps that are driven until the next cycle.
  void smooth();
  void shift(int steps);

  const Sequence& sequence() const { return sequence_; }

 private:
  void add_control_costs(const Batch& batch, std::vector<float>& costs) const;
  void clamp_to_limits();

  Model model_;
  OptimizerSettings settings_;
  Sequence sequence_;
  Sequence unsmoothed_;
  std::array<Velocity, 4> history_;  // the controls driven last, the newest at the end
};

}  // namespace dmrp::controllers::mppi
