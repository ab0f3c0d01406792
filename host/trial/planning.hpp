// SPDX-License-Identifier: MIT
// planning.hpp: asks the global planner for a plan, checks it, and keeps the plan in force.
#pragma once

#include <dmrp/global_planner.h>
#include <dmrp/metric.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/world/world.hpp"
#include "host/plugins/instance.hpp"
#include "host/trial/plan_validator.hpp"
#include "host/trial/variant_world.hpp"

namespace dmrp::host {

// A named number that a planner told of its work.
struct PlanStatistic {
  std::string name;
  double value;
};

// A plan as it came out of the planner, and the C structs over it.
class Plan {
 public:
  PlannedPaths paths;  // empty if there is no plan
  std::vector<PlanStatistic> statistics;
  std::uint64_t revision = 0;
  std::int32_t status = DMRP_NO_SOLUTION;
  std::int64_t from_ns = 0;
  std::int64_t step_duration_ns = 0;
  std::int64_t planning_ns = 0;
  std::uint32_t conflicts = 0;  // of an uncoordinated planner
  bool asked = false;           // the planner was: robots could be put on distinct cells

  bool exists() const { return !paths.empty(); }

  // Valid until the plan changes or moves.
  const dmrp_plan& view();

 private:
  std::vector<dmrp_path> c_paths_;
  std::vector<dmrp_statistic> c_statistics_;
  dmrp_plan c_{};
};

// A planning problem and the arrays behind it; `c` points into this struct.
struct StagedProblem {
  StagedProblem() = default;
  StagedProblem(const StagedProblem&) = delete;
  StagedProblem& operator=(const StagedProblem&) = delete;

  std::vector<std::vector<dmrp_goal>> goals;
  std::vector<dmrp_planning_robot> robots;
  dmrp_grid grid{};
  dmrp_planning_problem c{};
};

// A robot on its path: now, and when a plan that is made now takes effect, by the times of the path.
struct OnTheWay {
  dmrp_vec2 next{};       // the waypoint that it goes to
  dmrp_vec2 then{};       // where it will be; where it is, if the plan takes effect at once
  dmrp_vec2 next_then{};  // where it will go next
};

// What holds while a plan is made that is not the first.
struct InForce {
  const dmrp_plan& plan;
  std::span<const OnTheWay> robots;
};

// The problem for the robots where they are now, or will be when the plan takes effect; `in_force` being nullptr for
// the first plan. False where they cannot be put on distinct cells.
bool stage_problem(const VariantWorld& variant, const core::World& world, const InForce* in_force,
                   std::int64_t time_budget_ns, StagedProblem& problem);

// What came out of one call of plan(), not yet checked.
struct PlannerAnswer {
  std::int32_t status = DMRP_NO_SOLUTION;
  std::int64_t planning_ns = 0;
  std::string text;    // of set_error()
  PlannedPaths paths;  // one a robot, or none where there is no plan
  std::vector<PlanStatistic> statistics;
};

// Calls plan() once; `step`: the physics steps since the trial's start. Throws PluginFault.
PlannerAnswer ask_planner(Instance& planner, const dmrp_planning_problem& problem, std::int64_t step);

// How a plan breaks what its planner promises, in one line; "" if it does not.
std::string breach_of(const PlanVerdict& verdict, const PluginInfo& info);

// Plans for the robots where they are now; `time_budget_ns` is wall time, `step` the physics steps since the start.
// No plan (NO_SOLUTION, TIMEOUT, or robots that cannot be put on distinct cells) is a Plan that does not exist().
// Throws PluginFault, of kind bad_output where the plan breaks the contract.
Plan make_plan(Instance& planner, const PluginInfo& info, const VariantWorld& variant, const core::World& world,
               const InForce* in_force, std::int64_t time_budget_ns, std::int64_t step);

// A robot's path (at least one waypoint) as its controller gets it: where a goal lies off its cell's centre, the way
// there is one leg more, and on a tour the way back to the centre another. Each takes `step_duration_ns`. `goals`: all
// of the robot's, by index.
std::vector<dmrp_waypoint> path_to_drive(const std::vector<dmrp_waypoint>& planned, std::span<const dmrp_goal> goals,
                                         std::int64_t step_duration_ns);

}  // namespace dmrp::host
