// SPDX-License-Identifier: MIT
// pair_weights.hpp: the WDG heuristic, a lower bound from the weighted dependency graph (Li, Felner, Boyarski, Ma,
// Koenig: Improved heuristics for MAPF with CBS, IJCAI 2019).
//
// The graph's vertices are agents. An edge's weight is the amount by which the least joint cost of two agents exceeds
// the sum of their least costs; a search of the two agents alone finds it. The bound is the sum of the least costs plus
// the edge-weighted vertex cover.
#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "planners/conflict_search/high_level/entered_node.hpp"
#include "planners/conflict_search/high_level/options.hpp"

namespace dmrp::planners {

class HighLevel;

class PairWeights {
 public:
  // The bound of a node without solutions; no other bound is as high.
  static constexpr std::int32_t unsolvable = 1 << 24;

  // `options` are those of the search that asks.
  PairWeights(const SearchContext& context, const ConflictSearchOptions& options);
  ~PairWeights();

  // No solution below the node costs less. Meaningless if the search was stopped.
  std::int32_t bound(EnteredNode& node);

  // By the searches of two agents.
  std::int64_t low_level_expanded() const;

 private:
  struct Key {
    AgentPair pair;
    std::uint64_t signature_a;
    std::uint64_t signature_b;
    bool operator==(const Key&) const = default;
  };
  struct KeyHash {
    std::size_t operator()(const Key& key) const;
  };

  std::int32_t weight(EnteredNode& node, const AgentPair& pair);

  SearchContext context_;
  ConflictSearchOptions options_;
  std::unique_ptr<HighLevel> pair_search_;                // made when first needed
  std::unordered_map<Key, std::int32_t, KeyHash> known_;  // weights; never iterated over
  std::vector<Constraint> constraints_;                   // scratch
};

}  // namespace dmrp::planners
