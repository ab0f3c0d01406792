// SPDX-License-Identifier: MIT
// A controller that drives ahead as fast as its own copies of header and library say.
#include <dmrp/plugin.hpp>

#include "tests/end_to_end/isolation/gain.hpp"

namespace {

struct Controller final : dmrp::LocalController {
  static dmrp::Descriptor describe() { return dmrp::Descriptor(ID, ID, "1.0.0").license("MIT"); }
  void set_path(dmrp::Path, std::uint64_t) override {}
  dmrp::Status step(const dmrp::Observation&, dmrp::Command& command) override {
    command.v_x = gain::of_header() * gain_of_library();
    return dmrp::Status::ok;
  }
};

}  // namespace

DMRP_PLUGINS(Controller)
