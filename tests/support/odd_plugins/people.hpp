// SPDX-License-Identifier: MIT
// people.hpp: everybody walks slowly along x.
#pragma once

#include <dmrp/pedestrian_model.h>

#include <cstring>

#include "tests/support/odd_plugins/instance.hpp"

namespace dmrp::test {

inline std::int32_t step_people(dmrp_instance* self, const dmrp_crowd*, dmrp_motions* motions) {
  for (std::uint32_t i = 0; i < motions->count; ++i)
    DMRP_AT_OUT(dmrp_motion, motions->motions, motions->stride, i)->velocity = {0.1, 0.0};
  if (self->is("overrun step")) std::memset(motions->motions, 0, (motions->count + 1) * motions->stride);
  return self->status_of("step");
}

inline constexpr dmrp_pedestrian_model people_table = {sizeof(dmrp_pedestrian_model), 0, &step_people};

}  // namespace dmrp::test
