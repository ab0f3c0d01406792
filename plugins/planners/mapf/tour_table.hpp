// SPDX-License-Identifier: MIT
// tour_table.hpp: for one robot, the true distance from every location to the end of its tour: the exact heuristic for
// a robot without others.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <deque>
#include <optional>
#include <unordered_map>
#include <vector>

#include "planners/mapf/problem.hpp"
#include "planners/mapf/stop_signal.hpp"

namespace dmrp::planners {

// Searches backward from the goal of each leg toward where the leg begins, and only as far as it is asked: whole tables
// of many robots on a large map are larger than all else in memory. (Silver: Cooperative pathfinding, AIIDE 2005:
// reverse resumable A*.)
class TourTable {
 public:
  static constexpr std::int32_t unreachable = 1 << 28;

  // The graph must outlive the table, where it is.
  TourTable(const GridGraph& graph, const Agent& agent);
  TourTable(TourTable&&) = default;  // no copies: it refers to its own tiles

  // Steps from `location`, on the way to goal `leg`, until the tour's end; or unreachable. May continue a search.
  std::int32_t distance(std::int32_t leg, Location location) const {
    assert(leg >= 0 && location >= 0 && location < graph_->location_count());
    const Tile& tile = *tile_of(leg, location);
    const std::int32_t packed = tile.packed[place(location)];
    return packed % 2 != 0 && packed < 2 * far ? tile.base + packed / 2 : search_on(leg, location);
  }

 private:
  struct Label {
    std::int32_t steps;  // the fewest known
    bool is_expanded;    // and so the fewest of all
  };

  // Labels of consecutive locations: 16 bits each, as their steps hardly differ.
  static constexpr std::size_t tile_size = 512;
  static constexpr std::int32_t far = (1 << 15) - 1;
  struct Tile {
    std::int32_t base;
    // Twice the steps beyond `base`, plus one if expanded; 0: none; from twice `far` on: the steps are in Search::far.
    std::array<std::uint16_t, tile_size> packed;
  };
  static inline Tile no_labels{};  // stands for all tiles without a label; never written

  // A* from the goal of a leg, by the distance along the axes to a location. A step changes the sum of both by 0 or 2.
  struct Search {
    Location toward;
    std::vector<Location> open;    // with the least sum
    std::vector<Location> beyond;  // with 2 more
    std::unordered_map<Location, std::int32_t> far;
  };

  static std::size_t place(Location location) { return static_cast<std::size_t>(location) % tile_size; }
  Tile*& tile_of(std::int32_t leg, Location location) const {
    return tiles_[static_cast<std::size_t>(leg) * tiles_a_leg_ + static_cast<std::size_t>(location) / tile_size];
  }
  Label label(std::int32_t leg, Location location) const;
  void set(std::int32_t leg, Location location, Label label) const;
  std::int32_t search_on(std::int32_t leg, Location location) const;
  std::int32_t rest_of_tour(const Agent& agent, std::int32_t leg) const;

  const GridGraph* graph_;
  std::size_t tiles_a_leg_;
  mutable std::vector<Tile*> tiles_;  // by leg and location
  mutable std::deque<Tile> own_tiles_;
  mutable std::vector<Search> searches_;  // by leg
};

// One table for each agent; nothing if `stop` was raised.
std::optional<std::vector<TourTable>> make_tour_tables(const Problem& problem, StopSignal& stop);

// The first robot (as the host counts) that cannot make its tour even alone, if there is one.
std::optional<std::uint32_t> find_cut_off_robot(const Problem& problem, const std::vector<TourTable>& tables);

}  // namespace dmrp::planners
