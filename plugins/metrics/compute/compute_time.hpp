// SPDX-License-Identifier: MIT
// compute_time.hpp: wall time of planner and controller calls, and the share of calls that took too long.
#pragma once

#include <dmrp/status.h>

#include "metrics/measure/values.hpp"

namespace dmrp::metrics {

class ComputeTime final : public Metric {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.compute_time", "Compute time")
        .summary("wall time of planner and controller calls: mean, 99th percentile, missed deadlines")
        .source("own definition; after MRPB 1.0, Wen et al., ICRA 2021: computation cost of a control cycle")
        .channels(DMRP_CHANNEL_CALLS)
        .value("plan_call_mean", "ms", lower_is_better, Subjects::system,
               "mean wall time of all calls of plan(), including replans; undefined without a call", never_negative)
        .wall_clock()
        .value("plan_call_p99", "ms", lower_is_better, Subjects::system,
               "99th percentile of the same by nearest rank; undefined without a call", never_negative)
        .wall_clock()
        .value("plan_missed", "%", lower_is_better, Subjects::system,
               "share of those calls that ran out of their time budget (status TIMEOUT); undefined without a call",
               percent_range)
        .wall_clock()
        .value("control_call_mean", "ms", lower_is_better, system_and_robots,
               "mean wall time of the robot's calls of step(); system: over the calls of all robots, or of step_all(); "
               "undefined without a call",
               never_negative)
        .wall_clock()
        .value("control_call_p99", "ms", lower_is_better, system_and_robots,
               "99th percentile of the same by nearest rank; system: over the calls of all robots; undefined without a "
               "call",
               never_negative)
        .wall_clock()
        .value("control_missed", "%", lower_is_better, system_and_robots,
               "share of those calls that took longer than the control period; system: over the calls of all robots; "
               "undefined without a call",
               percent_range)
        .wall_clock();
  }

  void begin(const MetricTrial&) override {
    planning_ = {};
    control_.assign(world().robots().size(), {});
    central_ = {};
  }

  void observe(const Sample& sample) override {
    for (const Call& call : sample.calls) {
      if (call.kind == DMRP_CALL_PLAN) {
        planning_.durations_ns.push_back(call.duration_ns);
        planning_.missed += call.status == DMRP_TIMEOUT;
      } else if (call.kind == DMRP_CALL_CONTROL) {
        Calls& own = call.robot < control_.size() ? control_[call.robot] : central_;
        own.durations_ns.push_back(call.duration_ns);
        own.missed += call.duration_ns > world()->control_period_ns;
      }
    }
  }

  void finish(const TrialEnd&, MetricSink& sink) override {
    sink.system("plan_call_mean", planning_.mean_ms());
    sink.system("plan_call_p99", planning_.p99_ms());
    sink.system("plan_missed", planning_.missed_percent());
    Calls all = central_;
    for (std::size_t robot = 0; robot < control_.size(); ++robot) {
      const Calls& own = control_[robot];
      sink.robot("control_call_mean", robot, own.mean_ms());
      sink.robot("control_call_p99", robot, own.p99_ms());
      sink.robot("control_missed", robot, own.missed_percent());
      all.durations_ns.insert(all.durations_ns.end(), own.durations_ns.begin(), own.durations_ns.end());
      all.missed += own.missed;
    }
    sink.system("control_call_mean", all.mean_ms());
    sink.system("control_call_p99", all.p99_ms());
    sink.system("control_missed", all.missed_percent());
  }

 private:
  struct Calls {
    std::vector<std::int64_t> durations_ns;
    std::size_t missed = 0;

    double mean_ms() const {
      if (durations_ns.empty()) return undefined;
      std::int64_t sum_ns = 0;
      for (const std::int64_t duration_ns : durations_ns) sum_ns += duration_ns;
      return static_cast<double>(sum_ns) / 1e6 / static_cast<double>(durations_ns.size());
    }

    // nearest rank: the smallest duration that 99 % of the calls do not exceed
    double p99_ms() const {
      if (durations_ns.empty()) return undefined;
      std::vector<std::int64_t> sorted = durations_ns;
      const std::size_t rank = (99 * sorted.size() + 99) / 100;  // 1 is the first
      const auto place = sorted.begin() + static_cast<std::ptrdiff_t>(rank - 1);
      std::nth_element(sorted.begin(), place, sorted.end());
      return static_cast<double>(*place) / 1e6;
    }

    double missed_percent() const {
      if (durations_ns.empty()) return undefined;
      return 100.0 * static_cast<double>(missed) / static_cast<double>(durations_ns.size());
    }
  };

  Calls planning_;
  std::vector<Calls> control_;  // by robot
  Calls central_;               // of a controller of all robots
};

}  // namespace dmrp::metrics
