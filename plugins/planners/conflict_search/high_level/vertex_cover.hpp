// SPDX-License-Identifier: MIT
// vertex_cover.hpp: the least weight that agents must add together when every dependent pair must add its own.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/mapf/stop_signal.hpp"

namespace dmrp::planners {

// Two agents whose costs together are at least `weight` (> 0) above the sum of their least costs.
struct DependentPair {
  std::int32_t a;
  std::int32_t b;
  std::int32_t weight;
};

// The least sum of whole numbers x >= 0, one an agent, with x[a] + x[b] >= weight for every pair: an edge-weighted
// vertex cover (Li, Felner, Boyarski, Ma, Koenig: Improved heuristics for MAPF with CBS, IJCAI 2019). Exact for parts
// of the graph that a bounded search settles; for others a lower bound by disjoint pairs. Not to be used if `stop` says
// so.
std::int32_t least_edge_weighted_cover(const std::vector<DependentPair>& pairs, StopSignal& stop);

}  // namespace dmrp::planners
