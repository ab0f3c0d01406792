// SPDX-License-Identifier: MIT
// ecbs.hpp: enhanced conflict-based search: paths without conflicts, of a sum of costs within a bound of the least.
#pragma once

#include "planners/conflict_search/planner.hpp"

namespace dmrp::planners {

// ECBS(w) of Barer et al. 2014: focal search on the low level (a path within w of the least, with fewest conflicts)
// and on the high level (the node within w of the lower bound with fewest pairs in conflict).
//
// cost <= suboptimality * lower_bound, and no plan costs less than `lower_bound`; both are reported.
class Ecbs final : public ConflictSearchPlanner {
 public:
  static Descriptor describe();

  Param<double> suboptimality =
      param("suboptimality", 1.2).unit("1").range(1.0, 100.0).doc("the cost is at most so many times the least");
  Param<bool> safe_intervals =
      param("safe_intervals", true).doc("plan single robots over safe intervals; else step by step");
  Param<std::int64_t> node_limit = param("node_limit", 10'000'000)
                                       .unit("1")
                                       .range(1, 1'000'000'000)
                                       .doc("constraint-tree nodes after which the search gives up");

 protected:
  ConflictSearchOptions options() const override;
};

}  // namespace dmrp::planners
