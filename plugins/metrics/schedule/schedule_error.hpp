// SPDX-License-Identifier: MIT
// schedule_error.hpp: how late robots pass the waypoints of their plans.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/sums.hpp"

namespace dmrp::metrics {

class ScheduleError final : public Metric {
 public:
  static Descriptor describe();

  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  // A place of the path, and when the plan has the robot reach it.
  struct Due {
    double arc_m;
    std::int64_t t_ns;
  };
  struct Schedule {
    std::vector<Due> dues;  // of the path in force, without its beginning
    std::size_t next = 0;   // the first one that the robot has not passed
    CompensatedSum late_s;
    CompensatedSum off_s;
    std::size_t passed = 0;
  };

  void follow(const dmrp_plan& plan);

  std::uint64_t revision_ = 0;
  std::vector<Schedule> schedules_;  // by robot
};

}  // namespace dmrp::metrics
