// SPDX-License-Identifier: MIT
// conflict_table.hpp: who is where and when, for counting and listing conflicts with the paths of other agents.
//
// Agents' paths are put in and taken out one by one: moving from one node of a constraint tree to another touches only
// the agents whose paths differ.
#pragma once

#include <cstdint>
#include <vector>

#include "problem.hpp"

namespace dmrp::planners {

// Two agents, a < b, at `location` at time t; or, where `from` is a location, a arrives there at time t from `from`
// while b goes the other way.
struct Conflict {
  std::int32_t a = -1;
  std::int32_t b = -1;
  Location location = nowhere;
  Location from = nowhere;
  std::int32_t t = 0;
};

class ConflictTable {
 public:
  ConflictTable(const GridGraph& graph, std::size_t agent_count);

  // Puts an agent's path in the place of the one before. The path must stay where it is. No two agents may end at one
  // location. An empty path takes the agent out.
  void set(std::int32_t agent, PathView path);
  PathView path(std::int32_t agent) const { return paths_[static_cast<std::size_t>(agent)]; }

  // From this time on everybody rests.
  std::int32_t rest_from() const;

  // Who is at `location` at time t (in no order that means anything), on its way or resting.
  template <class Visit>
  void for_each_at(Location location, std::int32_t t, Visit visit) const {
    visit_at(location, location, t, [&](std::int32_t agent, bool) { visit(agent); });
  }

  // Conflicts that somebody who goes (or waits) so that it arrives at time t would have.
  std::int32_t count_at(Location from, Location to, std::int32_t t) const {
    std::int32_t count = 0;
    visit_at(from, to, t, [&](std::int32_t, bool) { ++count; });
    return count;
  }

  // Conflicts that somebody who stays at `location` after time t would have: agents that still pass.
  std::int32_t count_after(Location location, std::int32_t t) const;

  // Lists the conflicts of `agent`, which is not in the table, in the order of time.
  void list(std::int32_t agent, PathView path, std::vector<Conflict>& out) const;

 private:
  // Calls visit(agent, is_swap) for each conflict of an arrival.
  template <class Visit>
  void visit_at(Location from, Location to, std::int32_t t, Visit visit) const {
    visit_occupants(to, t, [&](std::int32_t agent) { visit(agent, false); });
    if (resting_from_[static_cast<std::size_t>(to)] < t) visit(resting_[static_cast<std::size_t>(to)] - 1, false);
    if (from == to || t == 0) return;
    visit_occupants(to, t - 1, [&](std::int32_t agent) {
      const PathView path = paths_[static_cast<std::size_t>(agent)];
      if (cost_of(path) >= t && path[static_cast<std::size_t>(t)] == from) visit(agent, true);
    });
  }
  template <class Visit>
  void visit_occupants(Location location, std::int32_t t, Visit visit) const {
    if (t >= row_count_) return;
    for (Link link = first_[cell(location, t)]; link != 0; link = next_[link - 1u][static_cast<std::size_t>(t)])
      visit(static_cast<std::int32_t>(link) - 1);
  }
  std::size_t cell(Location location, std::int32_t t) const {
    return static_cast<std::size_t>(t) * location_count_ + static_cast<std::size_t>(location);
  }
  void take_out(std::int32_t agent);

  using Link = std::uint16_t;  // an agent plus one; zero ends a list
  std::size_t location_count_;
  std::int32_t row_count_ = 0;
  std::vector<Link> first_;                 // by time and location: the agents there on their way
  std::vector<std::vector<Link>> next_;     // by agent and time: the next one in the same list
  std::vector<Link> resting_;               // by location: who ends there ...
  std::vector<std::int32_t> resting_from_;  // ... and when; or forever
  std::vector<PathView> paths_;
};

}  // namespace dmrp::planners
