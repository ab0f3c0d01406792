// SPDX-License-Identifier: MIT
// driven_length.hpp: the length that each robot has driven, over all samples.
#pragma once

#include <cstddef>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

#include "metrics/measure/sums.hpp"

namespace dmrp::metrics {

class DrivenLength {
 public:
  void begin(std::size_t robot_count) {
    lengths_m_.assign(robot_count, {});
    last_positions_.clear();
  }

  void observe(const Sample& sample) {
    if (last_positions_.empty())
      for (const RobotSample& robot : sample.robots) last_positions_.push_back(toolkit::position(robot.pose));
    for (std::size_t robot = 0; robot < lengths_m_.size(); ++robot) {
      const Vec2 position = toolkit::position(sample.robots[robot].pose);
      lengths_m_[robot].add(toolkit::distance(last_positions_[robot], position));
      last_positions_[robot] = position;
    }
  }

  double of_robot(std::size_t robot) const { return lengths_m_[robot].value(); }

 private:
  std::vector<CompensatedSum> lengths_m_;  // by robot
  std::vector<Vec2> last_positions_;       // by robot; empty before the first sample
};

}  // namespace dmrp::metrics
