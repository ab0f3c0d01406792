// SPDX-License-Identifier: MIT
#include "planners/ecbs/ecbs.hpp"

namespace dmrp::planners {

Descriptor Ecbs::describe() {
  return describe_planner("dmrp.planner.ecbs", "ECBS", "1.0.0")
      .summary("paths without conflicts, of a sum of costs within a bound of the least; focal search on both levels")
      .source(
          "Barer, Sharon, Stern, Felner: Suboptimal variants of the conflict-based search algorithm for the "
          "multi-agent pathfinding problem, SoCS 2014");
}

ConflictSearchOptions Ecbs::options() const {
  ConflictSearchOptions options;
  options.suboptimality = *suboptimality;
  options.selection = Selection::focal;
  return options;
}

}  // namespace dmrp::planners
