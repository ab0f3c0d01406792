// SPDX-License-Identifier: MIT
// group_intrusion.hpp: duration and number of intrusions of robots into groups of people.
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
  // A group of at least two people: the convex hull of their centres, a segment if they are collinear.
  struct Group {
    std::uint32_t id;
    std::vector<Vec2> hull;
  };
  struct Intrusions {
    TimeShare share;
    int count = 0;
    std::vector<std::uint32_t> inside;  // ids of the groups that it intruded at the last sample
  };

  void find_groups(const Sample& sample);

  ActiveSteps active_;
  std::vector<Group> groups_;           // at the current sample, by id
  std::vector<Intrusions> intrusions_;  // by robot
};

}  // namespace dmrp::metrics
