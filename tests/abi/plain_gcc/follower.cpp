// SPDX-License-Identifier: MIT
// Built twice, with NUMBER 1 and 2, into two libraries of authors who chose the same name for their class.
#include <dmrp/plugin.hpp>

#define TEXT_OF(x) #x
#define VALUE_OF(x) TEXT_OF(x)

class Follower : public dmrp::LocalController {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("org.example.follower_" VALUE_OF(NUMBER), "Follower", "1.0.0");
  }
  dmrp::Param<double> speed = param("speed_" VALUE_OF(NUMBER), 1.0 * NUMBER);

  void set_path(dmrp::Path, std::uint64_t) override {}
  dmrp::Status step(const dmrp::Observation&, dmrp::Command& command) override {
    command.v_x = speed;
    command.omega = -1.0 * NUMBER;
    return dmrp::Status::ok;
  }
};

DMRP_PLUGINS(Follower)
