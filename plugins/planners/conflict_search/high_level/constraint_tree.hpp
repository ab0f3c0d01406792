// SPDX-License-Identifier: MIT
// constraint_tree.hpp: the nodes of the high level, each only by its differences from its parent.
//
// A node's paths, constraints and conflicts are what it and its ancestors hold, the nearest one counting:
//   paths        of an agent: the first met on the way up
//   constraints  all met on the way up
//   conflicts    those met on the way up of which neither agent got another path further down
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "planners/conflict_search/low_level/conflict_table.hpp"
#include "planners/conflict_search/low_level/constraint.hpp"

namespace dmrp::planners {

// What each of the two children of a split asks for.
using Split = std::array<std::vector<Constraint>, 2>;

// A conflict, and what is found out about it when a node that has it is first expanded; good for descendants.
struct NodeConflict {
  // How a split bounds the cost: it raises that of both children, of one, or of none.
  enum class Cardinality : std::uint8_t { full, semi, none };
  // What the split reasons about, the best first.
  enum class Reasoning : std::uint8_t { target, corridor, rectangle, plain };

  Conflict conflict;
  bool is_known = false;
  Cardinality cardinality = Cardinality::none;
  Reasoning reasoning = Reasoning::plain;
  std::uint32_t split = 0;  // of corridors and rectangles: its number in the tree
};

struct AgentPath {
  std::int32_t agent = -1;
  std::int32_t lower_bound = 0;  // of the agent's cost under the constraints it was planned with
  PathView locations;
};

// A contiguous part of one of the tree's arrays.
struct Range {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

using NodeId = std::int32_t;
constexpr NodeId no_node = -1;

struct Node {
  NodeId parent = no_node;
  std::int32_t lower_bound = 0;  // sum of the agents'
  std::int32_t cost = 0;         // sum of the agents' paths'
  std::int32_t pairs = 0;        // of agents with conflicts
  std::int32_t f = 0;            // no solution below this node costs less
  bool is_informed = false;      // f has been raised by all that is known
  double estimated_cost = 0;     // of the best solution below: not a bound
  Range paths;
  Range constraints;
  Range conflicts;
};

class ConstraintTree {
 public:
  // `members` are the agents that the nodes are about, of `agent_count`.
  void reset(std::size_t agent_count, std::vector<std::int32_t> members);

  // Adds a node; copies the paths. Numbers are the caller's. Conflicts of one pair stand together.
  NodeId add(Node node, std::span<const AgentPath> paths, std::span<const Constraint> constraints,
             std::span<const Conflict> conflicts);

  const std::vector<std::int32_t>& members() const { return members_; }
  Node& node(NodeId id) { return nodes_[static_cast<std::size_t>(id)]; }
  const Node& node(NodeId id) const { return nodes_[static_cast<std::size_t>(id)]; }
  std::int64_t node_count() const { return static_cast<std::int64_t>(nodes_.size()); }

  NodeConflict& conflict(std::uint32_t index) { return conflicts_[index]; }
  std::uint32_t add_split(Split split);
  const Split& split(std::uint32_t index) const { return splits_[index]; }

  // All members' paths in a node, by agent. They stay where they are as long as the tree lives.
  void gather_paths(NodeId id, std::vector<AgentPath>& out);
  // What an agent has to heed in a node: its own constraints and those of others that bind it.
  void gather_constraints(NodeId id, std::int32_t agent, std::vector<Constraint>& out) const;
  // By agent, a number that is the same for the same constraints (and, but for a chance of one in 2^64, no others).
  void gather_signatures(NodeId id, std::vector<std::uint64_t>& out) const;
  // Indices for conflict(); conflicts of one pair stand together.
  void gather_conflicts(NodeId id, std::vector<std::uint32_t>& out);

 private:
  PathView store(PathView path);

  std::vector<std::int32_t> members_;
  std::vector<Node> nodes_;
  std::vector<AgentPath> paths_;
  std::vector<Constraint> constraints_;
  std::vector<NodeConflict> conflicts_;
  std::deque<Split> splits_;
  std::vector<std::unique_ptr<Location[]>> blocks_;  // the paths' locations
  std::size_t block_used_ = 0;
  std::size_t block_size_ = 0;
  std::vector<std::uint32_t> met_;  // scratch of the walks up: by agent, the walk that met its path
  std::uint32_t walk_ = 0;
};

}  // namespace dmrp::planners
