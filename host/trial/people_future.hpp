// SPDX-License-Identifier: MIT
// people_future.hpp: draft/dmrp.people_future/1: simulates the trial's crowd without robots, some seconds ahead of the
// trial.
#pragma once

#include <dmrp/draft/people_future.h>

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "core/world/world.hpp"
#include "host/trial/crowd_model.hpp"
#include "host/trial/world/variant_world.hpp"

namespace dmrp::host {

class PeopleFuture {
 public:
  // `model`: an instance of its own that has started with the seed of the trial's; nullptr for people who stand.
  PeopleFuture(const VariantWorld& variant, std::uint64_t seed, Instance* model, std::int64_t budget_ns);
  PeopleFuture(const PeopleFuture&) = delete;
  PeopleFuture& operator=(const PeopleFuture&) = delete;

  // At the beginning of the control tick at `t_ns`, which never decreases. Throws PluginFault.
  void advance(std::int64_t t_ns);

  const dmrp_people_future* extension() const { return &extension_; }

 private:
  struct Frame {
    dmrp_people_frame view;
    std::vector<dmrp_agent> people;
  };

  void step();
  void keep_frame();

  core::World world_;
  std::optional<CrowdModel> crowd_;
  std::vector<dmrp_vec2> at_rest_;
  std::deque<Frame> frames_;  // of the present control tick and those after it
  dmrp_people_future extension_{};
};

}  // namespace dmrp::host
