// SPDX-License-Identifier: MIT
// open_standstill.hpp: robots that stand although they may drive and nobody is in their way.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/referee_classes.hpp"

namespace dmrp::metrics {

class OpenStandstill final : public Metric {
 public:
  static Descriptor describe();
  Param<double> lasting_s = param("lasting_s", 15.0).unit("s").range(0.0, 10000.0).doc("shorter ones do not count");

  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  struct Spell {
    std::int64_t from_ns;
    std::int64_t to_ns;
  };

  void close(std::size_t robot);

  RefereeClasses classes_;
  std::vector<char> measured_;                   // by robot: was active
  std::vector<Spell> standing_;                  // by robot; ends where it begins while it does not stand
  std::vector<std::vector<Spell>> standstills_;  // those that lasted, by robot
};

}  // namespace dmrp::metrics
