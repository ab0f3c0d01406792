// SPDX-License-Identifier: MIT
// arrivals.hpp: the outcome in terms of multi-agent path finding: success rates, flowtime, makespan, throughput.
#pragma once

#include "metrics/measure/values.hpp"

namespace dmrp::metrics {

class Arrivals final : public Metric {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.arrivals", "Arrivals")
        .summary("arrivals at the last goals, their times, and goals reached per time")
        .source(
            "ISR, CSR, makespan, throughput: Skrynnik et al., POGEMA, ICLR 2025; flowtime: Stern et al., Multi-Agent "
            "Pathfinding, SoCS 2019")
        .value("isr", "1", higher_is_better, system_and_robots,
               "individual success rate: 1 if the robot was at its last goal at the end, else 0. Unlike in success, a "
               "robot that circled counts, whatever the experiment excludes",
               share_range)
        .value("csr", "1", higher_is_better, Subjects::system, "1 if isr is 1 for every robot, else 0", share_range)
        .value("flowtime", "s", lower_is_better, Subjects::system,
               "sum over robots of the time of final arrival; undefined unless all arrive", never_negative)
        .value("makespan", "s", lower_is_better, Subjects::system,
               "the last robot's time of final arrival; undefined unless all arrive", never_negative)
        .value("throughput", "1/s", higher_is_better, system_and_robots,
               "goals that the robot reached (every goal of a tour) / mission time; 0 if planning failed; system: sum "
               "over robots",
               never_negative);
  }

  void begin(const MetricTrial&) override { goal_index_.assign(world().robots().size(), 0); }

  void observe(const Sample& sample) override {
    for (std::size_t robot = 0; robot < goal_index_.size(); ++robot)
      goal_index_[robot] = sample.robots[robot].goal_index;
  }

  void finish(const TrialEnd& end, MetricSink& sink) override {
    std::vector<double> arrived, throughput;
    std::int64_t sum_ns = 0, last_ns = 0;
    for (std::size_t robot = 0; robot < goal_index_.size(); ++robot) {
      const std::int64_t arrival_ns = end.robots[robot].arrival_ns;
      const bool at_goal = arrival_ns >= 0;
      const std::uint32_t goals = at_goal ? world().robots()[robot].goal_count : goal_index_[robot];
      arrived.push_back(at_goal ? 1.0 : 0.0);
      throughput.push_back(goals > 0 ? goals / in_seconds(end.t_ns) : 0.0);  // the mission time is 0 if planning failed
      sum_ns += arrival_ns;
      last_ns = std::max(last_ns, arrival_ns);
    }
    give(sink, "isr", &mean_of_defined, arrived);
    give(sink, "throughput", &sum_of_defined, throughput);
    const double csr = least_of_defined(arrived);
    sink.system("csr", csr);
    sink.system("flowtime", csr == 1.0 ? in_seconds(sum_ns) : undefined);
    sink.system("makespan", csr == 1.0 ? in_seconds(last_ns) : undefined);
  }

 private:
  std::vector<std::uint32_t> goal_index_;  // by robot: its current goal at the last sample
};

}  // namespace dmrp::metrics
