// SPDX-License-Identifier: MIT
// referee_classes.hpp: what each robot does, as the referee tells in the trace (dmrp/robot_event.h).
#pragma once

#include <dmrp/robot_event.h>

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <optional>
#include <vector>

#include "metrics/measure/bases.hpp"

namespace dmrp::metrics {

struct RefereeClass {
  std::uint32_t kind;   // DMRP_CLASS_*
  std::uint32_t other;  // that holds or blocks the robot; DMRP_NOBODY
  bool circles;
  std::int64_t since_ns;
};

class RefereeClasses {
 public:
  void begin(std::size_t robot_count) {
    active_.begin(robot_count);
    classes_.assign(robot_count, std::nullopt);
    are_known_ = false;
  }

  void observe(const Sample& sample) {
    active_.observe(sample);
    for (const RobotEvent& event : sample.events) {
      if (event.kind != DMRP_ROBOT_EVENT_CLASS || event.robot >= classes_.size()) continue;
      // events are those since the last sample: the class holds in the step that ended with this one
      classes_[event.robot] = {event.detail & DMRP_CLASS_MASK, event.other, (event.detail & DMRP_CLASS_CIRCLING) != 0,
                               event.t_ns};
      are_known_ = true;
    }
  }

  // False for a trace of a host without a referee, and where planning failed.
  bool are_known() const { return are_known_; }

  // In the step that ended with the sample; none if the robot was not active in it or the trace does not tell.
  std::optional<RefereeClass> in_step(std::size_t robot) const {
    return active_.in_step(robot) ? classes_[robot] : std::nullopt;
  }

 private:
  ActiveSteps active_;
  std::vector<std::optional<RefereeClass>> classes_;  // by robot
  bool are_known_ = false;
};

}  // namespace dmrp::metrics
