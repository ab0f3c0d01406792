// SPDX-License-Identifier: MIT
// corridor.hpp: two agents that meet head-on where they cannot pass each other (corridor symmetry, Li et al. 2020 and
// 2021): one of them has to be through before the other comes in, or one has to go round.
//
// Let agent a leave the corridor, of `length` steps, at its exit y, and b at x; t_a is the earliest time at which a
// can be at y, and t'_a the earliest without the corridor's last step. If a is at y at time min(t'_a - 1, t_b + length)
// or before, it came through the corridor and went in at t_b or before, thus before b was through. If the same holds
// for b, both were in the corridor at one time, in opposite directions. So one agent has to stay away from its exit
// until then.
//
// Likewise where the last goal of b, say, is inside (corridor-target symmetry). If a comes through, b cannot be in
// front of it from when a goes in: b came to rest behind it, not before t_a + 1 + (steps from y to the goal), or else
// came from x, either round or first through and out of a's way. And a, if b is to stay in front of it, has to go
// round.
//
// Any part of a corridor is one too. So an agent that waits inside, as it must not be at its exit yet, is met on the
// part of the corridor that it does go through.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "planners/conflict_search/low_level/mdd.hpp"
#include "planners/conflict_search/symmetry/earliest_arrival.hpp"
#include "planners/conflict_search/symmetry/symmetry_split.hpp"

namespace dmrp::planners {

// The corridors of a graph: chains of locations with two neighbors each.
class Corridors {
 public:
  struct Corridor {
    std::vector<Location> cells;  // the chain and, first and last, the locations at its ends

    std::int32_t length() const { return static_cast<std::int32_t>(cells.size()) - 1; }
    Location end(bool last) const { return last ? cells.back() : cells.front(); }
  };

  // None in a graph in which not every move can be undone.
  explicit Corridors(const GridGraph& graph);

  bool is_symmetric() const { return is_symmetric_; }

  // The corridor that has the location inside, or null.
  const Corridor* inside(Location location) const {
    const std::int32_t number = corridor_of_[static_cast<std::size_t>(location)];
    return number < 0 ? nullptr : &corridors_[static_cast<std::size_t>(number)];
  }
  // Steps from the corridor's first location to one inside.
  std::int32_t position(Location location) const { return position_[static_cast<std::size_t>(location)]; }

 private:
  void follow(const GridGraph& graph, Location end, Location first);

  bool is_symmetric_;
  std::vector<Corridor> corridors_;
  std::vector<std::int32_t> corridor_of_;
  std::vector<std::int32_t> position_;
};

// Where two agents meet head-on: a corridor, a part of one, or a single edge on which they swap.
struct Passage {
  // The way of one agent.
  struct Way {
    Location exit;
    Location last_before_exit;
    std::int32_t length;  // steps from the entrance to the exit or, if the agent's last goal is inside, to the goal
    std::int32_t beyond;  // steps from the goal inside to the exit, else zero

    bool ends_inside() const { return beyond > 0; }
  };
  using Ways = std::array<Way, 2>;  // of conflict.a, conflict.b

  Ways ways;
  std::optional<Ways> shorter;  // if the first does not do
};

// The passage of a conflict, if there is one in which the agents seem to be in each other's way. The paths are all that
// it takes to tell.
std::optional<Passage> find_passage(const Corridors& corridors, const Conflict& conflict, PathView path_a,
                                    PathView path_b);

// What is known of one of the agents.
struct CorridorAgent {
  const Agent& agent;
  const TourTable& table;
  const ConstraintTable& constraints;
  const Mdd& mdd;  // of the least cost
  PathView path;
};

// The split at a passage of find_passage(). Nothing if there is none that both paths at hand break, or if it takes too
// long to find out.
std::optional<SymmetrySplit> find_corridor(const GridGraph& graph, const Passage& passage, const Conflict& conflict,
                                           const CorridorAgent& a, const CorridorAgent& b,
                                           EarliestArrival& earliest_arrival);

}  // namespace dmrp::planners
