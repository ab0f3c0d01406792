// SPDX-License-Identifier: MIT
// plan_figures.hpp: what a plan's paths amount to, counted from the paths themselves.
#pragma once

#include <dmrp/global_planner.h>

#include <cstdint>
#include <string>

#include "host/trial/plan_validator.hpp"

namespace dmrp::host {

// Of a valid plan. A robot's path ends when it stays at its last goal for good: what comes after is rest.
struct PlanFigures {
  double cost = 0.0;          // sum over robots of lengths in cells (1, sqrt 2 diagonally) and waits at 1 a step;
                              // waits cost nothing to a planner that plans at any angle
  std::int64_t makespan = 0;  // steps until the last robot is there
  std::int64_t turns = 0;     // changes of direction between moves, waits in between or not, of all robots
};

PlanFigures figures_of(const dmrp_planning_problem& problem, const PlannedPaths& paths, std::uint32_t connectivity);

// CSV `agent,t,x,y`: agents from 0, t in steps, x the column, y the row from the top of the grid, all from 0; one line
// a waypoint, waits included, until the agent is there. Fractions of cells and steps only in plans at any angle.
std::string paths_csv(const dmrp_planning_problem& problem, const PlannedPaths& paths);

}  // namespace dmrp::host
