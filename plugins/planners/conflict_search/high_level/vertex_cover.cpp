// SPDX-License-Identifier: MIT
#include "planners/conflict_search/high_level/vertex_cover.hpp"

#include <algorithm>
#include <cassert>

namespace dmrp::planners {

namespace {

constexpr std::int64_t state_limit = 20'000;

struct Edge {
  std::size_t to;
  std::int32_t weight;
};
using Adjacency = std::vector<std::vector<Edge>>;

// Depth-first branch and bound over one connected part: assigns the vertices in order, least values first.
class CoverSearch {
 public:
  CoverSearch(const Adjacency& edges, std::vector<std::size_t> part, StopSignal& stop)
      : stop_(stop), edges_(edges), order_(std::move(part)), value_(edges.size(), unset) {}

  // False if the limit was reached: then best() is only an upper bound.
  bool run() {
    best_ = 0;
    for (const std::size_t v : order_) best_ += heaviest(v);
    assign(0, 0);
    return states_ <= state_limit;
  }
  std::int32_t best() const { return best_; }

 private:
  static constexpr std::int32_t unset = -1;

  std::int32_t heaviest(std::size_t v) const {
    std::int32_t weight = 0;
    for (const Edge& edge : edges_[v]) weight = std::max(weight, edge.weight);
    return weight;
  }
  // The least value of v, given its assigned neighbors.
  std::int32_t least_value(std::size_t v) const {
    std::int32_t least = 0;
    for (const Edge& edge : edges_[v])
      if (value_[edge.to] != unset) least = std::max(least, edge.weight - value_[edge.to]);
    return least;
  }
  std::int32_t bound_of_rest(std::size_t from) const {
    std::int32_t sum = 0;
    for (std::size_t i = from; i < order_.size(); ++i) sum += least_value(order_[i]);
    return sum;
  }
  void assign(std::size_t i, std::int32_t sum) {
    if (++states_ > state_limit || stop_.poll()) return;
    if (i == order_.size()) {
      best_ = std::min(best_, sum);
      return;
    }
    if (sum + bound_of_rest(i) >= best_) return;
    const std::size_t v = order_[i];
    // No vertex needs more than the greatest weight towards its unassigned neighbors.
    std::int32_t most = least_value(v);
    for (const Edge& edge : edges_[v])
      if (value_[edge.to] == unset) most = std::max(most, edge.weight);
    for (std::int32_t value = least_value(v); value <= most && sum + value < best_; ++value) {
      value_[v] = value;
      assign(i + 1, sum + value);
      value_[v] = unset;
    }
  }

  StopSignal& stop_;
  const Adjacency& edges_;
  std::vector<std::size_t> order_;
  std::vector<std::int32_t> value_;
  std::int32_t best_ = 0;
  std::int64_t states_ = 0;
};

// A lower bound: the weights of pairs without a common agent add up.
std::int32_t sum_of_disjoint_pairs(const Adjacency& edges, const std::vector<std::size_t>& part) {
  struct Pair {
    std::int32_t weight;
    std::size_t a;
    std::size_t b;
  };
  std::vector<Pair> pairs;
  for (const std::size_t a : part)
    for (const Edge& edge : edges[a])
      if (a < edge.to) pairs.push_back({edge.weight, a, edge.to});
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) { return x.weight > y.weight; });
  std::vector<bool> taken(edges.size(), false);
  std::int32_t sum = 0;
  for (const Pair& pair : pairs) {
    if (taken[pair.a] || taken[pair.b]) continue;
    taken[pair.a] = taken[pair.b] = true;
    sum += pair.weight;
  }
  return sum;
}

// The vertices connected with `start`, by descending number of edges.
std::vector<std::size_t> connected_part(const Adjacency& edges, std::size_t start, std::vector<bool>& seen) {
  std::vector<std::size_t> part = {start};
  seen[start] = true;
  for (std::size_t i = 0; i < part.size(); ++i)
    for (const Edge& edge : edges[part[i]])
      if (!seen[edge.to]) {
        seen[edge.to] = true;
        part.push_back(edge.to);
      }
  std::stable_sort(part.begin(), part.end(),
                   [&](std::size_t a, std::size_t b) { return edges[a].size() > edges[b].size(); });
  return part;
}

}  // namespace

std::int32_t least_edge_weighted_cover(const std::vector<DependentPair>& pairs, StopSignal& stop) {
  assert(std::all_of(pairs.begin(), pairs.end(), [](const DependentPair& pair) { return pair.weight > 0; }));
  std::vector<std::int32_t> agents;
  for (const DependentPair& pair : pairs) agents.insert(agents.end(), {pair.a, pair.b});
  std::sort(agents.begin(), agents.end());
  agents.erase(std::unique(agents.begin(), agents.end()), agents.end());
  const auto number = [&](std::int32_t agent) {
    return static_cast<std::size_t>(std::lower_bound(agents.begin(), agents.end(), agent) - agents.begin());
  };
  Adjacency edges(agents.size());
  for (const DependentPair& pair : pairs) {
    edges[number(pair.a)].push_back({number(pair.b), pair.weight});
    edges[number(pair.b)].push_back({number(pair.a), pair.weight});
  }
  std::int32_t sum = 0;
  std::vector<bool> seen(agents.size(), false);
  for (std::size_t v = 0; v < agents.size(); ++v) {
    if (seen[v]) continue;
    const std::vector<std::size_t> part = connected_part(edges, v, seen);
    CoverSearch search(edges, part, stop);
    sum += search.run() ? search.best() : sum_of_disjoint_pairs(edges, part);
  }
  return sum;
}

}  // namespace dmrp::planners
