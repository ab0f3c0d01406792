// SPDX-License-Identifier: MIT
// conflict_table.hpp: who is where and when, for counting and listing conflicts with the paths of other agents.
//
// Agents' paths are put in and taken out one by one: moving from one node of a constraint tree to another touches only
// the agents whose paths differ.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <memory>
#include <vector>

#include "planners/conflict_search/low_level/constraint.hpp"

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
  // Makes room for paths of `expected_steps`; for longer ones it grows, which takes long when there are many.
  ConflictTable(const GridGraph& graph, std::size_t agent_count, std::int32_t expected_steps = 0);

  // Puts an agent's path in the place of the one before. The path must stay where it is. No two agents may end at one
  // location. An empty path takes the agent out.
  void set(std::int32_t agent, PathView path);
  PathView path(std::int32_t agent) const { return paths_[static_cast<std::size_t>(agent)]; }

  // From this time on everybody rests.
  std::int32_t rest_from() const;

  // From when on somebody is at `location` for good; or forever, for nobody.
  std::int32_t resting_from(Location location) const { return resting_from_[static_cast<std::size_t>(location)]; }

  // Whether somebody is at `location` at time t on its way (up to its last step).
  bool is_passed(Location location, std::int32_t t) const {
    return t < horizon_ && (passed_[word(location, t)] >> (t % 64) & 1u);
  }
  // The first time from t on, or the last time up to t, when somebody is there on its way; or forever, or -1.
  std::int32_t next_passed(Location location, std::int32_t t) const;
  std::int32_t previous_passed(Location location, std::int32_t t) const;

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
    visit_passing(to, t, [&](std::int32_t agent) { visit(agent, false); });
    if (resting_from(to) < t) visit(resting_[static_cast<std::size_t>(to)] - 1, false);
    if (from == to || t == 0) return;
    visit_passing(to, t - 1, [&](std::int32_t agent) {
      const PathView path = paths_[static_cast<std::size_t>(agent)];
      if (cost_of(path) >= t && path[static_cast<std::size_t>(t)] == from) visit(agent, true);
    });
  }
  template <class Visit>
  void visit_passing(Location location, std::int32_t t, Visit visit) const {
    if (!is_passed(location, t)) return;
    for (Link link = first_[cell(location, t)]; link != 0; link = next_[link - 1u][static_cast<std::size_t>(t)])
      visit(static_cast<std::int32_t>(link) - 1);
  }
  std::size_t cell(Location location, std::int32_t t) const {
    return static_cast<std::size_t>(location) * static_cast<std::size_t>(horizon_) + static_cast<std::size_t>(t);
  }
  std::size_t word(Location location, std::int32_t t) const { return cell(location, t) / 64; }
  void put_in(std::int32_t agent);
  void take_out(std::int32_t agent);
  void grow(std::int32_t horizon);

  using Link = std::uint16_t;  // an agent plus one; zero ends a list
  std::size_t location_count_;
  std::int32_t horizon_ = 0;                // times told apart, a multiple of 64
  std::vector<std::uint64_t> passed_;       // by location and time, a bit each: whether somebody is there on its way
  std::unique_ptr<Link[]> first_;           // likewise: the first of them; set only where the bit is
  std::vector<std::vector<Link>> next_;     // by agent and time: the next one in the same list
  std::vector<Link> resting_;               // by location: who ends there ...
  std::vector<std::int32_t> resting_from_;  // ... and when; or forever
  std::vector<PathView> paths_;
};

inline std::int32_t ConflictTable::next_passed(Location location, std::int32_t t) const {
  if (t >= horizon_) return forever;
  const std::size_t end = word(location, 0) + static_cast<std::size_t>(horizon_) / 64;
  std::size_t at = word(location, t);
  std::uint64_t bits = passed_[at] & (~std::uint64_t{0} << (t % 64));
  while (bits == 0 && ++at < end) bits = passed_[at];
  if (bits == 0) return forever;
  return static_cast<std::int32_t>((at - word(location, 0)) * 64) + std::countr_zero(bits);
}

inline std::int32_t ConflictTable::previous_passed(Location location, std::int32_t t) const {
  if (horizon_ == 0) return -1;
  t = std::min(t, horizon_ - 1);
  const std::size_t begin = word(location, 0);
  std::size_t at = word(location, t);
  std::uint64_t bits = passed_[at] & (~std::uint64_t{0} >> (63 - t % 64));
  while (bits == 0 && at > begin) bits = passed_[--at];
  if (bits == 0) return -1;
  return static_cast<std::int32_t>((at - begin) * 64) + 63 - std::countl_zero(bits);
}

}  // namespace dmrp::planners
