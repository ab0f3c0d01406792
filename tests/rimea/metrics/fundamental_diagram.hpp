// SPDX-License-Identifier: MIT
// fundamental_diagram.hpp: density and speed of a crowd in a measurement area.
//
// The classical method: the density is the number of people in the area over its extent, at every interval; the speed
// is that of all of them over the interval. Both are means over all intervals from `from_s` on.
#pragma once

#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/rectangle.hpp>
#include <vector>

#include "tests/rimea/metrics/walking_speeds.hpp"

namespace dmrp::rimea {

class FundamentalDiagram final : public Metric {
 public:
  static Descriptor describe();

  Param<std::vector<double>> lower_m =
      param("lower_m", std::vector<double>{0.0, 0.0}).unit("m").doc("the measurement area's lower left corner, [x, y]");
  Param<std::vector<double>> upper_m =
      param("upper_m", std::vector<double>{1.0, 1.0}).unit("m").doc("its upper right corner");
  Param<double> extent = param("extent", 1.0).range(0.001, 1e6).doc("its walkable part: m2, or m for people in a line");
  Param<double> from_s = param("from_s", 10.0).unit("s").range(0.0, 1e6).doc("the measurement begins at this time");
  Param<double> interval_s = param("interval_s", 1.0).unit("s").range(0.1, 10.0).doc("speeds are means over this time");

  void begin(const dmrp::MetricTrial& trial) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  toolkit::Rectangle area_;
  WalkingSpeeds walking_speeds_;
  double intervals_ = 0.0;
  double people_ = 0.0;  // sum over the intervals
  double speeds_ = 0.0;  // sum over the intervals and the people with a speed
  double speed_count_ = 0.0;
};

}  // namespace dmrp::rimea
