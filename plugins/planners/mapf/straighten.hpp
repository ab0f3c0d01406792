// SPDX-License-Identifier: MIT
// straighten.hpp: takes turns out of a finished plan.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/mapf/safe_intervals.hpp"
#include "planners/mapf/stop_signal.hpp"
#include "planners/mapf/tour_table.hpp"

namespace dmrp::planners {

// What straightening may cost after a search that expanded so many nodes: a small share of it, but enough to settle a
// few robots.
constexpr std::int64_t straightening_limit(std::size_t robots, std::int64_t expanded) {
  return 2000 + 50 * static_cast<std::int64_t>(robots) + expanded / 4;
}

// Gives one robot after the other a path with the fewest turns of all that end at the same time and have no conflict
// with the paths of the others, until none changes. Costs stay as they are, and so does a plan's being free of
// conflicts, which is required of `paths`. Ends early after looking at `work_limit` states (a tenth of a microsecond
// or two each), having settled the robots that take least work, or when `stop` says so. Returns how many turns it
// saved.
std::int32_t straighten(const Problem& problem, const std::vector<TourTable>& tables,
                        std::vector<std::vector<Location>>& paths, std::int64_t work_limit, StopSignal& stop);

// The same where `plan` has the paths already; it has the new ones afterwards.
std::int32_t straighten(const Problem& problem, const std::vector<TourTable>& tables, SafeIntervals& plan,
                        std::vector<std::vector<Location>>& paths, std::int64_t work_limit, StopSignal& stop);

// The same for robots that pay no heed to each other; there is no limit but `stop`.
void straighten_alone(const Problem& problem, const std::vector<TourTable>& tables,
                      std::vector<std::vector<Location>>& paths, StopSignal& stop);

}  // namespace dmrp::planners
