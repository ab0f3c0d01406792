// SPDX-License-Identifier: MIT
#include "metrics/schedule/schedule_error.hpp"

#include <cmath>
#include <dmrp/toolkit/vec2.hpp>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/per_robot.hpp"

namespace dmrp::metrics {

Descriptor ScheduleError::describe() {
  return describe_metric("dmrp.metric.schedule_error", "Schedule error")
      .summary("how late the robots pass the waypoints of their plans")
      .source("own: the deviation from the plan in time, as PFD (Hu et al., DMRP-Bench, ICRA 2026) is that in space")
      .value("schedule_error_s", "s", Direction::none, Subjects::system_and_robots,
             "mean over the waypoints that the robot passes of the time of its passage minus the plan's; a wait is one "
             "waypoint, due when the plan reaches it; a new plan drops those left of the old one; undefined for a "
             "robot that passes none")
      .value("schedule_deviation_s", "s", Direction::lower_is_better, Subjects::system_and_robots,
             "mean over the same waypoints of the absolute difference; undefined for a robot that passes none");
}

void ScheduleError::begin(const dmrp_plan*) {
  revision_ = 0;
  schedules_.assign(world().robots().size(), {});
}

void ScheduleError::follow(const dmrp_plan& c_plan) {
  revision_ = c_plan.revision;
  const Plan plan(c_plan);
  for (std::size_t robot = 0; robot < schedules_.size(); ++robot) {
    Schedule& schedule = schedules_[robot];
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

void ScheduleError::observe(const Sample& sample) {
  if (!sample.plan || sample.plan->path_count == 0) return;
  if (sample.plan->revision != revision_) follow(*sample.plan);
  constexpr double rounding_m = 1e-9;  // arcs are summed in two places
  for (std::size_t robot = 0; robot < schedules_.size(); ++robot) {
    Schedule& schedule = schedules_[robot];
    const double reached_m = sample.robots[robot].progress_m + rounding_m;
    for (; schedule.next < schedule.dues.size() && schedule.dues[schedule.next].arc_m <= reached_m; ++schedule.next) {
      const double late_s = static_cast<double>(sample.t_ns - schedule.dues[schedule.next].t_ns) / 1e9;
      schedule.late_s.add(late_s);
      schedule.off_s.add(std::abs(late_s));
      ++schedule.passed;
    }
  }
}

void ScheduleError::finish(const TrialEnd&, MetricSink& sink) {
  const auto mean_of = [](const Schedule& schedule, const CompensatedSum& sum) {
    return schedule.passed > 0 ? sum.value() / static_cast<double>(schedule.passed) : undefined;
  };
  give_mean(sink, "schedule_error_s",
            values_of(schedules_, [&](const Schedule& schedule) { return mean_of(schedule, schedule.late_s); }));
  give_mean(sink, "schedule_deviation_s",
            values_of(schedules_, [&](const Schedule& schedule) { return mean_of(schedule, schedule.off_s); }));
}

}  // namespace dmrp::metrics
