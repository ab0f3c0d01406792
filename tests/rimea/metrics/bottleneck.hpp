// SPDX-License-Identifier: MIT
// bottleneck.hpp: density and speed of a crowd before and behind a bottleneck.
//
// The measurement runs while people arrive at the bottleneck: from one tenth of the people through it to eight tenths.
#pragma once

#include <cstddef>
#include <cstdint>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/rectangle.hpp>
#include <set>
#include <vector>

#include "tests/rimea/metrics/walking_speeds.hpp"

namespace dmrp::rimea {

class Bottleneck final : public Metric {
 public:
  static Descriptor describe();

  Param<double> line_x_m = param("line_x_m", 0.0).unit("m").doc("people beyond this x have passed the bottleneck");
  Param<double> width_m = param("width_m", 1.0).unit("m").range(0.1, 100.0).doc("width of the bottleneck");
  Param<std::vector<double>> before_lower_m =
      param("before_lower_m", std::vector<double>{0.0, 0.0}).unit("m").doc("the area before it: lower left corner");
  Param<std::vector<double>> before_upper_m =
      param("before_upper_m", std::vector<double>{1.0, 1.0}).unit("m").doc("upper right corner");
  Param<std::vector<double>> behind_lower_m =
      param("behind_lower_m", std::vector<double>{0.0, 0.0}).unit("m").doc("the area behind it: lower left corner");
  Param<std::vector<double>> behind_upper_m =
      param("behind_upper_m", std::vector<double>{1.0, 1.0}).unit("m").doc("upper right corner");
  Param<std::vector<double>> exit_lower_m =
      param("exit_lower_m", std::vector<double>{0.0, 0.0}).unit("m").doc("the area before the exit: lower left corner");
  Param<std::vector<double>> exit_upper_m =
      param("exit_upper_m", std::vector<double>{1.0, 1.0}).unit("m").doc("upper right corner");
  Param<double> interval_s = param("interval_s", 1.0).unit("s").range(0.1, 10.0).doc("speeds are means over this time");

  void begin(const dmrp::MetricTrial& trial) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  struct Presence {
    double people = 0.0;
    double speeds = 0.0;  // sum
    double speed_count = 0.0;
    void add(const Presence& other);
    double density(const toolkit::Rectangle& area, double intervals) const;
    double mean_speed() const;
  };
  struct Interval {
    double t_s;
    std::size_t passed;  // since the beginning
    Presence before, behind, exit;
  };

  Presence presence_in(const toolkit::Rectangle& area, const Span<Person>& people) const;

  toolkit::Rectangle before_;
  toolkit::Rectangle behind_;
  toolkit::Rectangle exit_;
  WalkingSpeeds walking_speeds_;
  std::size_t people_ = 0;  // at the beginning
  std::set<std::uint64_t> passed_;
  std::vector<Interval> intervals_;
};

}  // namespace dmrp::rimea
