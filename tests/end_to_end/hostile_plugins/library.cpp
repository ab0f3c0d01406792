// SPDX-License-Identifier: MIT
// libdmrp_test_hostile.so: a controller that attacks the host. It stands still.
#include <dmrp/plugin.hpp>

#include "tests/end_to_end/hostile_plugins/attacks.hpp"

namespace dmrp::test {

class HostileController final : public dmrp::LocalController {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("test.controller.hostile", "Hostile controller", "1.0.0").license("MIT");
  }
  ~HostileController() override {
    if (*what == "crash in destroy") crash();
  }

  dmrp::Param<std::string> what = param("attack", "none").doc("what it does, as robot 1 after one second");

  void set_path(dmrp::Path, std::uint64_t) override {}
  dmrp::Status step(const dmrp::Observation& now, dmrp::Command&) override {
    if (now.robot == 1 && now.t_ns == 1'000'000'000) attack(*what);
    return dmrp::Status::ok;
  }
};

}  // namespace dmrp::test

using dmrp::test::HostileController;
DMRP_PLUGINS(HostileController)
