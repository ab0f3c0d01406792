// SPDX-License-Identifier: MIT
// constraint_tree.hpp: the nodes of the high level. Each stores the constraints that it adds to its parent's.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "planners/conflict_search/low_level/conflict_table.hpp"
#include "planners/conflict_search/low_level/constraint.hpp"
#include "planners/mapf/difference_tree.hpp"

namespace dmrp::planners {

// The constraints of the two children of a split.
using Split = std::array<std::vector<Constraint>, 2>;

// A conflict with its classification. The first expansion of a node that has it fills that in; descendants reuse it.
struct NodeConflict : Conflict {
  // Whether a split raises the cost of both children, of one, or of none.
  enum class Cardinality : std::uint8_t { full, semi, none };
  // The kind of split, the preferred one first.
  enum class Reasoning : std::uint8_t { target, corridor, rectangle, plain };

  bool is_known = false;
  Cardinality cardinality = Cardinality::none;
  Reasoning reasoning = Reasoning::plain;
  std::uint32_t split = 0;  // of corridors and rectangles: its index in the tree
};

struct AgentPath {
  std::int32_t agent = -1;
  std::int32_t lower_bound = 0;  // of the agent's cost under the constraints it was planned with
  PathView locations;
};

struct Node {
  NodeId parent = no_node;
  std::int32_t lower_bound = 0;  // sum of the agents' lower bounds
  std::int32_t cost = 0;         // sum of the paths' costs
  std::int32_t pairs = 0;        // of agents with conflicts
  std::int32_t f = 0;            // no solution below this node costs less
  bool is_informed = false;      // f includes the heuristic
  double estimated_cost = 0;     // of the best solution below; not a bound
  Range paths;
  Range constraints;
  Range conflicts;
};

class ConstraintTree : public DifferenceTree<Node, AgentPath, NodeConflict> {
 public:
  // `members` are the agents that the nodes are about, of `agent_count`.
  void reset(std::size_t agent_count, std::vector<std::int32_t> members);

  // Adds a node. The conflicts of one pair of agents stand together.
  NodeId add(Node node, std::span<const AgentPath> paths, std::span<const Constraint> constraints,
             std::span<const Conflict> conflicts);

  const std::vector<std::int32_t>& members() const { return members_; }

  std::uint32_t add_split(Split split);
  const Split& split(std::uint32_t index) const { return splits_[index]; }

  // The constraints on an agent in a node: its own, and those of others that bind it.
  void gather_constraints(NodeId id, std::int32_t agent, std::vector<Constraint>& out) const;
  // By agent: a hash of the set of its constraints. Equal sets have equal signatures; others differ but for a chance of
  // 2^-64.
  void gather_signatures(NodeId id, std::vector<std::uint64_t>& out) const;

 private:
  std::vector<std::int32_t> members_;
  std::vector<Constraint> constraints_;
  std::deque<Split> splits_;
};

}  // namespace dmrp::planners
