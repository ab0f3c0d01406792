// SPDX-License-Identifier: MIT
// space_time_astar.hpp: the best path of one agent under constraints.
//
// Best means, in this order: fewest steps, fewest conflicts with the paths in the conflict table, fewest turns. All
// three are exact: A* in lexicographic order over states (location, heading, leg of the tour, time), with the true
// distance and the fewest turns of the tour table as heuristic. Times after the last constraint and the last motion
// of others are one, so that the search always ends.
#pragma once

#include <array>
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
  // Smaller is better, component by component; of equals the state that is further on its way.
  struct Key {
    std::uint64_t steps_and_conflicts;  // estimates of the whole path, as turns
    std::uint64_t turns_and_time_left;

    Key(std::int32_t steps, std::int32_t conflicts, std::int32_t turns, std::int32_t t)
        : steps_and_conflicts(pack(steps, conflicts)), turns_and_time_left(pack(turns, INT32_MAX - t)) {}
    static std::uint64_t pack(std::int32_t high, std::int32_t low) {
      return static_cast<std::uint64_t>(high) << 32 | static_cast<std::uint32_t>(low);
    }
  };
  struct State {
    Location location;
    std::int32_t parent;
    std::int32_t leg;
    std::int32_t t;
    std::int32_t conflicts;  // so far
    std::int32_t turns;      // so far
    std::int8_t heading;
    bool superseded;  // another state is as good in every respect
  };
  struct OpenEntry {
    Key key;
    std::int32_t state;
  };
  // For a heap with the best on top.
  struct IsWorse {
    bool operator()(const OpenEntry& a, const OpenEntry& b) const {
      if (a.key.steps_and_conflicts != b.key.steps_and_conflicts)
        return a.key.steps_and_conflicts > b.key.steps_and_conflicts;
      if (a.key.turns_and_time_left != b.key.turns_and_time_left)
        return a.key.turns_and_time_left > b.key.turns_and_time_left;
      return a.state < b.state;
    }
  };
  // The states of one location, leg and time, by heading; -1 where there is none. Found by open addressing; a new
  // epoch empties all slots.
  struct Slot {
    std::uint64_t identity;
    std::uint32_t epoch;
    std::array<std::int32_t, GridGraph::direction_count + 1> states;
  };
  struct Task {
    const Agent& agent;
    const TourTable& table;
    const ConstraintTable& constraints;
    const ConflictTable& others;
    std::int32_t static_from;  // from here on time makes no difference
    std::int32_t rest_from;    // the path cannot end before
  };

  static bool is_end(const Task& task, const State& state);
  static bool is_as_good(const State& a, const State& b);
  void generate_successors(const Task& task, std::int32_t parent);
  void generate(const Task& task, const State& state);
  bool enter(const Task& task, const State& state);
  std::uint64_t identity_of(const Task& task, const State& state) const;
  Slot& find_slot(std::uint64_t identity);
  void grow_slots();
  void begin();
  void trace_back(std::int32_t last, std::vector<Location>& path) const;

  const GridGraph& graph_;
  std::vector<State> states_;
  std::vector<OpenEntry> open_;
  std::vector<Slot> slots_;
  std::size_t slots_used_ = 0;
  std::uint32_t epoch_ = 0;
  std::int64_t expanded_ = 0;
};

}  // namespace dmrp::planners
