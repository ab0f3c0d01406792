// SPDX-License-Identifier: MIT
// social_work.hpp: the social forces between robots and people, integrated over time.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/active_steps.hpp"
#include "metrics/measure/nearest_wall.hpp"
#include "metrics/measure/sums.hpp"

namespace dmrp::metrics {

class SocialWork final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  struct Work {
    std::int64_t active_ns = 0;   // the time that the sums cover
    std::int64_t pending_ns = 0;  // the time after that
    NearestWall wall;
    CompensatedSum on_robot;  // m/s: the integral of forces per mass
    CompensatedSum on_people;
  };

  ActiveSteps active_;
  bool people_ = false;      // whether any sample had people
  std::vector<Work> works_;  // by robot
};

}  // namespace dmrp::metrics
