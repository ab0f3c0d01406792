// SPDX-License-Identifier: MIT
// constraint.hpp: what the high level forbids an agent, and a table of it for the searches of one agent.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "problem.hpp"

namespace dmrp::planners {

// The agent must not be at `location` at time t; or, where `from` is a location, not arrive there from it at time t.
struct Constraint {
  std::int32_t agent = -1;
  Location location = nowhere;
  Location from = nowhere;
  std::int32_t t = 0;

  auto operator<=>(const Constraint&) const = default;
};

// The constraints of one agent, found by location. Filled anew for each search in time proportional to their number.
class ConstraintTable {
 public:
  explicit ConstraintTable(const GridGraph& graph);

  void fill(const std::vector<Constraint>& constraints);

  // Whether the agent may go (or wait) so that it arrives at time t.
  bool allows(Location from, Location to, std::int32_t t) const {
    if (epoch_of_[static_cast<std::size_t>(to)] != epoch_) return true;
    for (std::int32_t i = first_[static_cast<std::size_t>(to)]; i >= 0;
         i = entries_[static_cast<std::size_t>(i)].next) {
      const Entry& entry = entries_[static_cast<std::size_t>(i)];
      if (entry.t == t && (entry.from == nowhere || entry.from == from)) return false;
    }
    return true;
  }

  // From this time on nothing is forbidden.
  std::int32_t free_from() const { return free_from_; }

  // The earliest time from which the agent may stay at `location` for good.
  std::int32_t rest_from(Location location) const;

 private:
  struct Entry {
    Location from;
    std::int32_t t;
    std::int32_t next;
  };
  std::vector<std::uint32_t> epoch_of_;  // by location: first_ is of this filling if it equals epoch_
  std::vector<std::int32_t> first_;
  std::vector<Entry> entries_;
  std::uint32_t epoch_ = 0;
  std::int32_t free_from_ = 0;
};

}  // namespace dmrp::planners
