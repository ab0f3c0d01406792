// SPDX-License-Identifier: MIT
// plan_validator.hpp: validates plans, independently of the planners.
#pragma once

#include <dmrp/global_planner.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "host/plans/plan_conflicts.hpp"

namespace dmrp::host {

// Whether a disc swept from one point to another stays clear of the static geometry; for any-angle plans.
using SweepIsFree = std::function<bool(dmrp_vec2 from, dmrp_vec2 to, double radius_m)>;

struct PlanVerdict {
  std::string error;            // the first breach of the contract, in one line; empty if there is none
  std::uint32_t conflicts = 0;  // between robots: vertex, swap, crossing, passing, footprint; any angle: discs
  std::string first_conflict;   // in one line
  std::size_t robot = 0;        // of the error, or of the first conflict
  std::size_t waypoint = 0;     // likewise, of this robot
};

// Checks structure (start, strictly growing times, goals in order, rest at the last unless the path is partial), moves (free cells, edge mask,
// one step each; any angle: swept discs) and conflicts between robots (robots rest at their last waypoint): by cells and
// by footprints (step_overlaps.hpp); of plans at any angle, by the circles around the footprints.
// `partial`: parallel to the paths, or empty; only for a problem with a window.
PlanVerdict validate_plan(const dmrp_planning_problem& problem, const PlannedPaths& paths, std::uint32_t connectivity,
                          const SweepIsFree& sweep_is_free, const std::vector<bool>& partial = {});

}  // namespace dmrp::host
