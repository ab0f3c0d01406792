// SPDX-License-Identifier: MIT
// unequal_robots.hpp: whether the robots of a problem may be planned as points on one grid.
#pragma once

#include <dmrp/plugin.hpp>
#include <optional>
#include <string>

namespace dmrp::planners {

// Two robots for which a search on one graph does not do, and the numbers that show it, in one line: their outlines can
// touch although they neither share nor swap cells (nor pass or cross on diagonals), or their grids differ. Nothing if
// there are none.
std::optional<std::string> find_unequal_robots(const PlanningProblem& problem);

// The line with which a planner refuses such robots.
inline std::string refusal(const std::string& unequal) {
  return unequal + "; of the built-in planners cbs, ecbs, eecbs and sipp plan for them";
}

}  // namespace dmrp::planners
