// SPDX-License-Identifier: MIT
// faulty_pedestrians.hpp: people stand still, until one gets an invalid velocity.
#pragma once

#include <limits>

#include "tests/end_to_end/faulty_plugins/misbehave.hpp"

namespace dmrp::test {

class FaultyPedestrians final : public dmrp::PedestrianModel {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("test.pedestrian.faulty", "Faulty pedestrians", "1.0.0").license("MIT");
  }

  dmrp::Param<std::string> fault = param("fault", "none").doc("what is wrong with them");

  dmrp::Status step(const dmrp::Crowd& crowd, dmrp::Motions& motions) override {
    if (dmrp::seconds(crowd.t_ns) < 1.0) return dmrp::Status::ok;
    if (*fault == "nan") motions[1].velocity.y = std::numeric_limits<double>::quiet_NaN();
    if (*fault == "too_fast") motions[1].velocity.x = 5.5;
    return misbehave(fault);
  }
};

}  // namespace dmrp::test
