// SPDX-License-Identifier: MIT
#include "planners/conflict_search/high_level/constraint_tree.hpp"

namespace dmrp::planners {

void ConstraintTree::reset(std::size_t agent_count, std::vector<std::int32_t> members) {
  DifferenceTree::reset(agent_count, members.size());
  members_ = std::move(members);
  constraints_.clear();
  splits_.clear();
}

NodeId ConstraintTree::add(Node node, std::span<const AgentPath> paths, std::span<const Constraint> constraints,
                           std::span<const Conflict> conflicts) {
  node.constraints = append(constraints_, constraints);
  return DifferenceTree::add(node, paths, conflicts);
}

std::uint32_t ConstraintTree::add_split(Split split) {
  splits_.push_back(std::move(split));
  return static_cast<std::uint32_t>(splits_.size()) - 1;
}

void ConstraintTree::gather_constraints(NodeId id, std::int32_t agent, std::vector<Constraint>& out) const {
  out.clear();
  for (; id != no_node; id = node(id).parent)
    for (std::uint32_t i = node(id).constraints.begin; i < node(id).constraints.end; ++i) {
      if (constraints_[i].agent == agent)
        out.push_back(constraints_[i]);
      else if (constraints_[i].binds_others())
        out.push_back(constraints_[i].for_another(agent));
    }
}

// Sums, so that the order does not matter. Constraints that bind all others are summed once for all agents.
void ConstraintTree::gather_signatures(NodeId id, std::vector<std::uint64_t>& out) const {
  for (const std::int32_t agent : members_) out[static_cast<std::size_t>(agent)] = 0;
  std::uint64_t for_all = 0;
  for (; id != no_node; id = node(id).parent)
    for (std::uint32_t i = node(id).constraints.begin; i < node(id).constraints.end; ++i) {
      const Constraint& c = constraints_[i];
      std::uint64_t& own = out[static_cast<std::size_t>(c.agent)];
      own += hash_of(c);
      if (!c.binds_others()) continue;
      const std::uint64_t for_others = hash_of(c.for_another(-1));
      for_all += for_others;
      own -= for_others;
    }
  for (const std::int32_t agent : members_) out[static_cast<std::size_t>(agent)] += for_all;
}

}  // namespace dmrp::planners
