// SPDX-License-Identifier: MIT
// tour_table.hpp: for one robot, the true distance to the end of its tour from everywhere, and the fewest turns among
// the ways of that length. The exact heuristic of every search for a robot alone.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "problem.hpp"
#include "stop_signal.hpp"

namespace dmrp::planners {

class TourTable {
 public:
  static constexpr std::int32_t unreachable = 1 << 28;

  // Unfinished, and not to be used, if `stop` says so.
  TourTable(const GridGraph& graph, const Agent& agent, StopSignal& stop);

  // Steps from `location`, on the way to goal `leg`, until the tour's end; or unreachable.
  std::int32_t distance(std::int32_t leg, Location location) const { return distance_[index(leg, location)]; }

  // Fewest turns over those steps for a robot that came in direction `heading` (or no_direction).
  std::int32_t turns(std::int32_t leg, Location location, Direction heading) const {
    return turns_[index(leg, location) * heading_count + static_cast<std::size_t>(heading)];
  }

  // A shortest path with fewest turns; empty if there is none.
  std::vector<Location> shortest_path() const;

 private:
  static constexpr std::size_t heading_count = GridGraph::direction_count + 1;

  std::size_t index(std::int32_t leg, Location location) const {
    return static_cast<std::size_t>(leg) * static_cast<std::size_t>(graph_->location_count()) +
           static_cast<std::size_t>(location);
  }
  bool is_end(std::int32_t leg, Location location) const {
    return leg == agent_->last_leg() && location == agent_->last_goal();
  }
  void fill_leg(std::int32_t leg, StopSignal& stop);
  std::int32_t distance_at_goal(std::int32_t leg) const;
  void fill_turns(std::int32_t leg, Location location);

  const GridGraph* graph_;
  const Agent* agent_;
  std::vector<std::int32_t> distance_;
  std::vector<std::uint16_t> turns_;
  std::vector<Location> queue_;
};

// One table an agent; nothing if `stop` ended it.
std::optional<std::vector<TourTable>> make_tour_tables(const Problem& problem, StopSignal& stop);

// The first robot (as the host counts) that cannot make its tour even alone, if there is one.
std::optional<std::uint32_t> find_cut_off_robot(const Problem& problem, const std::vector<TourTable>& tables);

}  // namespace dmrp::planners
