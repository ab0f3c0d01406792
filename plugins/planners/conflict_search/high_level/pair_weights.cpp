// SPDX-License-Identifier: MIT
#include "planners/conflict_search/high_level/pair_weights.hpp"

#include <algorithm>

#include "planners/conflict_search/high_level/high_level.hpp"
#include "planners/conflict_search/high_level/vertex_cover.hpp"

namespace dmrp::planners {

namespace {

// Nodes that the search of two agents may generate.
constexpr std::int64_t pair_node_limit = 10;

// The optimal search of two agents.
ConflictSearchOptions pair_options(ConflictSearchOptions options) {
  options.suboptimality = 1;
  options.selection = Selection::best_first;
  options.replan_in_place = false;
  options.restart_after = 0;
  options.node_limit = pair_node_limit;
  return options;
}

}  // namespace

PairWeights::PairWeights(const SearchContext& context, const ConflictSearchOptions& options)
    : context_(context), options_(pair_options(options)) {}

PairWeights::~PairWeights() = default;

std::int64_t PairWeights::low_level_expanded() const {
  return pair_search_ ? pair_search_->statistics().low_level_expanded : 0;
}

std::int32_t PairWeights::bound(EnteredNode& node) {
  StopSignal& stop = context_.stop;
  std::int32_t bound = node.node().lower_bound;
  std::vector<bool> is_counted(context_.problem.agents.size(), false);
  for (const auto& [a, b] : node.conflicting_pairs())
    for (const std::int32_t agent : {a, b}) {
      if (is_counted[static_cast<std::size_t>(agent)]) continue;
      is_counted[static_cast<std::size_t>(agent)] = true;
      const Mdd* const mdd = node.mdd_of(agent);
      if (!mdd || stop.poll_now()) return 0;
      bound += mdd->cost() - node.path_of(agent).lower_bound;
    }
  std::vector<DependentPair> dependent;
  for (const AgentPair& pair : node.conflicting_pairs()) {
    const std::int32_t added = weight(node, pair);
    if (stop.poll_now()) return 0;
    if (added >= unsolvable) return unsolvable;
    if (added > 0) dependent.push_back({pair.first, pair.second, added});
  }
  return bound + least_edge_weighted_cover(dependent, stop);
}

// The weight of an edge; `unsolvable` or more if the two agents have no solution under the node's constraints.
std::int32_t PairWeights::weight(EnteredNode& node, const AgentPair& pair) {
  const auto [a, b] = pair;
  const Mdd* const mdd_a = node.mdd_of(a);
  const Mdd* const mdd_b = node.mdd_of(b);
  if (!mdd_a || !mdd_b) return 0;  // stopped
  const std::int32_t alone = mdd_a->cost() + mdd_b->cost();
  const auto [known, is_new] = known_.emplace(Key{pair, node.signature_of(a), node.signature_of(b)}, 0);
  if (!is_new) return known->second;

  if (!pair_search_) pair_search_ = std::make_unique<HighLevel>(context_, options_);
  std::vector<Constraint> both;
  for (const std::int32_t agent : {a, b}) {
    node.gather_constraints(agent, constraints_);
    both.insert(both.end(), constraints_.begin(), constraints_.end());
  }
  switch (pair_search_->run({a, b}, both)) {
    case HighLevel::Result::stopped:
      return 0;
    case HighLevel::Result::unsolvable:
      return known->second = unsolvable;
    case HighLevel::Result::solved:
    case HighLevel::Result::limit:
      break;
  }
  return known->second = std::max(0, pair_search_->lower_bound() - alone);
}

std::size_t PairWeights::KeyHash::operator()(const Key& key) const {
  const auto agents = static_cast<std::uint64_t>(key.pair.first) << 32 | static_cast<std::uint32_t>(key.pair.second);
  return key.signature_a ^ (key.signature_b * 0x9E3779B97F4A7C15u) ^ (agents * 0xBF58476D1CE4E5B9u);
}

}  // namespace dmrp::planners
