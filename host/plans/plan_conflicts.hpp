// SPDX-License-Identifier: MIT
// plan_conflicts.hpp: the conflicts between the robots of a plan, found by cell and step.
#pragma once

#include <dmrp/global_planner.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/scene/step_overlaps.hpp"

namespace dmrp::host {

// The paths of a plan, one per robot.
using PlannedPaths = std::vector<std::vector<dmrp_waypoint>>;

using PlanCell = toolkit::Cell;

struct PlanConflicts {
  std::uint32_t count = 0;
  std::string first;         // of the pair of robots with the lowest numbers, its earliest; in one line
  std::size_t robot = 0;     // the first robot of this pair
  std::size_t waypoint = 0;  // where it is then, or heads for
};

// Of paths on the grid, one cell for each step: vertex, swap, crossing and passing conflicts, and footprints that
// overlap, one for each pair and step; and pairs that share a start. A robot rests in its last cell. Takes time
// proportional to robots x steps and to the number of robots that are near each other.
PlanConflicts find_step_conflicts(const std::vector<std::vector<PlanCell>>& cells, core::StepOverlaps& overlaps);

// Of discs that move linearly between waypoints and rest at the last one: one for each pair and each interval between
// waypoints of either in which they overlap. All positions are finite.
PlanConflicts find_disc_conflicts(const PlannedPaths& paths, const std::vector<double>& radii_m);

}  // namespace dmrp::host
