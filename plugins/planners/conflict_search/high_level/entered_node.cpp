// SPDX-License-Identifier: MIT
#include "planners/conflict_search/high_level/entered_node.hpp"

#include <algorithm>
#include <cassert>

namespace dmrp::planners {

namespace {

// An estimate of the longest path: the conflict table grows slowly beyond it.
std::int32_t expected_steps(const Problem& problem, const std::vector<TourTable>& tables) {
  std::int32_t longest = 0;
  for (std::size_t i = 0; i < tables.size(); ++i)
    longest = std::max(longest, tables[i].distance(0, problem.agents[i].start));
  return longest + longest / 4;
}

}  // namespace

EnteredNode::EnteredNode(ConstraintTree& tree, const SearchContext& context)
    : tree_(tree),
      mdds_(context.mdds),
      paths_(context.problem.agents.size()),
      signatures_(context.problem.agents.size()),
      known_mdds_(context.problem.agents.size()),
      occupied_(context.problem.graph, context.problem.agents.size(), expected_steps(context.problem, context.tables)) {
}

void EnteredNode::enter(NodeId id) {
  assert(id >= 0 && id < tree_.node_count());
  if (id_ == id) return;
  id_ = id;
  mdds_.trim();
  tree_.gather_signatures(id, signatures_);
  tree_.gather_paths(id, paths_);
  for (const std::int32_t agent : tree_.members()) occupied_.set(agent, path_of(agent).locations);
  tree_.gather_conflicts(id, conflicts_);
  pairs_.clear();
  for (const std::uint32_t index : conflicts_) {
    const Conflict& conflict = tree_.conflict(index);
    if (const AgentPair pair(conflict.a, conflict.b); pairs_.empty() || pairs_.back() != pair) pairs_.push_back(pair);
  }
}

void EnteredNode::leave() {
  id_ = no_node;
  for (const std::int32_t agent : tree_.members()) occupied_.set(agent, {});
}

const Mdd* EnteredNode::mdd_of(std::int32_t agent) {
  KnownMdd& known = known_mdds_[static_cast<std::size_t>(agent)];
  if (const std::uint64_t signature = signature_of(agent); !known.mdd || known.signature != signature) {
    gather_constraints(agent, constraints_);
    known = {signature, mdds_.get(agent, constraints_, path_of(agent).lower_bound)};
  }
  return known.mdd.get();
}

}  // namespace dmrp::planners
