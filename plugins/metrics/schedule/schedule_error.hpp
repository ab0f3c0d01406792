// SPDX-License-Identifier: MIT
// schedule_error.hpp: how late robots pass the waypoints of their plans.
#pragma once

#include "metrics/measure/bases.hpp"

namespace dmrp::metrics {

// A place of the path, and when the plan has the robot reach it.
struct Due {
  double arc_m;
  std::int64_t t_ns;
};

struct Schedule {
  std::vector<Due> dues;  // of the path in force, without its beginning
  std::size_t next = 0;   // the first one that the robot has not passed
  CompensatedSum late_s;
  CompensatedSum off_s;
  std::size_t passed = 0;

  double error_s() const { return passed > 0 ? late_s.value() / static_cast<double>(passed) : undefined; }
  double deviation_s() const { return passed > 0 ? off_s.value() / static_cast<double>(passed) : undefined; }
};

class ScheduleError final : public RobotMetric<Schedule> {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.schedule_error", "Schedule error")
        .summary("how late the robots pass the waypoints of their plans")
        .source("own: the deviation from the plan in time, as PFD (Hu et al., DMRP-Bench, ICRA 2026) is that in space")
        .value("schedule_error_s", "s", Direction::none, system_and_robots,
               "mean over the waypoints that the robot passes of the time of its passage minus the plan's; a wait is "
               "one waypoint, due when the plan reaches it; a new plan drops those left of the old one; undefined for "
               "a robot that passes none")
        .value("schedule_deviation_s", "s", lower_is_better, system_and_robots,
               "mean over the same waypoints of the absolute difference; undefined for a robot that passes none",
               never_negative);
  }

  void begin(const MetricTrial& trial) override {
    RobotMetric::begin(trial);
    revision_ = 0;
  }

  void observe(const Sample& sample) override {
    if (sample.plan.size() == 0) return;
    if (sample.plan->revision != revision_) follow(sample.plan);
    constexpr double rounding_m = 1e-9;  // arcs are summed in two places
    for (std::size_t robot = 0; robot < states_.size(); ++robot) {
      Schedule& schedule = states_[robot];
      const double reached_m = sample.robots[robot].progress_m + rounding_m;
      for (; schedule.next < schedule.dues.size() && schedule.dues[schedule.next].arc_m <= reached_m; ++schedule.next) {
        const double late_s = static_cast<double>(sample.t_ns - schedule.dues[schedule.next].t_ns) / 1e9;
        schedule.late_s.add(late_s);
        schedule.off_s.add(std::abs(late_s));
        ++schedule.passed;
      }
    }
  }

  void finish(const TrialEnd&, MetricSink& sink) override {
    give_mean(sink, "schedule_error_s", &Schedule::error_s);
    give_mean(sink, "schedule_deviation_s", &Schedule::deviation_s);
  }

 private:
  void follow(const Plan& plan) {
    revision_ = plan->revision;
    for (std::size_t robot = 0; robot < states_.size(); ++robot) {
      Schedule& schedule = states_[robot];
      schedule.dues.clear();
      schedule.next = 0;
      const Path path = plan.path(robot);
      double arc_m = 0.0;
      for (std::size_t i = 1; i < path.size(); ++i) {
        const double length_m = toolkit::distance(toolkit::position(path[i - 1]), toolkit::position(path[i]));
        if (length_m == 0.0) continue;
        arc_m += length_m;
        schedule.dues.push_back({arc_m, path[i].t_ns});
      }
    }
  }

  std::uint64_t revision_ = 0;
};

}  // namespace dmrp::metrics
