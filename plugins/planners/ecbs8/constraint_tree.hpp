// SPDX-License-Identifier: MIT
// constraint_tree.hpp: the nodes of the high level: at most one constraint each, on top of their parent's.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/ecbs8/constraint.hpp"
#include "planners/ecbs8/occupancy.hpp"
#include "planners/mapf/difference_tree.hpp"

namespace dmrp::planners::ecbs8 {

struct AgentPath {
  std::int32_t agent = -1;
  PathView locations;
  Cost cost = 0;
  Cost lower_bound = 0;  // of the agent's paths under the node's constraints
};

// Sums are over all agents.
struct Node {
  NodeId parent = no_node;
  std::int32_t constrained_agent = -1;  // by `constraint`; -1: the node adds no constraint
  Constraint constraint;
  Cost cost = 0;
  Cost lower_bound = 0;
  std::int32_t turns = 0;
  std::int32_t conflicting_pairs = 0;
  Range paths;
  Range conflicts;
};

class ConstraintTree : public DifferenceTree<Node, AgentPath, Conflict> {
 public:
  explicit ConstraintTree(std::size_t agent_count) { reset(agent_count, agent_count); }

  void gather_constraints(NodeId id, std::int32_t agent, std::vector<Constraint>& out) const {
    out.clear();
    for (; id != no_node; id = node(id).parent)
      if (node(id).constrained_agent == agent) out.push_back(node(id).constraint);
  }
};

}  // namespace dmrp::planners::ecbs8
