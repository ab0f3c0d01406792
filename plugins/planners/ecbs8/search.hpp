// SPDX-License-Identifier: MIT
// search.hpp: the high level of ECBS: focal search over a tree of constraints.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "planners/ecbs8/constraint.hpp"
#include "planners/ecbs8/focal_search.hpp"
#include "planners/ecbs8/occupancy.hpp"
#include "planners/mapf/difference_tree.hpp"

namespace dmrp::planners::ecbs8 {

struct AgentPath {
  std::int32_t agent = -1;
  PathView locations;
  Cost cost = 0;
  Cost lower_bound = 0;  // of the agent's paths under the node's constraints
};

// A node of the high level: at most one constraint, on top of its parent's. Sums are over all agents.
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

struct Statistics {
  Cost lower_bound = 0;  // of all plans
  std::int64_t high_level_expanded = 0;
  std::int64_t high_level_generated = 0;
  std::int64_t low_level_expanded = 0;
};

class Search {
 public:
  enum class Result { solved, unsolvable, stopped, node_limit };

  // The problem must have no obvious obstruction: all goals can be reached; starts differ, and so do last goals.
  Search(const Problem& problem, const std::vector<TourDistances>& distances, double suboptimality,
         std::int64_t node_limit, StopSignal& stop);

  Result run();

  // After Result::solved: one path for each agent, and their cost.
  std::vector<PathView> solution() const;
  Cost cost() const { return cost_; }
  // After Result::unsolvable: why there is no plan.
  const std::string& obstruction() const { return obstruction_; }
  Statistics statistics() const;

 private:
  struct OpenEntry {
    Cost lower_bound;
    NodeId node;
  };
  struct FocalEntry {
    std::int32_t conflicting_pairs;
    std::int32_t turns;
    Cost cost;
    NodeId node;
  };
  // For heaps with the best on top.
  struct IsWorse {
    bool operator()(const OpenEntry& a, const OpenEntry& b) const;
    bool operator()(const FocalEntry& a, const FocalEntry& b) const;
  };
  struct IsDearer {
    bool operator()(const FocalEntry& a, const FocalEntry& b) const;
  };
  // One side of a split: a constraint on one agent.
  struct Side {
    std::int32_t agent;
    Constraint constraint;
  };
  // A node that is not in the tree yet: one more constraint, and the constrained agent's new path.
  struct Child {
    Node node;
    BoundedPath path;
    std::vector<Conflict> conflicts;  // of that path
  };

  bool plan_root();
  std::vector<std::size_t> by_distance() const;
  NodeId choose();
  bool expand(NodeId id);
  bool may_bypass(NodeId parent, const Child& child) const;
  void enter(NodeId id);
  const Conflict& choose_conflict() const;
  std::array<Side, 2> split(const Conflict& conflict) const;
  bool make_child(NodeId parent, const Side& side, Child& child);
  std::int32_t count_pairs(const Child& child) const;
  NodeId add(const Child& child);
  NodeId add_without_constraint(const Child& child, NodeId parent);
  void push(NodeId id);

  const Problem& problem_;
  const std::vector<TourDistances>& distances_;
  Suboptimality suboptimality_;
  std::int64_t node_limit_;
  StopSignal& stop_;
  ConstraintTree tree_;
  std::vector<OpenEntry> open_;
  std::vector<FocalEntry> focal_;
  std::vector<FocalEntry> waiting_;      // in OPEN, beyond the bound
  std::vector<std::uint8_t> is_closed_;  // by node
  Statistics statistics_;
  Cost cost_ = 0;
  std::string obstruction_;

  // Of the node that was entered last: all paths, the conflicts' indices in the tree, and the positions over time.
  std::vector<AgentPath> paths_;
  std::vector<std::uint32_t> conflicts_;
  Occupancy occupied_;

  FocalSearch low_level_;
  ConstraintTable constraint_table_;
  std::vector<Constraint> constraints_;
  std::array<Child, 2> children_;
};

}  // namespace dmrp::planners::ecbs8
