// SPDX-License-Identifier: MIT
// plan_figures.hpp: the cost, makespan and turns of a plan, computed from its paths.
#pragma once

#include <dmrp/global_planner.h>

#include <cstdint>
#include <string>

#include "host/plans/plan_validator.hpp"

namespace dmrp::host {

// Of a valid plan. A robot's path ends where it finally rests at its last goal.
struct PlanFigures {
  double cost = 0.0;          // sum over robots of lengths in cells (1, sqrt 2 diagonally) and waits at 1 a step;
                              // waits are free in any-angle plans
  std::int64_t makespan = 0;  // steps until the last robot arrives
  std::int64_t turns =
      0;  // changes of direction between consecutive moves, of all robots; waits in between do not matter
};

PlanFigures figures_of(const dmrp_planning_problem& problem, const PlannedPaths& paths, std::uint32_t connectivity);

// CSV `agent,t,x,y`: agents from 0, t in steps, x the column, y the row from the top of the grid, all from 0; one line
// per waypoint, waits included, until the agent arrives. Fractions of cells and steps occur in any-angle plans only.
std::string paths_csv(const dmrp_planning_problem& problem, const PlannedPaths& paths);

}  // namespace dmrp::host
