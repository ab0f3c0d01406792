// SPDX-License-Identifier: MIT
// pedestrian_progress.hpp: how much way the crowd has made toward where it wants to go, as a curve over time.
//
// Made for pairs: the same crowd with and without robots, compared at equal times. Every person walks legs, each from
// where it began to the rectangle that is its target. A leg that is over counts with its straight distance in full,
// whatever the way walked; the present one with what is left subtracted. So the sum never jumps at a change of target,
// and a detour forced on somebody shows as distance not gained, not as way walked.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/sums.hpp"

namespace dmrp::metrics {

class PedestrianProgress final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  struct Leg {
    std::uint64_t person_id;
    Vec2 lower, upper;  // the target
    double whole_m;     // from where it began to the target
    double left_m;
  };

  static Leg begin_leg(const Person& person);
  void follow(Leg& leg, const Person& person);
  void follow_all(const Sample& sample);
  double gained_m() const;

  std::vector<Leg> legs_;         // of the people of the last sample, in their order
  CompensatedSum finished_m_;     // of all legs that are over
  std::size_t most_people_ = 0;   // at once
  std::vector<double> gained_m_;  // the crowd's, at 0, 1, 2, ... s
  TimeMoments speed_, desired_speed_;
};

}  // namespace dmrp::metrics
