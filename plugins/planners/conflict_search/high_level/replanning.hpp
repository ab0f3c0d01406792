// SPDX-License-Identifier: MIT
// replanning.hpp: new paths for some agents of a node: the calls from the high level to the low level.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/conflict_search/high_level/entered_node.hpp"
#include "planners/conflict_search/high_level/options.hpp"
#include "planners/conflict_search/low_level/safe_interval_search.hpp"
#include "planners/conflict_search/low_level/space_time_search.hpp"

namespace dmrp::planners {

// A node that is not in the tree yet.
struct Child {
  Node node;  // its numbers; estimated_cost is the high level's to fill in
  std::vector<Constraint> constraints;
  std::vector<AgentPath> paths;  // of the agents replanned; they lie in `found`
  std::vector<Conflict> conflicts;
  std::vector<LowLevelPath> found;  // a buffer: only the first paths.size() are of this child
};

class Replanner {
 public:
  Replanner(const SearchContext& context, const ConflictSearchOptions& options);

  // See LowLevelRequest.
  void set_conflict_steps(std::int32_t steps) { conflict_steps_ = steps; }

  // All three return false if an agent has no path under the constraints, or if the search was stopped.

  // Plans the agents in this order, each with few conflicts with those before it. Leaves them in `occupied`.
  bool plan_root(const std::vector<std::int32_t>& order, const std::vector<Constraint>& constraints,
                 ConflictTable& occupied, Child& root);
  // A child of the node with further constraints: replans the members whose paths break them.
  bool replan(EnteredNode& node, const std::vector<std::int32_t>& members, const std::vector<Constraint>& constraints,
              Child& child);
  // A child of the node in which these agents are replanned.
  bool replan_agents(EnteredNode& node, const std::vector<std::int32_t>& agents,
                     const std::vector<Constraint>& constraints, Child& child);

  std::int64_t expanded() const { return safe_interval_search_.expanded() + space_time_search_.expanded(); }

 private:
  bool plan(std::int32_t agent, std::int32_t lower_bound, ConflictTable& occupied, Child& child);
  void add_conflicts(std::int32_t agent, PathView path, const ConflictTable& occupied, Child& child) const;

  const Problem& problem_;
  const std::vector<TourTable>& tables_;
  StopSignal& stop_;
  double suboptimality_;
  bool safe_intervals_;
  std::int32_t conflict_steps_ = 0;
  SafeIntervalSearch safe_interval_search_;
  SpaceTimeSearch space_time_search_;
  ConstraintTable constraint_table_;
  std::vector<Constraint> constraints_;  // of the agent to plan
};

}  // namespace dmrp::planners
