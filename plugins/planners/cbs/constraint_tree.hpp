// SPDX-License-Identifier: MIT
// constraint_tree.hpp: the nodes of the high level, each only by its differences from its parent.
//
// A node's paths, constraints and conflicts are what it and its ancestors hold, the nearest one counting:
//   paths        of an agent: the first met on the way up
//   constraints  all met on the way up
//   conflicts    those met on the way up of which neither agent got another path further down
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "../mapf/conflict_table.hpp"
#include "../mapf/constraint.hpp"

namespace dmrp::planners {

// How a conflict bounds the cost: splitting on it raises that of both children, of one, or of none.
enum class Cardinality : std::uint8_t { unknown, none, semi, full };

struct NodeConflict {
  Conflict conflict;
  Cardinality cardinality = Cardinality::unknown;  // found out when the node is first expanded, good for descendants
};

struct AgentPath {
  std::int32_t agent = -1;
  PathView locations;
};

// A contiguous part of one of the tree's arrays.
struct Range {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

using NodeId = std::int32_t;

struct Node {
  NodeId parent = -1;
  std::int32_t cost = 0;            // sum over all agents
  std::int32_t turns = 0;           // likewise
  std::int32_t conflict_count = 0;  // in all
  Range paths;
  Range constraints;
  Range conflicts;
};

class ConstraintTree {
 public:
  explicit ConstraintTree(std::size_t agent_count) : agent_count_(agent_count), replaced_(agent_count, 0) {}

  // Adds a node; copies the paths. Numbers (cost, turns, conflict_count) are the caller's.
  NodeId add(Node node, const std::vector<AgentPath>& paths, const std::vector<Constraint>& constraints,
             const std::vector<Conflict>& conflicts);

  const Node& node(NodeId id) const { return nodes_[static_cast<std::size_t>(id)]; }
  NodeConflict& conflict(std::uint32_t index) { return conflicts_[index]; }

  // All agents' paths in a node. They stay where they are as long as the tree lives.
  void gather_paths(NodeId id, std::vector<PathView>& out) const;
  void gather_constraints(NodeId id, std::int32_t agent, std::vector<Constraint>& out) const;
  // Indices for conflict(), nearest nodes first.
  void gather_conflicts(NodeId id, std::vector<std::uint32_t>& out);

 private:
  PathView store(PathView path);

  std::size_t agent_count_;
  std::vector<Node> nodes_;
  std::vector<AgentPath> paths_;
  std::vector<Constraint> constraints_;
  std::vector<NodeConflict> conflicts_;
  std::vector<std::unique_ptr<Location[]>> blocks_;  // the paths' locations
  std::size_t block_used_ = 0;
  std::size_t block_size_ = 0;
  std::vector<std::uint32_t> replaced_;  // scratch of gather_conflicts: by agent, the walk that met its path
  std::uint32_t walk_ = 0;
};

}  // namespace dmrp::planners
