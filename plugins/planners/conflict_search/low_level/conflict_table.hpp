// SPDX-License-Identifier: MIT
// conflict_table.hpp: the positions of all agents over time, to count and list conflicts with a path.
//
// Paths are added and removed one by one, so changing from one node of the constraint tree to another costs only the
// paths that differ.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "planners/conflict_search/low_level/constraint.hpp"

namespace dmrp::planners {

// Vertex conflict: agents a < b are both at `location` at time t, and `from` is nowhere. Swap conflict: a moves from
// `from` to `location`, b the other way, arriving at time t.
struct Conflict {
  std::int32_t a = -1;
  std::int32_t b = -1;
  Location location = nowhere;
  Location from = nowhere;
  std::int32_t t = 0;
};

class ConflictTable {
 public:
  // Reserves space for paths of `expected_steps`. Longer paths make the table grow, which is slow.
  ConflictTable(const GridGraph& graph, std::size_t agent_count, std::int32_t expected_steps = 0);

  // Replaces an agent's path; an empty path removes the agent. The table keeps the view, not a copy. No two agents may
  // end at the same location.
  void set(std::int32_t agent, PathView path);
  PathView path(std::int32_t agent) const { return paths_[static_cast<std::size_t>(agent)]; }

  // From this time on all agents rest.
  std::int32_t rest_from() const;

  // The time at which an agent comes to rest at `location`; forever if none does.
  std::int32_t resting_from(Location location) const { return resting_from_[static_cast<std::size_t>(location)]; }

  // Whether an agent is at `location` at time t on its path, the last step included.
  bool is_passed(Location location, std::int32_t t) const {
    return t < horizon_ && (passed_[word(location, t)] >> (t % 64) & 1u);
  }
  // The first such time from t on (forever if none), and the last one up to t (-1 if none).
  std::int32_t next_passed(Location location, std::int32_t t) const;
  std::int32_t previous_passed(Location location, std::int32_t t) const;

  // The number of conflicts of a move or wait that arrives at time t.
  std::int32_t count_at(Location from, Location to, std::int32_t t) const {
    std::int32_t count = 0;
    visit_at(from, to, t, [&](std::int32_t, bool) { ++count; });
    return count;
  }

  // The number of conflicts of staying at `location` after time t: one for each agent and step that passes.
  std::int32_t count_after(Location location, std::int32_t t) const;

  // Appends the conflicts of `agent`, which is not in the table, by ascending time.
  void list(std::int32_t agent, PathView path, std::vector<Conflict>& out) const;

 private:
  using Link = std::uint16_t;  // an agent plus one; zero ends a list

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
    for (Link link = first(location, t); link != 0; link = next_[link - 1u][static_cast<std::size_t>(t)])
      visit(static_cast<std::int32_t>(link) - 1);
  }
  std::size_t cell(Location location, std::int32_t t) const {
    return static_cast<std::size_t>(location) * static_cast<std::size_t>(horizon_) + static_cast<std::size_t>(t);
  }
  std::size_t word(Location location, std::int32_t t) const { return cell(location, t) / 64; }
  void put_in(std::int32_t agent);
  void take_out(std::int32_t agent);
  void grow(std::int32_t horizon);
  // The first agent of the list at a place and time; valid if the bit is set.
  Link first(Location location, std::int32_t t) const {
    return first_[std::size_t{block_[word(location, t)]} * 64 + static_cast<std::size_t>(t % 64)];
  }
  // The same, with space for it.
  Link& first_with_space(Location location, std::int32_t t);

  std::size_t location_count_;
  std::int32_t horizon_ = 0;                // number of times in the table, a multiple of 64
  std::vector<std::uint64_t> passed_;       // by location and time, one bit: whether an agent passes
  std::vector<std::uint32_t> block_;        // by the words of passed_: where 64 steps are in first_; 0: nowhere
  std::vector<Link> first_;                 // first agents of the lists; the first 64 are not used
  std::vector<std::vector<Link>> next_;     // by agent and time: the next agent of the same list
  std::vector<Link> resting_;               // by location: the agent that ends there ...
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
