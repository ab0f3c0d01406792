// SPDX-License-Identifier: MIT
// cpp/global_planner.hpp: the base class of global planners; the contract is in ../global_planner.h.
#pragma once

#include <cstdint>
#include <stdexcept>

#include "../global_planner.h"
#include "path.hpp"
#include "plugin_base.hpp"

namespace dmrp {

// dmrp_planning_robot with its goals as a span.
struct PlanningRobot : dmrp_planning_robot {
  Span<Goal> goals() const { return {dmrp_planning_robot::goals, goal_count, goal_stride}; }
};

// dmrp_planning_problem with spans for arrays. Valid until plan() returns.
struct PlanningProblem {
  explicit PlanningProblem(const dmrp_planning_problem& c)
      : revision(c.revision),
        now_ns(c.now_ns),
        effective_from_ns(c.effective_from_ns),
        step_duration_ns(c.step_duration_ns),
        time_budget_ns(c.time_budget_ns),
        window_steps(c.window_steps),
        grid(*c.grid),
        robots(c.robots, c.robot_count, c.robot_stride),
        in_force(c.in_force, c.in_force_count, c.in_force_stride) {}

  std::uint64_t revision;
  std::int64_t now_ns;
  std::int64_t effective_from_ns;
  std::int64_t step_duration_ns;
  std::int64_t time_budget_ns;
  std::uint32_t window_steps;  // 0: the whole way
  const Grid& grid;
  Span<PlanningRobot> robots;
  Paths in_force;  // by robot; empty for the first plan
};

inline Span<Goal> goals(const PlanningRobot& robot) {
  return robot.goals();
}

class PlanSink {
 public:
  explicit PlanSink(dmrp_plan_sink* c) : c_(c) {}

  // `partial`: it ends before the robot's last goal.
  void path(std::uint32_t robot, const std::vector<Waypoint>& waypoints, bool partial = false) {
    const dmrp_path c = {sizeof(c), static_cast<std::uint32_t>(waypoints.size()), sizeof(Waypoint),
                         partial ? DMRP_PATH_PARTIAL : 0, waypoints.data()};
    path(robot, c);
  }
  // For waypoints with more fields than these headers know.
  void path(std::uint32_t robot, const dmrp_path& c) {
    check(c_->path(c_, robot, &c), "the path of robot " + std::to_string(robot));
  }
  void statistic(const char* name, double value) { check(c_->statistic(c_, name, value), name); }

 private:
  static void check(std::int32_t status, const std::string& what) {
    if (status == DMRP_OUT_OF_MEMORY) throw std::bad_alloc();
    if (status != DMRP_OK) throw std::logic_error("the host refused " + what);
  }
  dmrp_plan_sink* c_;
};

class GlobalPlanner : public Plugin {
 public:
  virtual Status plan(const PlanningProblem& problem, PlanSink& sink) = 0;

  DMRP_LOCAL static constexpr std::uint32_t interface_kind = DMRP_KIND_GLOBAL_PLANNER;
  static constexpr dmrp_global_planner interface_table() { return {sizeof(dmrp_global_planner), 0, &call_plan}; }

 private:
  static std::int32_t call_plan(dmrp_instance* self, const dmrp_planning_problem* problem, dmrp_plan_sink* sink) {
    auto& planner = detail::from_instance<GlobalPlanner>(self);
    return PluginAccess::guarded(planner, [&] {
      PlanSink out(sink);
      return planner.plan(PlanningProblem(*problem), out);
    });
  }
};

}  // namespace dmrp
