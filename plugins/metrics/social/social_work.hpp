// SPDX-License-Identifier: MIT
// social_work.hpp: how hard robots and people press on each other, in terms of the social force model.
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
    std::int64_t active_ns = 0;   // what the sums stand for
    std::int64_t pending_ns = 0;  // since
    NearestWall wall;
    CompensatedSum on_robot;  // m/s: the integral of forces per mass
    CompensatedSum on_people;
  };

  ActiveSteps active_;
  bool people_ = false;      // whether there ever were any
  std::vector<Work> works_;  // a robot
};

}  // namespace dmrp::metrics
