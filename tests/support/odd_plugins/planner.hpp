// SPDX-License-Identifier: MIT
// planner.hpp: plans straight along x, one cell a step.
#pragma once

#include <dmrp/ext/annotate.h>
#include <dmrp/global_planner.h>

#include <limits>

#include "tests/support/odd_plugins/grown.hpp"
#include "tests/support/odd_plugins/instance.hpp"

namespace dmrp::test {

inline std::int32_t give_path(const dmrp_instance& self, const dmrp_planning_problem& problem, std::uint32_t index,
                              dmrp_plan_sink* sink) {
  const dmrp_planning_robot& robot = *DMRP_AT(dmrp_planning_robot, problem.robots, problem.robot_stride, index);
  GrownArray<dmrp_waypoint> waypoints(self.extra("waypoint"));
  std::int64_t t_ns = problem.effective_from_ns;
  for (double x = robot.start.x; x <= robot.goals->pose.x + 1e-6; x += problem.grid->resolution_m) {
    waypoints.push_back({x, robot.start.y, std::numeric_limits<double>::quiet_NaN(), t_ns, 0, 0});
    t_ns += problem.step_duration_ns;
  }
  if (self.is("reserved waypoint")) waypoints.push_back({robot.goals->pose.x, robot.start.y, 0.0, t_ns, 0, 7});
  const std::uint32_t flags = self.is("unknown flags") ? 8 : self.is("partial") ? DMRP_PATH_PARTIAL : 0;
  const Grown<dmrp_path> path({0, waypoints.count(), waypoints.stride(), flags, waypoints.data()}, self.extra("path"));
  return sink->path(sink, index, path.get());
}

inline std::int32_t plan(dmrp_instance* self, const dmrp_planning_problem* problem, dmrp_plan_sink* sink) {
  for (std::uint32_t i = 0; i < problem->robot_count; ++i)
    if (give_path(*self, *problem, i, sink) != DMRP_OK) return self->error("the host refuses the path");
  return self->status_of("plan");
}

inline constexpr dmrp_global_planner planner_table = {sizeof(dmrp_global_planner), 0, &plan};

}  // namespace dmrp::test
