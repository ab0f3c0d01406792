// SPDX-License-Identifier: MIT
// tour_table.hpp: for one robot, the true distance to the end of its tour from everywhere. The exact heuristic of every
// search for a robot alone.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planners/mapf/problem.hpp"
#include "planners/mapf/stop_signal.hpp"

namespace dmrp::planners {

class TourTable {
 public:
  static constexpr std::int32_t unreachable = 1 << 28;

  // Unfinished, and not to be used, if `stop` says so. `queue` is scratch.
  TourTable(const GridGraph& graph, const Agent& agent, std::vector<Location>& queue, StopSignal& stop);

  // Steps from `location`, on the way to goal `leg`, until the tour's end; or unreachable.
  std::int32_t distance(std::int32_t leg, Location location) const {
    return distance_[static_cast<std::size_t>(leg) * location_count_ + static_cast<std::size_t>(location)];
  }

 private:
  void fill_leg(const GridGraph& graph, const Agent& agent, std::int32_t leg, std::vector<Location>& queue,
                StopSignal& stop);

  std::size_t location_count_;
  std::vector<std::int32_t> distance_;
};

// One table an agent; nothing if `stop` ended it.
std::optional<std::vector<TourTable>> make_tour_tables(const Problem& problem, StopSignal& stop);

// The first robot (as the host counts) that cannot make its tour even alone, if there is one.
std::optional<std::uint32_t> find_cut_off_robot(const Problem& problem, const std::vector<TourTable>& tables);

}  // namespace dmrp::planners
