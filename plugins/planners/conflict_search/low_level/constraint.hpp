// SPDX-License-Identifier: MIT
// constraint.hpp: the constraints that the high level puts on agents, and a lookup table of one agent's constraints.
#pragma once

#include <cassert>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "planners/mapf/problem.hpp"

namespace dmrp::planners {

// A constraint on one agent. Some kinds bind the other agents, too: see binds_others().
struct Constraint {
  enum class Kind : std::uint8_t {
    avoid_vertex,  // must not be at `location` from time t to before `until`
    avoid_move,    // must not arrive at `location` from `from` at time t
    pass_vertex,   // must be at `location` at time t; all others avoid it then (disjoint splitting, Li et al. 2019)
    finish_after,  // must come to rest at its last goal, `location`, later than t (target reasoning, Li et al. 2020)
    finish_by,     // must come to rest at its last goal, `location`, by t; all others avoid it from t on
  };

  std::int32_t agent = -1;
  Kind kind = Kind::avoid_vertex;
  Location location = nowhere;
  Location from = nowhere;
  std::int32_t t = 0;
  std::int32_t until = 0;

  auto operator<=>(const Constraint&) const = default;

  // Whether the constraint also applies to agents other than `agent`.
  bool binds_others() const { return kind == Kind::pass_vertex || kind == Kind::finish_by; }

  // The constraint on another agent that follows, if it binds_others().
  Constraint for_another(std::int32_t other) const {
    assert(binds_others() && other != agent);
    return {other, Kind::avoid_vertex, location, nowhere, t, kind == Kind::finish_by ? forever : t + 1};
  }
};

inline Constraint avoid_vertex(std::int32_t agent, Location location, std::int32_t t) {
  return {agent, Constraint::Kind::avoid_vertex, location, nowhere, t, t + 1};
}
inline Constraint avoid_vertex_range(std::int32_t agent, Location location, std::int32_t t, std::int32_t until) {
  assert(t < until);
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

// A hash of all fields but the agent.
std::uint64_t hash_of(const Constraint& constraint);

// Whether a path of the constraint's own agent, which rests at its end, satisfies the constraint.
bool satisfies(PathView path, const Constraint& constraint);

// The constraints of one agent by location. fill() takes time proportional to their number.
class ConstraintTable {
 public:
  // The agent must be at `location` at time t.
  struct Landmark {
    std::int32_t t;
    Location location;
  };

  explicit ConstraintTable(const GridGraph& graph)
      : location_count_(static_cast<std::size_t>(graph.location_count())) {}

  // Replaces the content by the constraints on `agent`: its own and those that follow for_another().
  void fill(const Agent& agent, std::span<const Constraint> constraints);

  // Whether a move or wait may arrive at time t. Ignores landmarks.
  bool allows(Location from, Location to, std::int32_t t) const {
    if (!constrains(to)) return true;
    for (std::int32_t i = first_[static_cast<std::size_t>(to)]; i >= 0;
         i = entries_[static_cast<std::size_t>(i)].next) {
      const Entry& entry = entries_[static_cast<std::size_t>(i)];
      if (entry.t <= t && t < entry.until && (entry.from == nowhere || entry.from == from)) return false;
    }
    return true;
  }

  // Whether some arrival at `to` is forbidden.
  bool constrains(Location to) const { return !entries_.empty() && epoch_of_[static_cast<std::size_t>(to)] == epoch_; }

  // Whether the agent may be at `location` at time t. Narrows [first, end) to the times around t with the same answer.
  // A landmark elsewhere forbids the location, too.
  bool narrow(Location location, std::int32_t t, std::int32_t& first, std::int32_t& end) const;

  // Whether the agent may arrive at time t by this move, given that it may be at `to` then.
  bool allows_move(Location from, Location to, std::int32_t t) const {
    if (!constrains(to)) return true;
    for (std::int32_t i = first_[static_cast<std::size_t>(to)]; i >= 0;
         i = entries_[static_cast<std::size_t>(i)].next) {
      const Entry& entry = entries_[static_cast<std::size_t>(i)];
      if (entry.from == from && entry.t == t) return false;
    }
    return true;
  }

  // From this time on the constraints do not change.
  std::int32_t constant_from() const { return constant_from_; }

  // The earliest time at which the agent may come to rest at its last goal; forever: never.
  std::int32_t finish_from() const { return finish_from_; }
  // The latest such time; forever: any.
  std::int32_t finish_until() const { return finish_until_; }

  // By ascending time. Two at the same time contradict each other; then finish_from() is forever.
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
  std::vector<std::uint32_t> epoch_of_;  // by location: first_ is valid if this equals epoch_; empty before any entry
  std::vector<std::int32_t> first_;
  std::vector<Entry> entries_;
  std::vector<Landmark> landmarks_;
  std::uint32_t epoch_ = 0;
  std::int32_t constant_from_ = 0;
  std::int32_t finish_from_ = 0;
  std::int32_t finish_until_ = forever;
};

}  // namespace dmrp::planners
