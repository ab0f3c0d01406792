// SPDX-License-Identifier: MIT
// search.hpp: ECBS, the high level: focal search over a tree of constraints.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "planners/ecbs8/constraint_tree.hpp"
#include "planners/ecbs8/focal_search.hpp"

namespace dmrp::planners::ecbs8 {

struct Statistics {
  Cost lower_bound = 0;  // of all plans
  std::int64_t high_level_expanded = 0;
  std::int64_t high_level_generated = 0;
  std::int64_t low_level_expanded = 0;
};

class Search {
 public:
  enum class Result { solved, unsolvable, stopped, node_limit };

  // The problem has no obvious obstruction: all goals can be reached, starts and last goals differ.
  Search(const Problem& problem, const std::vector<TourDistances>& distances, double suboptimality,
         std::int64_t node_limit, StopSignal& stop);

  Result run();

  // After Result::solved: a path an agent, and what they cost.
  std::vector<PathView> solution() const;
  Cost cost() const { return cost_; }
  // After Result::unsolvable.
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
  // What a conflict is split into: one agent's part of it forbidden.
  struct Side {
    std::int32_t agent;
    Constraint constraint;
  };
  // A node that is not in the tree yet: the agent under one more constraint has another path.
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
  std::vector<FocalEntry> waiting_;      // in OPEN, but beyond the bound
  std::vector<std::uint8_t> is_closed_;  // by node
  Statistics statistics_;
  Cost cost_ = 0;
  std::string obstruction_;

  // Of the node that was entered last: all paths, conflicts (by their indices in the tree), and who is where.
  std::vector<AgentPath> paths_;
  std::vector<std::uint32_t> conflicts_;
  Occupancy occupied_;

  FocalSearch low_level_;
  ConstraintTable constraint_table_;
  std::vector<Constraint> constraints_;
  std::array<Child, 2> children_;
};

}  // namespace dmrp::planners::ecbs8
