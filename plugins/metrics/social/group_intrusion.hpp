// SPDX-License-Identifier: MIT
// group_intrusion.hpp: how long and how often robots cross between people who walk or stand together.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/active_steps.hpp"
#include "metrics/measure/time_share.hpp"

namespace dmrp::metrics {

class GroupIntrusion final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  // The people of one group with two members or more: their convex hull, a segment where they stand in a line.
  struct Group {
    std::uint32_t id;
    std::vector<Vec2> hull;
  };
  struct Intrusions {
    TimeShare share;
    int count = 0;
    std::vector<std::uint32_t> inside;  // groups that it was in at the last sample
  };

  void find_groups(const Sample& sample);

  ActiveSteps active_;
  std::vector<Group> groups_;           // at the sample, by rising id
  std::vector<Intrusions> intrusions_;  // a robot
};

}  // namespace dmrp::metrics
