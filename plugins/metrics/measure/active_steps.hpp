// SPDX-License-Identifier: MIT
// active_steps.hpp: the steps in which a robot was active: on its way, neither arrived nor given up.
//
// In all metrics, a sample represents the step that ended with it: the interval (t - dt, t]. So the first sample
// represents no time, and the last one counts in full.
#pragma once

#include <dmrp/plugin.hpp>
#include <vector>

namespace dmrp::metrics {

class ActiveSteps {
 public:
  void begin(std::size_t robot_count) {
    before_.assign(robot_count, false);
    now_.assign(robot_count, false);
  }

  void observe(const Sample& sample) {
    before_.swap(now_);
    for (std::size_t robot = 0; robot < now_.size(); ++robot)
      now_[robot] = sample.robots[robot].state == DMRP_ROBOT_ACTIVE;
  }

  // In the step that ended with the sample. The step of the arrival is the last active one; the first sample ends none.
  bool in_step(std::size_t robot) const { return before_[robot]; }

  // At the instant of the sample.
  bool at_instant(std::size_t robot) const { return now_[robot]; }

 private:
  std::vector<char> before_;
  std::vector<char> now_;
};

}  // namespace dmrp::metrics
