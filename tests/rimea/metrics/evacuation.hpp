// SPDX-License-Identifier: MIT
// evacuation.hpp: the time until all people have left.
#pragma once

#include <cstddef>
#include <dmrp/plugin.hpp>

namespace dmrp::rimea {

class Evacuation final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp::MetricTrial& trial) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  std::size_t people_ = 0;   // at the last sample
  double deserted_s_ = 0.0;  // since this time nobody is present
};

}  // namespace dmrp::rimea
