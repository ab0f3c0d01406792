// SPDX-License-Identifier: MIT
// interventions.hpp: how often and for how long the collision monitor reduced robots' commands.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <vector>

namespace dmrp::metrics {

class Interventions final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  struct Intervention {
    std::size_t robot;
    std::int64_t from_ns;
    std::int64_t to_ns;
    std::uint32_t least_percent;  // that was left of a command
    Vec2 place;                   // where it began
  };

  void intervene(const RobotEvent& event, const Vec2& place);

  bool after_control_ = false;               // the last sample was a control tick
  std::vector<Intervention> interventions_;  // in order of their beginnings
  std::vector<std::int64_t> open_;           // by robot, in interventions_; -1: there is none
  std::vector<double> counts_;               // by robot; undefined if planning failed
};

}  // namespace dmrp::metrics
