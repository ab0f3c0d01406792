// SPDX-License-Identifier: MIT
// planning.hpp: states the planning problem, calls the global planner and validates its plan.
#pragma once

#include <dmrp/global_planner.h>
#include <dmrp/metric.h>

#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/world/world.hpp"
#include "host/plans/plan_validator.hpp"
#include "host/plugins/instance.hpp"
#include "host/world/variant_world.hpp"

namespace dmrp::host {

// A named number that a planner reports of a call.
struct PlanStatistic {
  std::string name;
  double value;
};

// As JSON, which has no infinity: as text.
void to_json(nlohmann::json& json, const PlanStatistic& statistic);
void from_json(const nlohmann::json& json, PlanStatistic& statistic);

// What one call of plan() gives.
struct PlannerAnswer {
  std::int32_t status = DMRP_NO_SOLUTION;
  std::int64_t planning_ns = 0;   // wall time
  std::int64_t processor_ns = 0;  // of all threads of the process
  std::string text;               // of set_error()
  PlannedPaths paths;             // one per robot; empty if there is no plan
  std::vector<bool> partial;      // parallel to them: it ends before the last goal; empty: none does
  std::vector<PlanStatistic> statistics;
};

// A plan, and the C structs that view it.
class Plan : public PlannerAnswer {
 public:
  std::uint64_t revision = 0;
  std::int64_t from_ns = 0;
  std::int64_t step_duration_ns = 0;
  std::uint32_t conflicts = 0;  // of an uncoordinated planner
  bool answered = false;        // false where the robots cannot be put on distinct cells

  bool exists() const { return !paths.empty(); }
  bool is_partial(std::size_t robot) const { return !partial.empty() && partial[robot]; }

  // Valid until the plan changes or moves.
  const dmrp_plan& view();

 private:
  std::vector<dmrp_path> c_paths_;
  std::vector<dmrp_statistic> c_statistics_;
  dmrp_plan c_{};
};

// A planning problem and its arrays; `c` points into this struct.
struct StagedProblem {
  StagedProblem() = default;
  StagedProblem(const StagedProblem&) = delete;
  StagedProblem& operator=(const StagedProblem&) = delete;

  std::vector<std::vector<dmrp_goal>> goals;
  std::vector<dmrp_planning_robot> robots;
  dmrp_grid grid{};                        // for all robots
  std::map<std::string, dmrp_grid> grids;  // by type of robot
  dmrp_planning_problem c{};
};

// A robot on its path: now, and when a plan that is made now takes effect, as the times of the path predict.
struct PathPosition {
  dmrp_vec2 next_waypoint{};
  dmrp_vec2 position_then{};    // its position now, if the plan takes effect at once
  std::int64_t waiting_ns = 0;  // since its last progress
};

// The plan in force while the next one is made.
struct InForce {
  const dmrp_plan& plan;
  std::span<const PathPosition> robots;
};

// States the problem for the robots' positions when the plan takes effect. `in_force` is nullptr for the first plan.
// False if the robots cannot be put on distinct cells.
bool stage_problem(const VariantWorld& variant, const core::World& world, const InForce* in_force,
                   std::int64_t time_budget_ns, StagedProblem& problem);

// States the first problem of a trial of a checked scenario.
void stage_first_problem(const Experiment& experiment, const VariantWorld& variant, StagedProblem& problem);

// Calls plan() once; `step`: the physics steps since the trial's start. Throws PluginFault.
PlannerAnswer call_planner(Instance& planner, const dmrp_planning_problem& problem, std::int64_t step);

// How a plan breaks the contract, or a promise of its planner, in one line; "" if it does not.
std::string breach_of(const PlanVerdict& verdict, const PluginInfo& info);

// Gives the plan for a problem: by a call of the planner, not yet validated, or as it was stored.
using PlanSource = std::function<PlannerAnswer(const dmrp_planning_problem& problem)>;

// Cuts paths that are longer than the problem's window, if it has one, and makes them partial.
void cut_to_window(const dmrp_planning_problem& problem, PlannerAnswer& answer);

// Makes a plan of the planner `info`. `time_budget_ns` is wall time, `step` the physics steps since the start. The plan
// does not exist() after NO_SOLUTION or TIMEOUT, or if the robots cannot be put on distinct cells. Throws PluginFault, of
// kind bad_output if the plan breaks the contract.
Plan make_plan(const PlanSource& source, const PluginInfo& info, const VariantWorld& variant, const core::World& world,
               const InForce* in_force, std::int64_t time_budget_ns, std::int64_t step);

// The path that a robot's controller follows. Plans lead to the centre of a goal's cell: where the goal is not there, this
// appends a leg to the goal and, on a tour, a leg back to the centre. Each takes `step_duration_ns`. A `partial` plan
// does not end at a goal. `planned` has one waypoint at least; `goals` are all of the robot's, by index.
std::vector<dmrp_waypoint> path_to_drive(const std::vector<dmrp_waypoint>& planned, bool partial,
                                         std::span<const dmrp_goal> goals, std::int64_t step_duration_ns);

}  // namespace dmrp::host
