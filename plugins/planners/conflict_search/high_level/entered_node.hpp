// SPDX-License-Identifier: MIT
// entered_node.hpp: one node of the constraint tree in full: its paths, conflicts, constraints and MDDs.
//
// The tree stores differences from the parent. Entering a node gathers them once; entering another node updates the
// conflict table only for the agents whose paths differ.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "planners/conflict_search/high_level/constraint_tree.hpp"
#include "planners/conflict_search/low_level/mdd.hpp"
#include "planners/conflict_search/symmetry/corridor.hpp"

namespace dmrp::planners {

// What a search and its two-agent sub-searches share. References only: everything must outlive the searches.
struct SearchContext {
  const Problem& problem;
  const std::vector<TourTable>& tables;
  CorridorReasoning& corridors;
  MddCache& mdds;
  StopSignal& stop;
};

// Two agents with conflicts.
using AgentPair = std::pair<std::int32_t, std::int32_t>;

class EnteredNode {
 public:
  EnteredNode(ConstraintTree& tree, const SearchContext& context);

  void enter(NodeId id);

  // Forgets the node and takes its members out of the conflict table. Call before the tree gets other members.
  void leave();

  NodeId id() const { return id_; }
  const Node& node() const { return tree_.node(id_); }
  // By agent; of the tree's members only.
  const std::vector<AgentPath>& paths() const { return paths_; }
  const AgentPath& path_of(std::int32_t agent) const { return paths_[static_cast<std::size_t>(agent)]; }
  // Indices for ConstraintTree::conflict().
  const std::vector<std::uint32_t>& conflicts() const { return conflicts_; }
  const std::vector<AgentPair>& conflicting_pairs() const { return pairs_; }

  // Equal for equal constraints of the agent (and, but for a chance of 2^-64, only for equal ones).
  std::uint64_t signature_of(std::int32_t agent) const { return signatures_[static_cast<std::size_t>(agent)]; }
  void gather_constraints(std::int32_t agent, std::vector<Constraint>& out) const {
    tree_.gather_constraints(id_, agent, out);
  }

  // Of the agent's least cost under its constraints. Computed on first use; null if the search was stopped.
  const Mdd* mdd_of(std::int32_t agent);

  // The paths of all members. Replanning takes agents out for a while.
  ConflictTable& occupied() { return occupied_; }

 private:
  struct KnownMdd {
    std::uint64_t signature = 0;
    std::shared_ptr<const Mdd> mdd;
  };

  ConstraintTree& tree_;
  MddCache& mdds_;
  NodeId id_ = no_node;
  std::vector<AgentPath> paths_;
  std::vector<std::uint32_t> conflicts_;
  std::vector<AgentPair> pairs_;
  std::vector<std::uint64_t> signatures_;  // by agent
  std::vector<KnownMdd> known_mdds_;       // by agent: the last one used
  std::vector<Constraint> constraints_;    // scratch
  ConflictTable occupied_;
};

}  // namespace dmrp::planners
