// SPDX-License-Identifier: MIT
// cost_estimate.hpp: the likely cost of the best solution below a node, learned from one-step errors (Thayer, Dionne,
// Ruml 2011; for CBS: Li, Ruml, Koenig 2021). Not a bound.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <tuple>

#include "planners/conflict_search/high_level/replanning.hpp"

namespace dmrp::planners {

class CostEstimate {
 public:
  // The node's cost, plus the mean cost of resolving a conflicting pair for each pair that is left.
  double of(const Node& node) const {
    double estimated = node.cost;
    if (count_ > 0) {
      const double cost_error = std::max(0.0, cost_error_sum_ / static_cast<double>(count_));
      const double distance_error = std::clamp(distance_error_sum_ / static_cast<double>(count_), 0.0, 0.95);
      estimated += node.pairs * cost_error / (1 - distance_error);
    }
    return std::max(estimated, static_cast<double>(node.f));
  }

  // Learns from the step between a node and the best of its children.
  void learn(const Node& parent, std::span<const Child> children) {
    if (children.empty()) return;
    const Node& best =
        std::min_element(children.begin(), children.end(), [](const Child& a, const Child& b) {
          return std::tie(a.node.estimated_cost, a.node.pairs) < std::tie(b.node.estimated_cost, b.node.pairs);
        })->node;
    cost_error_sum_ += best.cost - parent.cost;
    distance_error_sum_ += best.pairs - (parent.pairs - 1);
    ++count_;
  }

 private:
  double cost_error_sum_ = 0;      // how much steps raised the cost
  double distance_error_sum_ = 0;  // how many pairs fewer than one steps resolved
  std::int64_t count_ = 0;
};

}  // namespace dmrp::planners
