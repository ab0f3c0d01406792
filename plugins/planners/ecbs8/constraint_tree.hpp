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

#include "planners/ecbs8/constraint.hpp"
#include "planners/ecbs8/occupancy.hpp"

namespace dmrp::planners::ecbs8 {

using NodeId = std::int32_t;

struct AgentPath {
  std::int32_t agent = -1;
  PathView locations;
  Cost cost = 0;
  Cost lower_bound = 0;  // of the agent's paths under the node's constraints
};

// A contiguous part of one of the tree's arrays.
struct Range {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

// Numbers are of all agents together.
struct Node {
  NodeId parent = -1;
  std::int32_t constrained_agent = -1;  // by `constraint`; -1 where there is none
  Constraint constraint;
  Cost cost = 0;
  Cost lower_bound = 0;
  std::int32_t turns = 0;
  std::int32_t conflicting_pairs = 0;
  Range paths;
  Range conflicts;
};

class ConstraintTree {
 public:
  explicit ConstraintTree(std::size_t agent_count) : replaced_(agent_count, 0) {}

  // Adds a node; copies the paths.
  NodeId add(Node node, const std::vector<AgentPath>& paths, const std::vector<Conflict>& conflicts);

  const Node& node(NodeId id) const { return nodes_[static_cast<std::size_t>(id)]; }
  const Conflict& conflict(std::uint32_t index) const { return conflicts_[index]; }

  // The paths of all agents in a node. They stay where they are as long as the tree lives.
  void gather_paths(NodeId id, std::vector<AgentPath>& out);
  void gather_constraints(NodeId id, std::int32_t agent, std::vector<Constraint>& out) const;
  // Indices for conflict(), nearest nodes first.
  void gather_conflicts(NodeId id, std::vector<std::uint32_t>& out);

 private:
  PathView store(PathView path);

  std::vector<Node> nodes_;
  std::vector<AgentPath> paths_;
  std::vector<Conflict> conflicts_;
  std::vector<std::unique_ptr<Location[]>> blocks_;  // the paths' locations
  std::size_t block_used_ = 0;
  std::size_t block_size_ = 0;
  std::vector<std::uint32_t> replaced_;  // scratch: by agent, the walk that met its path
  std::uint32_t walk_ = 0;
};

}  // namespace dmrp::planners::ecbs8
