// SPDX-License-Identifier: MIT
// search_context.hpp: what a search and its two-agent sub-searches share.
#pragma once

#include <vector>

#include "planners/conflict_search/low_level/mdd.hpp"
#include "planners/conflict_search/symmetry/corridor_reasoning.hpp"

namespace dmrp::planners {

// References only: everything must outlive the searches.
struct SearchContext {
  const Problem& problem;
  const std::vector<TourTable>& tables;
  CorridorReasoning& corridors;
  MddCache& mdds;
  StopSignal& stop;
};

}  // namespace dmrp::planners
