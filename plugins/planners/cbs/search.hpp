// SPDX-License-Identifier: MIT
// search.hpp: conflict-based search, the high level.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "../mapf/mdd.hpp"
#include "../mapf/space_time_astar.hpp"
#include "constraint_tree.hpp"

namespace dmrp::planners {

struct CbsStatistics {
  std::int32_t lower_bound = 0;
  std::int64_t high_level_expanded = 0;
  std::int64_t high_level_generated = 0;
  std::int64_t low_level_expanded = 0;
};

class CbsSearch {
 public:
  enum class Result { solved, unsolvable, stopped, node_limit };

  // The problem has no obvious obstruction: all goals can be reached, starts and last goals differ.
  CbsSearch(const Problem& problem, const std::vector<TourTable>& tables, std::int64_t node_limit, StopSignal& stop);

  Result run();

  // After Result::solved: a path an agent.
  const std::vector<PathView>& solution() const { return paths_; }
  // After Result::unsolvable.
  const std::string& obstruction() const { return obstruction_; }
  CbsStatistics statistics() const;

 private:
  struct OpenEntry {
    std::int32_t cost;
    std::int32_t conflict_count;
    std::int32_t turns;
    NodeId node;
  };
  // A node that is not in the tree yet: one more constraint on one agent, and its path.
  struct Child {
    Constraint constraint;
    Node node;
    std::vector<Location> path;
    std::vector<Conflict> conflicts;
  };

  static bool is_worse(const OpenEntry& a, const OpenEntry& b);
  void push(NodeId id);
  NodeId pop();
  bool plan_root();
  bool expand(NodeId id);
  void enter(NodeId id);
  bool make_child(NodeId parent, const Constraint& constraint, Child& child);
  NodeId add(const Child& child, bool with_constraint);
  const Conflict& choose_conflict(NodeId id);
  Cardinality classify(NodeId id, const Conflict& conflict);
  bool must_be_there(NodeId id, const Constraint& constraint);

  const Problem& problem_;
  const std::vector<TourTable>& tables_;
  std::int64_t node_limit_;
  StopSignal& stop_;
  ConstraintTree tree_;
  std::vector<OpenEntry> open_;
  CbsStatistics statistics_;
  std::string obstruction_;

  // Of the node that was entered last: all paths, conflicts (by their indices in the tree, in the order of time), and
  // who is where.
  std::vector<PathView> paths_;
  std::vector<std::uint32_t> conflicts_;
  ConflictTable occupied_;

  SpaceTimeAStar low_level_;
  MddCache mdds_;
  ConstraintTable constraint_table_;
  std::vector<Constraint> constraints_;
  std::array<Child, 2> children_;
};

}  // namespace dmrp::planners
