// SPDX-License-Identifier: MIT
// splitting.hpp: the conflict on which a node is split, and the constraints of the two children.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planners/conflict_search/high_level/entered_node.hpp"
#include "planners/conflict_search/high_level/options.hpp"

namespace dmrp::planners {

class Splitter {
 public:
  Splitter(ConstraintTree& tree, const SearchContext& context, const ConflictSearchOptions& options)
      : tree_(tree), context_(context), options_(options) {}

  // One of the node's conflicts, of which there is at least one: the earliest or, where conflicts are prioritized, a
  // cardinal one. Returns its index in the tree.
  std::uint32_t choose_conflict(EnteredNode& node);

  // The constraints of the two children. Every solution below the node satisfies one of the sets.
  Split split(const EnteredNode& node, std::uint32_t conflict) const;

 private:
  void classify(EnteredNode& node, NodeConflict& conflict);
  std::optional<SymmetrySplit> find_symmetry(EnteredNode& node, NodeConflict& conflict);
  std::optional<SymmetrySplit> find_corridor_split(EnteredNode& node, const Conflict& conflict);
  std::optional<SymmetrySplit> find_rectangle_split(EnteredNode& node, const Conflict& conflict) const;
  Split plain_split(const Conflict& conflict) const;

  ConstraintTree& tree_;
  SearchContext context_;
  ConflictSearchOptions options_;
  std::vector<Constraint> constraints_a_;  // scratch
  std::vector<Constraint> constraints_b_;
};

}  // namespace dmrp::planners
