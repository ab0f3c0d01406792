// SPDX-License-Identifier: MIT
// crowd_model.hpp: asks a pedestrian model for the velocities of all people of a world.
#pragma once

#include <dmrp/pedestrian_model.h>

#include <cstdint>
#include <vector>

#include "core/world/world.hpp"
#include "host/plugins/calls/input_copy.hpp"
#include "host/plugins/calls/output.hpp"
#include "host/plugins/instance.hpp"

namespace dmrp::host {

class CrowdModel {
 public:
  // `model` has started; it and `world` outlive this object.
  CrowdModel(Instance& model, const core::World& world, std::int64_t budget_ns);

  // For the next step of the world, parallel to its people, of whom there is one at least. Throws PluginFault.
  CallGuard::Result update(std::int64_t step);
  const std::vector<dmrp_vec2>& velocities() const { return velocities_; }

 private:
  Instance& model_;
  const core::World& world_;
  std::int64_t budget_ns_;
  dmrp_pedestrian_model table_;
  InputCopy input_;
  OutputArray<dmrp_motion> motions_;
  std::vector<dmrp_vec2> velocities_;
};

}  // namespace dmrp::host
