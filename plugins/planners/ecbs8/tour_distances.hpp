// SPDX-License-Identifier: MIT
// tour_distances.hpp: for one robot, the true distance from every location to the end of its tour, and the fewest turns
// of a path of that length: the exact heuristic for a robot without others. At least the octile distance.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "planners/ecbs8/step_cost.hpp"
#include "planners/mapf/stop_signal.hpp"

namespace dmrp::planners::ecbs8 {

class TourDistances {
 public:
  // Incomplete if `stop` was raised.
  TourDistances(const Graph& graph, const Agent& agent, StopSignal& stop);

  // Cost from `location`, on the way to goal `leg`, until the tour's end; or unreachable.
  Cost distance(std::int32_t leg, Location location) const { return distance_[index(leg, location)]; }

  // The fewest turns of such a path, for a robot whose last move had direction `heading` (or no_direction).
  std::int32_t turns(std::int32_t leg, Location location, Direction heading) const {
    const auto& turns = turns_[index(leg, location)];
    if (heading != Graph::no_direction) return turns[static_cast<std::size_t>(heading)];
    return *std::min_element(turns.begin(), turns.end());
  }

 private:
  using TurnsByHeading = std::array<std::uint16_t, Graph::direction_count>;

  std::size_t index(std::int32_t leg, Location location) const {
    return static_cast<std::size_t>(leg) * static_cast<std::size_t>(graph_->location_count()) +
           static_cast<std::size_t>(location);
  }
  void fill_leg(std::int32_t leg, StopSignal& stop);
  void begin_at_goal(std::int32_t leg);
  void offer_to_predecessors(std::int32_t leg, Location location, Cost base);
  void fill_turns(std::int32_t leg, Location location);

  const Graph* graph_;
  const Agent* agent_;
  std::vector<Cost> distance_;
  std::vector<TurnsByHeading> turns_;
  std::vector<std::uint8_t> best_moves_;  // bits of the directions of the shortest paths
  std::vector<std::uint8_t> is_settled_;
  std::array<std::vector<Location>, 3> buckets_;  // of the distances in [k, k + 1) straight steps, by k mod 3
};

// One table for each agent; nothing if `stop` was raised.
std::optional<std::vector<TourDistances>> make_tour_distances(const Problem& problem, StopSignal& stop);

// The first robot (as the host counts) that cannot make its tour even alone, if there is one.
std::optional<std::uint32_t> find_cut_off_robot(const Problem& problem, const std::vector<TourDistances>& distances);

}  // namespace dmrp::planners::ecbs8
