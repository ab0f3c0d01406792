// SPDX-License-Identifier: MIT
// counter_flow.hpp: speed and lane order of people who walk both ways along x.
//
// The lane order is the order parameter of Nowak, Schadschneider (Phys. Rev. E 85, 066128, 2012), who adopted it from
// colloids: ((same - opposite) / (same + opposite))^2, mean over people, where each counts the people of both directions
// in their own row, themselves included. Of rows of n people whose directions are random it is 1 / n on average; here
// it is reduced by that, so that 0 is no order and 1 are rows of one direction each.
#pragma once

#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/rectangle.hpp>
#include <vector>

namespace dmrp::rimea {

class CounterFlow final : public Metric {
 public:
  static Descriptor describe();

  Param<std::vector<double>> lower_m =
      param("lower_m", std::vector<double>{0.0, 0.0}).unit("m").doc("the measurement area's lower left corner, [x, y]");
  Param<std::vector<double>> upper_m =
      param("upper_m", std::vector<double>{1.0, 1.0}).unit("m").doc("its upper right corner");
  Param<double> row_width_m =
      param("row_width_m", 0.4).unit("m").range(0.01, 10.0).doc("people within half of it to either side are in a row");
  Param<double> from_s = param("from_s", 20.0).unit("s").range(0.0, 1e6).doc("the measurement begins at this time");
  Param<double> interval_s = param("interval_s", 1.0).unit("s").range(0.1, 10.0).doc("time between two samples");

  void begin(const dmrp::MetricTrial& trial) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  void add_order();

  struct Walker {
    double y_m;
    double direction;  // 1 or -1
  };

  toolkit::Rectangle area_;
  std::vector<Walker> present_;  // in the area, in this interval
  double people_ = 0.0;          // all sums are over intervals and people in the area
  double relative_speeds_ = 0.0;
  double orders_ = 0.0;
  double random_orders_ = 0.0;
};

}  // namespace dmrp::rimea
