// SPDX-License-Identifier: MIT
// faulty_controller.hpp: stands still, and has one fault in one function: for robot `robot`, from `at_s` on.
#pragma once

#include <limits>

#include "tests/end_to_end/faulty_plugins/misbehave.hpp"

namespace dmrp::test {

class FaultyController final : public dmrp::LocalController {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("test.controller.faulty", "Faulty controller", "1.0.0").license("MIT");
  }

  dmrp::Param<std::string> fault = param("fault", "none").doc("what it does wrong");
  dmrp::Param<std::string> where =
      param("where", "step").choices({"start", "set_path", "step"}).doc("in which function");
  dmrp::Param<std::int64_t> robot = param("robot", 1).range(0, 1000).doc("whose controller does it, in step()");
  dmrp::Param<double> at_s = param("at_s", 1.0).range(0.0, 1000.0).unit("s").doc("when it does it, in step()");

  dmrp::Status start(const dmrp::Start&) override { return *where == "start" ? do_wrong() : dmrp::Status::ok; }
  void set_path(dmrp::Path, std::uint64_t) override {
    if (*where == "set_path") do_wrong();
  }
  dmrp::Status step(const dmrp::Observation& now, dmrp::Command& command) override {
    if (*where != "step" || now.robot != robot || dmrp::seconds(now.t_ns) < at_s) return dmrp::Status::ok;
    if (*fault == "nan") command.omega = std::numeric_limits<double>::quiet_NaN();
    if (*fault == "infinite") command.v_x = std::numeric_limits<double>::infinity();
    if (*fault == "no_solution") return dmrp::Status::no_solution;
    return do_wrong();
  }

 private:
  dmrp::Status do_wrong() {
    if (*fault == "error") return set_error("failed on purpose"), dmrp::Status::error;
    return misbehave(fault);
  }
};

}  // namespace dmrp::test
