// SPDX-License-Identifier: MIT
// tour_table.hpp: for one robot, the true distance from every location to the end of its tour: the exact heuristic for
// a robot without others.
#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <vector>

#include "planners/mapf/problem.hpp"
#include "planners/mapf/stop_signal.hpp"

namespace dmrp::planners {

class TourTable {
 public:
  static constexpr std::int32_t unreachable = 1 << 28;

  // Incomplete if `stop` was raised. `queue` is scratch.
  TourTable(const GridGraph& graph, const Agent& agent, std::vector<Location>& queue, StopSignal& stop);

  // Steps from `location`, on the way to goal `leg`, until the tour's end; or unreachable.
  std::int32_t distance(std::int32_t leg, Location location) const {
    assert(leg >= 0 && location >= 0 && static_cast<std::size_t>(location) < location_count_);
    return distance_[static_cast<std::size_t>(leg) * location_count_ + static_cast<std::size_t>(location)];
  }

 private:
  void fill_leg(const GridGraph& graph, const Agent& agent, std::int32_t leg, std::vector<Location>& queue,
                StopSignal& stop);

  std::size_t location_count_;
  std::vector<std::int32_t> distance_;
};

// One table for each agent; nothing if `stop` was raised.
std::optional<std::vector<TourTable>> make_tour_tables(const Problem& problem, StopSignal& stop);

// The first robot (as the host counts) that cannot make its tour even alone, if there is one.
std::optional<std::uint32_t> find_cut_off_robot(const Problem& problem, const std::vector<TourTable>& tables);

}  // namespace dmrp::planners
