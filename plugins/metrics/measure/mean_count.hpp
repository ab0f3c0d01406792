// SPDX-License-Identifier: MIT
// mean_count.hpp: the time average of a count, such as a robot's neighbours, over its active time. Sums integers, so it
// is exact.
#pragma once

#include <cstddef>
#include <cstdint>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

#include "metrics/measure/active_steps.hpp"

namespace dmrp::metrics {

class MeanCount {
 public:
  void begin(std::size_t robot_count) {
    active_.begin(robot_count);
    times_.assign(robot_count, {});
  }

  // Calls count(position), which returns an integer, for every robot that was active in the step.
  template <class Count>
  void observe(const Sample& sample, Count&& count) {
    active_.observe(sample);
    for (std::size_t robot = 0; robot < times_.size(); ++robot) {
      if (!active_.in_step(robot)) continue;
      const std::int64_t counted = count(toolkit::position(sample.robots[robot].pose));
      times_[robot].active_ns += sample.dt_ns;
      times_[robot].counted_ns += counted * sample.dt_ns;
    }
  }

  // By robot; undefined for a robot that was never active.
  std::vector<double> means() const {
    std::vector<double> means;
    for (const Times& times : times_)
      means.push_back(times.active_ns > 0 ? static_cast<double>(times.counted_ns) / static_cast<double>(times.active_ns)
                                          : undefined);
    return means;
  }

 private:
  struct Times {
    std::int64_t active_ns = 0;
    std::int64_t counted_ns = 0;  // the integral of the count over active time
  };

  ActiveSteps active_;
  std::vector<Times> times_;
};

}  // namespace dmrp::metrics
