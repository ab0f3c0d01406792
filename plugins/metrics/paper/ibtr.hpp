// SPDX-License-Identifier: MIT
// ibtr.hpp: the share of the mission in which robots that are near each other both crawl.
#pragma once

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
          .doc("values of v_thresh, as shares of the robot's own mean speed, for the curve ibtr_by_speed_fraction");

  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  // Two robots, active and near each other in all steps that end with the samples first to last.
  struct Encounter {
    std::uint32_t a, b;
    std::size_t first, last;
  };
  // Two robots that in addition both crawled from one time to another.
  struct Congestion {
    std::int64_t from_ns, to_ns;
    std::uint32_t a, b;
  };

  // Two robots, active and near each other by some of the distances, in the step that ends with a sample.
  struct Meeting {
    std::size_t sample;
    std::uint32_t a, b;
    double squared_distance;
  };

  std::vector<double> speed_thresholds(double fraction) const;
  double blocked_percent(double reach_m, double fraction, std::int64_t mission_ns) const;
  void follow_encounter(std::uint32_t a, std::uint32_t b, bool near);
  bool both_crawl(std::uint32_t a, std::uint32_t b, std::size_t sample, const std::vector<double>& thresholds) const;
  std::vector<Congestion> congestions() const;

  // The thresholds are known at the end only, so speeds are kept until then.
  std::size_t robot_count_ = 0;
  ActiveSteps active_;
  std::vector<TimeMoments> pace_;
  std::vector<std::int64_t> times_ns_;   // a sample
  std::vector<double> speeds_;           // robot_count_ a sample
  std::vector<std::size_t> open_since_;  // a pair (a * robot_count_ + b): first sample of its encounter, or none
  std::vector<Encounter> encounters_;
  double widest_m_ = 0.0;  // of all distances
  std::vector<Meeting> meetings_;
};

}  // namespace dmrp::metrics
