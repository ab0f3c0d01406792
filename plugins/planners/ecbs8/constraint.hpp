// SPDX-License-Identifier: MIT
// constraint.hpp: the constraints that the high level puts on robots, and a lookup table of one robot's constraints.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/ecbs8/step_cost.hpp"

namespace dmrp::planners::ecbs8 {

// A use of the grid that is forbidden from time `from` to time `until`, both included. The time of a move is its
// arrival.
struct Constraint {
  enum class Use : std::uint8_t {
    at,      // being at `location`
    touch,   // being there, and diagonals that pass beside it and begin or end then
    edge,    // straight moves between `location` and `other`, in both directions
    corner,  // the four diagonals across the corner that is common to `location`, its lower left cell, and three others
    end,     // coming to rest at the last goal
  };
  Use use = Use::at;
  Location location = nowhere;
  Location other = nowhere;
  std::int32_t from = 0;
  std::int32_t until = 0;
};

// The constraints of one robot by location. fill() takes time proportional to their number.
class ConstraintTable {
 public:
  explicit ConstraintTable(const Graph& graph);

  void fill(const std::vector<Constraint>& constraints);

  // Whether a move may arrive at time t; `d` is no_direction for a wait.
  bool allows(Location from, Location to, Direction d, std::int32_t t) const;

  // From this time on the constraints do not change.
  std::int32_t static_from() const { return static_from_; }

  // The `touch` constraints without an end.
  const std::vector<Constraint>& closed_for_good() const { return closed_for_good_; }

  // The earliest time from which the robot may rest at its last goal for good.
  std::int32_t rest_from(Location last_goal) const;

 private:
  struct Entry {
    Constraint constraint;
    std::int32_t next;
  };
  bool forbids_being(Location location, std::int32_t t) const;
  bool forbids_passing(Location location, std::int32_t t) const;
  bool forbids_edge(Location location, Location other, std::int32_t t) const;
  bool forbids_corner(Location location, std::int32_t t) const;
  bool has_entries(Location location) const { return epoch_of_[static_cast<std::size_t>(location)] == epoch_; }
  template <class Test>
  bool any_entry(Location location, Test test) const;

  const Graph& graph_;
  std::vector<std::uint32_t> epoch_of_;  // by location: first_ is valid if this equals epoch_
  std::vector<std::int32_t> first_;
  std::vector<Entry> entries_;
  std::vector<Constraint> closed_for_good_;
  std::uint32_t epoch_ = 0;
  std::int32_t static_from_ = 0;
  std::int32_t end_from_ = 0;
};

}  // namespace dmrp::planners::ecbs8
