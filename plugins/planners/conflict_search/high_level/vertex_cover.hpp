// SPDX-License-Identifier: MIT
// vertex_cover.hpp: the minimum edge-weighted vertex cover of a graph of dependent agents.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/mapf/stop_signal.hpp"

namespace dmrp::planners {

// Two agents whose least joint cost exceeds the sum of their least costs by `weight` > 0.
struct DependentPair {
  std::int32_t a;
  std::int32_t b;
  std::int32_t weight;
};

// The least sum of integers x >= 0, one for each agent, with x[a] + x[b] >= weight for every pair (Li, Felner,
// Boyarski, Ma, Koenig: Improved heuristics for MAPF with CBS, IJCAI 2019). Exact for connected parts that a bounded
// search solves; for others a lower bound by disjoint pairs. Meaningless if `stop` was raised.
std::int32_t least_edge_weighted_cover(const std::vector<DependentPair>& pairs, StopSignal& stop);

}  // namespace dmrp::planners
