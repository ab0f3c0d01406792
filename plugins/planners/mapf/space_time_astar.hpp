// SPDX-License-Identifier: MIT
// space_time_astar.hpp: the best path of one agent under constraints.
//
// Best means, in this order: fewest steps, fewest conflicts with the paths in the conflict table, fewest turns. All
// three are exact: A* in lexicographic order over states (location, heading, leg of the tour, time), with the true
// distance and the fewest turns of the tour table as heuristic. Times after the last constraint and the last motion
// of others are one, so that the search always ends.
#pragma once

#include <cstdint>
#include <vector>

#include "conflict_table.hpp"
#include "constraint.hpp"
#include "stop_signal.hpp"
#include "tour_table.hpp"

namespace dmrp::planners {

class SpaceTimeAStar {
 public:
  explicit SpaceTimeAStar(const GridGraph& graph) : graph_(graph) {}

  enum class Result { found, none, stopped };

  // The agent itself must not be in the conflict table.
  Result search(const Agent& agent, const TourTable& table, const ConstraintTable& constraints,
                const ConflictTable& others, StopSignal& stop, std::vector<Location>& path);

  std::int64_t expanded() const { return expanded_; }

 private:
  // Smaller is better; of equals the state that is further on its way.
  struct Key {
    std::int32_t steps;  // estimate of the whole path
    std::int32_t conflicts;
    std::int32_t turns;  // estimate of the whole path
    std::int32_t t;

    bool operator<(const Key& other) const {
      if (steps != other.steps) return steps < other.steps;
      if (conflicts != other.conflicts) return conflicts < other.conflicts;
      if (turns != other.turns) return turns < other.turns;
      return t > other.t;
    }
  };
  struct State {
    Key key;
    Location location;
    std::int32_t parent;
    std::int32_t leg;
    std::int32_t turns;  // so far
    std::int8_t heading;
    bool superseded;  // a better way to the same state is known
  };
  struct OpenEntry {
    Key key;
    std::int32_t state;
  };
  // States by what distinguishes them; open addressing, emptied by a new epoch.
  struct Slot {
    std::uint64_t identity;
    std::uint32_t epoch;
    std::int32_t state;
  };
  struct Task {
    const Agent& agent;
    const TourTable& table;
    const ConstraintTable& constraints;
    const ConflictTable& others;
    std::int32_t static_from;  // from here on time makes no difference
    std::int32_t rest_from;    // the path cannot end before
  };

  static bool is_worse(const OpenEntry& a, const OpenEntry& b);
  bool is_end(const Task& task, const State& state) const;
  void generate_successors(const Task& task, std::int32_t parent);
  void generate(const Task& task, Location location, std::int32_t leg, Direction heading, std::int32_t turns,
                std::int32_t conflicts, std::int32_t t, std::int32_t parent);
  std::uint64_t identity_of(const Task& task, const State& state) const;
  Slot& find_slot(std::uint64_t identity);
  void grow_slots();
  void begin();

  const GridGraph& graph_;
  std::vector<State> states_;
  std::vector<OpenEntry> open_;
  std::vector<Slot> slots_;
  std::uint32_t epoch_ = 0;
  std::int64_t expanded_ = 0;
};

}  // namespace dmrp::planners
