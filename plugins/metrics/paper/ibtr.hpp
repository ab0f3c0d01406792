// SPDX-License-Identifier: MIT
// ibtr.hpp: inter-robot blocking time ratio: the share of the mission in which two robots near each other both crawl.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/active_steps.hpp"
#include "metrics/measure/sums.hpp"

namespace dmrp::metrics {

class Ibtr final : public Metric {
 public:
  static Descriptor describe();
  Param<double> distance_m =
      param("distance_m", 2.0).unit("m").range(0.0, 100.0).doc("d: robots at most this far apart can block each other");
  Param<double> speed_fraction = param("speed_fraction", 0.2)
                                     .unit("1")
                                     .range(0.0, 10.0)
                                     .doc("v_thresh as a share of the robot's own mean speed; slower robots crawl");
  Param<std::vector<double>> distances_m = param("distances_m", std::vector<double>{1.0, 1.5, 2.0, 2.5, 3.0})
                                               .unit("m")
                                               .range(0.0, 100.0)
                                               .doc("values of d for the curve ibtr_by_distance");
  Param<std::vector<double>> speed_fractions =
      param("speed_fractions", std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5})
          .unit("1")
          .range(0.0, 10.0)
          .doc("values of speed_fraction for the curve ibtr_by_speed_fraction");

  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  // A step in which active robots were near each other, by the widest of the distances.
  struct Step {
    std::int64_t from_ns, to_ns;
  };
  // A pair of these robots in such a step.
  struct Encounter {
    std::uint32_t step;  // index of steps_
    std::uint32_t a, b;
    double squared_distance;
    double speed_a, speed_b;  // m/s, measured
  };
  // A time in which a pair was near each other, by distance_m, and both crawled.
  struct Congestion {
    std::int64_t from_ns, to_ns;
    std::uint32_t a, b;
  };

  std::vector<double> speed_thresholds(double fraction) const;
  static bool is_blocking(const Encounter& encounter, double reach_m, const std::vector<double>& thresholds);
  double blocked_percent(double reach_m, double fraction, std::int64_t mission_ns) const;
  std::vector<Congestion> congestions() const;

  // The thresholds are known only at the end. Until then the metric keeps the speeds of robots that are near each
  // other.
  std::size_t robot_count_ = 0;
  ActiveSteps active_;
  std::vector<TimeMoments> pace_;
  double widest_m_ = 0.0;      // of all distances
  std::int64_t last_ns_ = -1;  // of the last sample; -1: there was none
  std::vector<Step> steps_;
  std::vector<Encounter> encounters_;  // by step, then by robots
};

}  // namespace dmrp::metrics
