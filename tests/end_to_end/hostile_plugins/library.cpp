// SPDX-License-Identifier: MIT
// libdmrp_test_hostile.so: a controller that attacks the host, and one that may start processes. They stand still.
#include <dmrp/plugin.hpp>

#include "tests/end_to_end/hostile_plugins/attacks.hpp"

namespace dmrp::test {

class HostileController : public dmrp::LocalController {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("test.controller.hostile", "Hostile controller", "1.0.0").license("MIT");
  }
  ~HostileController() override {
    if (*what == "crash in destroy") crash();
  }

  dmrp::Param<std::string> what = param("attack", "none").doc("what it does, as robot 1 after one second");

  dmrp::Status start(const dmrp::Start& start) override {
    world_ = start.world.operator->();
    return dmrp::Status::ok;
  }
  void set_path(dmrp::Path, std::uint64_t) override {}
  dmrp::Status step(const dmrp::Observation& now, dmrp::Command&) override {
    // on a loaded machine the thread would else crash in a later trial, which then runs again
    if (*what == "late thread" && now.robot == 1 && now.t_ns > 1'000'000'000) pause();
    if (now.robot != 1 || now.t_ns != 1'000'000'000) return dmrp::Status::ok;
    attack(*what);
    if (*what == "writes into the observation") const_cast<dmrp_limits&>(now.limits).v_max += 1.0;
    if (*what == "writes into the world") const_cast<dmrp_world*>(world_)->time_limit_ns += 1;
    return dmrp::Status::ok;
  }

 private:
  const dmrp_world* world_ = nullptr;
};

class ResidentController final : public HostileController {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("test.controller.resident", "Controller that maps much", "1.0.0")
        .license("MIT")
        .flags(DMRP_FLAG_RESIDENT_MEMORY);
  }
};

class HelpedController final : public HostileController {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("test.controller.helped", "Controller with a helper", "1.0.0")
        .license("MIT")
        .flags(DMRP_FLAG_PROCESSES);
  }
};

}  // namespace dmrp::test

// As a static initialiser would do it.
__attribute__((constructor)) static void at_load() {
  const char* const asked = std::getenv("DMRP_TEST_AT_LOAD");
  const std::string what = asked ? asked : "";
  if (what == "fork") fork();
  if (what == "stay" && fork() == 0)
    for (;;) pause();
  if (what == "wait")
    for (;;) pause();
  if (what == "crash") std::abort();
  if (what == "write") dmrp::test::write_elsewhere();
  if (what == "close") dmrp::test::close_those("pipe:");
  if (what == "close") {
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_SETMASK, &all, nullptr);
    for (;;) pause();
  }
}

using dmrp::test::HelpedController;
using dmrp::test::HostileController;
using dmrp::test::ResidentController;
DMRP_PLUGINS(HostileController, HelpedController, ResidentController)
