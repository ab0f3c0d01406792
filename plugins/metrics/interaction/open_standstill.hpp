// SPDX-License-Identifier: MIT
// open_standstill.hpp: robots that stand although they may drive and nobody is in their way.
#pragma once

#include <utility>

#include "metrics/measure/bases.hpp"
#include "metrics/measure/referee_classes.hpp"

namespace dmrp::metrics {

struct Standstills {
  bool measured = false;      // the robot was active
  Spell now = {0, 0};         // ends where it begins while the robot does not stand
  std::vector<Spell> lasted;  // long enough

  double count() const { return measured ? static_cast<double>(lasted.size()) : undefined; }
};

class OpenStandstill final : public RobotMetric<Standstills> {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.open_standstill", "Standstill in the open")
        .summary("robots that stand although they may drive and nobody is in their way")
        .source("own definition: the class STUCK of dmrp/robot_event.h")
        .value(
            "open_standstills", "1", lower_is_better, system_and_robots,
            "number of times that the referee saw the robot stuck, and not circling, for lasting_s or more: it gained "
            "less than 0.2 m in its last 20 s, no order holds it, and nobody is on the next metre of its course; "
            "system: sum over robots; undefined if planning failed, and in traces of hosts before the referee",
            never_negative);
  }

  Param<double> lasting_s = param("lasting_s", 15.0).unit("s").range(0.0, 10000.0).doc("shorter ones do not count");

  void begin(const MetricTrial& trial) override {
    RobotMetric::begin(trial);
    classes_.begin(states_.size());
  }

  void observe(const Sample& sample) override {
    classes_.observe(sample);
    for (std::size_t robot = 0; robot < states_.size(); ++robot) {
      const auto now = classes_.in_step(robot);
      if (now) states_[robot].measured = true;
      if (now && now->kind == DMRP_CLASS_STUCK && !now->circles)
        states_[robot].now = {now->since_ns, sample.t_ns};
      else
        close(states_[robot]);
    }
  }

  void finish(const TrialEnd&, MetricSink& sink) override {
    for (std::uint32_t robot = 0; robot < states_.size(); ++robot) {
      close(states_[robot]);
      for (const Spell& spell : states_[robot].lasted)
        give_event(sink, "open_standstills", spell, {robot},
                   "robot " + std::to_string(robot) + " stands although nobody is in its way");
    }
    give_of_states(sink, "open_standstills", &sum_of_defined, &Standstills::count);
  }

 private:
  void close(Standstills& own) const {
    const Spell spell = std::exchange(own.now, {0, 0});
    if (spell.to_ns > spell.from_ns && spell.to_ns - spell.from_ns >= std::llround(lasting_s * 1e9))
      own.lasted.push_back(spell);
  }

  RefereeClasses classes_;
};

}  // namespace dmrp::metrics
