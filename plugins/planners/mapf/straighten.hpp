// SPDX-License-Identifier: MIT
// straighten.hpp: removes turns from a finished plan.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/mapf/safe_intervals.hpp"
#include "planners/mapf/stop_signal.hpp"
#include "planners/mapf/tour_table.hpp"

namespace dmrp::planners {

// A work limit for straighten() after a search that expanded that many nodes: a small share of the search, but enough
// for a few robots.
constexpr std::int64_t straightening_limit(std::size_t robots, std::int64_t expanded) {
  return 2000 + 50 * static_cast<std::int64_t>(robots) + expanded / 4;
}

// Replaces the path of one robot after the other by one with the fewest turns that ends at the same time and does not
// conflict with the others, until no path changes. Costs do not change. `paths` must have no conflicts, and has none
// afterwards. Stops early after `work_limit` states (0.1 to 0.2 microseconds each), having begun with the robots that
// take least work, or when `stop` was raised. Returns the number of turns removed.
std::int32_t straighten(const Problem& problem, const std::vector<TourTable>& tables,
                        std::vector<std::vector<Location>>& paths, std::int64_t work_limit, StopSignal& stop);

// The same for a `plan` that already contains the paths; it contains the new ones afterwards.
std::int32_t straighten(const Problem& problem, const std::vector<TourTable>& tables, SafeIntervals& plan,
                        std::vector<std::vector<Location>>& paths, std::int64_t work_limit, StopSignal& stop);

// The same for robots that ignore each other. Without a limit other than `stop`.
void straighten_alone(const Problem& problem, const std::vector<TourTable>& tables,
                      std::vector<std::vector<Location>>& paths, StopSignal& stop);

}  // namespace dmrp::planners
