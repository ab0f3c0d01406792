// SPDX-License-Identifier: MIT
// constraint.hpp: what the high level asks of an agent, and a table of it for the searches of one agent.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "planners/mapf/problem.hpp"

namespace dmrp::planners {

// One agent's constraint. A few kinds say something to the others too; binds() and for_another() tell what.
struct Constraint {
  enum class Kind : std::uint8_t {
    avoid_vertex,  // not at `location` from time t on, before `until`
    avoid_move,    // not arriving at `location` from `from` at time t
    pass_vertex,   // at `location` at time t; all others avoid it (disjoint splitting, Li et al. 2019)
    finish_after,  // comes to rest at its last goal, for good, later than t (target reasoning, Li et al. 2020)
    finish_by,     // comes to rest at its last goal at t or before: from t on all others avoid `location`, that goal
  };

  std::int32_t agent = -1;
  Kind kind = Kind::avoid_vertex;
  Location location = nowhere;
  Location from = nowhere;
  std::int32_t t = 0;
  std::int32_t until = 0;

  auto operator<=>(const Constraint&) const = default;

  // Whether agents other than `agent` have to heed it as well.
  bool binds_others() const { return kind == Kind::pass_vertex || kind == Kind::finish_by; }

  // What it means to another agent, where it binds_others().
  Constraint for_another(std::int32_t other) const {
    return {other, Kind::avoid_vertex, location, nowhere, t, kind == Kind::finish_by ? forever : t + 1};
  }
};

inline Constraint avoid_vertex(std::int32_t agent, Location location, std::int32_t t) {
  return {agent, Constraint::Kind::avoid_vertex, location, nowhere, t, t + 1};
}
inline Constraint avoid_vertex_range(std::int32_t agent, Location location, std::int32_t t, std::int32_t until) {
  return {agent, Constraint::Kind::avoid_vertex, location, nowhere, t, until};
}
inline Constraint avoid_move(std::int32_t agent, Location from, Location to, std::int32_t t) {
  return {agent, Constraint::Kind::avoid_move, to, from, t, t + 1};
}
inline Constraint pass_vertex(std::int32_t agent, Location location, std::int32_t t) {
  return {agent, Constraint::Kind::pass_vertex, location, nowhere, t, t + 1};
}
inline Constraint finish_after(std::int32_t agent, Location goal, std::int32_t t) {
  return {agent, Constraint::Kind::finish_after, goal, nowhere, t, t + 1};
}
inline Constraint finish_by(std::int32_t agent, Location goal, std::int32_t t) {
  return {agent, Constraint::Kind::finish_by, goal, nowhere, t, t + 1};
}

// Of everything but the agent.
std::uint64_t hash_of(const Constraint& constraint);

// Whether a path (which rests at its end) does what the constraint asks of its own agent.
bool satisfies(PathView path, const Constraint& constraint);

// The constraints of one agent, found by location. Filled anew for each search in time proportional to their number.
class ConstraintTable {
 public:
  // A place to be at a time.
  struct Landmark {
    std::int32_t t;
    Location location;
  };

  explicit ConstraintTable(const GridGraph& graph)
      : location_count_(static_cast<std::size_t>(graph.location_count())) {}

  // `agent` is whom the constraints are of; they are its own and those for_another().
  void fill(const Agent& agent, std::span<const Constraint> constraints);

  // Whether the agent may go (or wait) so that it arrives at time t. Landmarks are not looked at.
  bool allows(Location from, Location to, std::int32_t t) const {
    if (!constrains(to)) return true;
    for (std::int32_t i = first_[static_cast<std::size_t>(to)]; i >= 0;
         i = entries_[static_cast<std::size_t>(i)].next) {
      const Entry& entry = entries_[static_cast<std::size_t>(i)];
      if (entry.t <= t && t < entry.until && (entry.from == nowhere || entry.from == from)) return false;
    }
    return true;
  }

  // Whether some arrival at `to` is not allowed.
  bool constrains(Location to) const { return !entries_.empty() && epoch_of_[static_cast<std::size_t>(to)] == epoch_; }

  // Whether the agent may be at `location` at time t, and over which times from `first` to before `end` around t that
  // stays the same; narrows [first, end) to them. Landmarks elsewhere forbid a place, too.
  bool narrow(Location location, std::int32_t t, std::int32_t& first, std::int32_t& end) const;

  // Whether the agent may arrive at time t by this move, being at `to` then allowed.
  bool allows_move(Location from, Location to, std::int32_t t) const {
    if (!constrains(to)) return true;
    for (std::int32_t i = first_[static_cast<std::size_t>(to)]; i >= 0;
         i = entries_[static_cast<std::size_t>(i)].next) {
      const Entry& entry = entries_[static_cast<std::size_t>(i)];
      if (entry.from == from && entry.t == t) return false;
    }
    return true;
  }

  // From this time on what is allowed stays the same.
  std::int32_t constant_from() const { return constant_from_; }

  // The agent may come to rest at its last goal, for good, at a time from here (forever: never) ...
  std::int32_t finish_from() const { return finish_from_; }
  // ... to here (forever: any time).
  std::int32_t finish_until() const { return finish_until_; }

  // In the order of time; no two at one time unless finish_from() is forever.
  std::span<const Landmark> landmarks() const { return landmarks_; }

 private:
  struct Entry {
    Location from;
    std::int32_t t;
    std::int32_t until;
    std::int32_t next;
  };
  void add_entry(Location location, const Entry& entry);

  std::size_t location_count_;
  std::vector<std::uint32_t> epoch_of_;  // by location, from the first entry on: first_ is of this filling if it
                                         // equals epoch_
  std::vector<std::int32_t> first_;
  std::vector<Entry> entries_;
  std::vector<Landmark> landmarks_;
  std::uint32_t epoch_ = 0;
  std::int32_t constant_from_ = 0;
  std::int32_t finish_from_ = 0;
  std::int32_t finish_until_ = forever;
};

}  // namespace dmrp::planners
