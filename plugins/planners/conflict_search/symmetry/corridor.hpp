// SPDX-License-Identifier: MIT
// corridor.hpp: corridor symmetry (Li et al. 2020 and 2021): two agents meet head-on where they cannot pass each other.
// Either one of them leaves the corridor before the other enters it, or one takes another way.
//
// Let agent a leave the corridor, of `length` steps, at its exit y, and b at x. Let t_a be the earliest time at which a
// can be at y, and t'_a the earliest without the corridor's last step. If a is at y by min(t'_a - 1, t_b + length), it
// came through the corridor and entered it by t_b, thus before b had left it. If the same holds for b, both were in the
// corridor at the same time, in opposite directions. So one agent must stay away from its exit until then.
//
// The last goal of b, say, can be inside the corridor (corridor-target symmetry). If a comes through, b cannot be in
// front of a after a has entered. Then b came to rest behind a, at t_a + 1 + (steps from y to the goal) or later, or b
// came from x, by another way or by first leaving the corridor for a. And if b stays in front of a, then a must take
// another way.
//
// A part of a corridor is a corridor. An agent may wait inside because it must not be at its exit yet; it then meets
// the other agent in the part of the corridor that it passes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "planners/conflict_search/low_level/mdd.hpp"
#include "planners/conflict_search/symmetry/earliest_arrival.hpp"
#include "planners/conflict_search/symmetry/symmetry_split.hpp"

namespace dmrp::planners {

// The corridors of a graph: chains of locations that have two neighbors each.
class Corridors {
 public:
  struct Corridor {
    std::vector<Location> cells;  // the chain, between the locations at its two ends

    std::int32_t length() const { return static_cast<std::int32_t>(cells.size()) - 1; }
    Location end(bool last) const { return last ? cells.back() : cells.front(); }
  };

  // Finds no corridors if the graph is not symmetric.
  explicit Corridors(const GridGraph& graph);

  bool is_symmetric() const { return is_symmetric_; }

  // The corridor whose chain contains the location, or null.
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

// A place where two agents meet head-on: a corridor, a part of one, or a single edge.
struct Passage {
  // The way of one agent through the passage.
  struct Way {
    Location exit;
    Location last_before_exit;
    std::int32_t length;  // steps from the entrance to the exit or, if the agent's last goal is inside, to the goal
    std::int32_t beyond;  // steps from the goal inside to the exit; 0 if the goal is not inside

    bool ends_inside() const { return beyond > 0; }
  };
  using Ways = std::array<Way, 2>;  // of conflict.a, conflict.b

  Ways ways;
  std::optional<Ways> shorter;  // the second choice
};

// The passage of a conflict, if there is one in which the agents seem to block each other. A cheap test: it looks at
// the paths only.
std::optional<Passage> find_passage(const Corridors& corridors, const Conflict& conflict, PathView path_a,
                                    PathView path_b);

// One of the two agents, with what the reasoning needs of it.
struct CorridorAgent {
  const Agent& agent;
  const TourTable& table;
  const ConstraintTable& constraints;
  const Mdd& mdd;  // of the least cost
  PathView path;
};

// The split for a passage of find_passage(). Nothing if no split makes both current paths invalid, or if the search
// takes too long.
std::optional<SymmetrySplit> find_corridor(const GridGraph& graph, const Passage& passage, const Conflict& conflict,
                                           const CorridorAgent& a, const CorridorAgent& b,
                                           EarliestArrival& earliest_arrival);

// Corridor splits for the conflicts of one search. Builds its tables on first use.
class CorridorReasoning {
 public:
  // One of the two agents of a conflict, as the node that has the conflict knows it. `constraints` are the agent's.
  struct Party {
    std::int32_t agent;
    PathView path;
    const std::vector<Constraint>& constraints;
    const Mdd& mdd;
  };

  CorridorReasoning(const Problem& problem, const std::vector<TourTable>& tables, StopSignal& stop)
      : problem_(problem), tables_(tables), stop_(stop) {}

  // The passage of the conflict, if it has one. A cheap test before find_split(), which needs MDDs.
  std::optional<Passage> find_passage(const Conflict& conflict, PathView path_a, PathView path_b);
  std::optional<SymmetrySplit> find_split(const Passage& passage, const Conflict& conflict, const Party& a,
                                          const Party& b);

 private:
  struct Scratch {
    Scratch(const GridGraph& graph, StopSignal& stop)
        : tables{ConstraintTable(graph), ConstraintTable(graph)}, earliest_arrival(graph, &stop) {}

    std::array<ConstraintTable, 2> tables;
    EarliestArrival earliest_arrival;
  };

  const Problem& problem_;
  const std::vector<TourTable>& tables_;
  StopSignal& stop_;
  std::optional<Corridors> corridors_;
  std::optional<Scratch> scratch_;
};

}  // namespace dmrp::planners
