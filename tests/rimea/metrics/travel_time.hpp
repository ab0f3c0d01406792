// SPDX-License-Identifier: MIT
// travel_time.hpp: the time that people take from one line across their way to another.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <map>

namespace dmrp::rimea {

class TravelTime final : public Metric {
 public:
  static Descriptor describe();

  Param<double> from_x_m = param("from_x_m", 0.0).unit("m").doc("the time begins at this x");
  Param<double> to_x_m = param("to_x_m", 1.0).unit("m").doc("and ends at this one");

  void begin(const dmrp::MetricTrial& trial) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  struct Walk {
    double last_x_m;
    double last_t_s;
    double from_s;  // NaN until the line is crossed
    double to_s;
  };
  std::map<std::uint64_t, Walk> walks_;  // by id
};

}  // namespace dmrp::rimea
