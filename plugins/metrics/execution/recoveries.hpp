// SPDX-License-Identifier: MIT
// recoveries.hpp: how often robots went through a recovery, and by which steps.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <string>
#include <vector>

namespace dmrp::metrics {

class Recoveries final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  struct Recovery {
    std::size_t robot;
    std::int64_t from_ns;
    std::int64_t to_ns;
    std::string steps;  // "spin, wait"
    Vec2 place;         // where it began
  };

  void close(std::size_t robot, std::int64_t now_ns);

  std::vector<Recovery> recoveries_;  // in order of their beginnings
  std::vector<std::int64_t> open_;    // by robot, in recoveries_; -1: it does not recover
  std::vector<double> counts_;        // by robot; undefined if planning failed
};

}  // namespace dmrp::metrics
