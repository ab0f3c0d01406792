// SPDX-License-Identifier: MIT
// options.hpp: the settings that make CBS, ECBS and EECBS out of one engine, and the engine's statistics.
#pragma once

#include <cstdint>

namespace dmrp::planners {

// The order in which the high level expands its nodes.
enum class Selection {
  best_first,           // least f (A*)
  focal,                // fewest conflicts among the nodes whose cost is within the bound (Barer et al. 2014)
  explicit_estimation,  // fewest conflicts among those whose estimated cost is (Thayer, Ruml 2011; Li et al. 2021)
};

struct ConflictSearchOptions {
  double suboptimality = 1;
  Selection selection = Selection::best_first;
  bool prioritize_conflicts = false;  // cardinal conflicts first (Boyarski et al. 2015)
  bool bypass = false;                // adopt a child's paths instead of splitting (Boyarski et al. 2015)
  bool target_reasoning = false;      // Li et al. 2020
  bool corridor_reasoning = false;    // Li et al. 2020
  bool rectangle_reasoning = false;   // Li et al. 2019
  bool dependency_graph = false;      // the WDG heuristic (Li et al. 2019), for nodes selected for their bound
  bool safe_intervals = true;         // low level over safe intervals; false: over single steps
  bool disjoint_splitting = false;    // Li et al. 2019
  bool replan_in_place = false;       // before a split: replan agents without new constraints
  std::int32_t conflict_steps = 0;    // steps that a path may be longer to avoid one conflict; 0: any, within the bound
  std::int64_t restart_after = 0;     // expansions before the next order of agents (Cohen et al. 2018); 0: never
  std::int64_t node_limit = 0;        // over all restarts
  std::uint64_t seed = 0;             // of the orders
};

struct ConflictSearchStatistics {
  double lower_bound = 0;
  std::int64_t high_level_expanded = 0;
  std::int64_t high_level_generated = 0;
  std::int64_t low_level_expanded = 0;
};

}  // namespace dmrp::planners
