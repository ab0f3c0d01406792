// SPDX-License-Identifier: MIT
// A planner plans, plans again with its first plan in force, and the trial ends.
#include <memory>

#include "host/check/rehearsal/rehearsal.hpp"
#include "host/check/rehearsal/stage_extensions.hpp"
#include "host/plans/planning.hpp"

namespace dmrp::host {

namespace {

class PlannerCalls {
 public:
  PlannerCalls(Instance& instance, const PluginInfo& info, Stage& stage)
      : instance_(instance),
        info_(info),
        stage_(stage),
        extensions_(instance, info, stage, 0),
        inputs_(stage.settings.grown_bytes) {}

  bool next(Outputs& outputs) {
    if (call_++ == 0 && plan(nullptr, outputs)) return true;
    if (call_ == 2) {
      std::vector<PathPosition> positions;
      for (const core::RobotState& robot : stage_.world.robots()) {
        const dmrp_vec2 here = {robot.pose.x, robot.pose.y};
        positions.push_back({here, here});
      }
      const InForce in_force = {first_.view(), positions};
      plan(&in_force, outputs);
    }
    const dmrp_trial_end end = {sizeof(end), DMRP_ENDING_TIME_LIMIT, 0, nullptr, 0, sizeof(dmrp_robot_end)};
    instance_.end_trial(end, 0, stage_budget_ns);
    return false;
  }

 private:
  // Whether there is a plan.
  bool plan(const InForce* in_force, Outputs& outputs) {
    StagedProblem staged;
    stage_problem(stage_.variant, stage_.world, in_force, stage_budget_ns, staged);
    inputs_.clear();
    const dmrp_planning_problem& problem = grown(staged.c);
    inputs_.seal();
    const PlannerAnswer answer = call_planner(instance_, problem, 0);
    outputs.push_back(answer.status);
    for (const auto& path : answer.paths)
      for (const dmrp_waypoint& waypoint : path)
        outputs.insert(outputs.end(), {waypoint.x, waypoint.y, waypoint.theta, static_cast<double>(waypoint.t_ns),
                                       static_cast<double>(waypoint.goal_index)});
    if (answer.paths.empty()) return false;
    const PlanVerdict verdict =
        validate_plan(staged.c, answer.paths, info_.connectivity, [&](auto from, auto to, double radius_m) {
          return stage_.variant.geometry->sweep_is_free(from, to, radius_m);
        });
    if (const std::string breach = breach_of(verdict, info_); !breach.empty())
      throw PluginFault(fault_kind::bad_output, instance_.site("plan", 0), breach);
    first_.paths = answer.paths;
    first_.revision = problem.revision;
    return true;
  }

  const dmrp_planning_problem& grown(const dmrp_planning_problem& problem) {
    dmrp_planning_problem& out = *inputs_.one(problem);
    out.grid = inputs_.one(*problem.grid);
    dmrp_planning_robot* const robots = inputs_.array(problem.robots, problem.robot_count);
    out.robots = robots;
    out.robot_stride = inputs_.stride<dmrp_planning_robot>();
    for (std::uint32_t i = 0; i < problem.robot_count; ++i) {
      dmrp_planning_robot& robot = inputs_.at(robots, i);
      robot.goals = inputs_.array(robot.goals, robot.goal_count);
      robot.goal_stride = inputs_.stride<dmrp_goal>();
      robot.grid = inputs_.one(*robot.grid);
    }
    if (problem.in_force_count == 0) return out;
    out.in_force = inputs_.paths(problem.in_force, problem.in_force_count);
    out.in_force_stride = inputs_.stride<dmrp_path>();
    return out;
  }

  Instance& instance_;
  const PluginInfo& info_;
  Stage& stage_;
  StageExtensions extensions_;
  Inputs inputs_;
  int call_ = 0;
  Plan first_;
};

}  // namespace

Calls planner_calls(Instance& instance, const PluginInfo& info, Stage& stage) {
  return [calls = std::make_shared<PlannerCalls>(instance, info, stage)](Outputs& outputs) {
    return calls->next(outputs);
  };
}

}  // namespace dmrp::host
