// SPDX-License-Identifier: MIT
// ecbs.hpp: enhanced conflict-based search: paths without conflicts whose sum of costs is within a factor of the least.
#pragma once

#include "planners/conflict_search/planner.hpp"

namespace dmrp::planners {

// ECBS(w) of Barer et al. 2014: focal search on the low level (a path with few conflicts and a cost within a factor w
// of the least) and on the high level (the node with fewest conflicting pairs within a factor w of the lower bound).
//
// Reports `cost` and `lower_bound`: cost <= suboptimality * lower_bound, and no plan costs less than `lower_bound`.
class Ecbs final : public ConflictSearchPlanner {
 public:
  static Descriptor describe();

  Param<double> suboptimality =
      param("suboptimality", 1.2).unit("1").range(1.0, 100.0).doc("the cost is at most this factor times the least");

 protected:
  ConflictSearchOptions options() const override;
};

}  // namespace dmrp::planners
