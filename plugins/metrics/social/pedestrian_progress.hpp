// SPDX-License-Identifier: MIT
// pedestrian_progress.hpp: the progress of a crowd toward its targets, as a curve over time.
//
// Made for pairs of trials: the same crowd with and without robots, compared at equal times. Every person walks legs,
// each from its first position to a target rectangle. A finished leg counts with its full straight distance, whatever
// the walked way; the current one counts with this distance minus the remaining one. So the sum does not jump when a
// target changes, and a detour appears as missing progress, not as walked distance.
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
    double whole_m;     // from the first position to the target
    double left_m;
  };

  static Leg begin_leg(const Person& person);
  void update(Leg& leg, const Person& person);
  void update_legs(const Sample& sample);
  double gained_m() const;

  std::vector<Leg> legs_;         // of the people at the last sample, in their order
  CompensatedSum finished_m_;     // sum over all finished legs
  std::size_t most_people_ = 0;   // at the same time
  std::vector<double> gained_m_;  // of the crowd, at 0, 1, 2, ... s
  TimeMoments speed_, desired_speed_;
};

}  // namespace dmrp::metrics
