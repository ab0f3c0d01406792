// SPDX-License-Identifier: MIT
// focal_search.hpp: the low level: a path of one robot under constraints, of bounded cost and with few conflicts.
//
// Focal search over states (location, leg of the tour, time). OPEN holds all states that are not expanded; its least f
// is a lower bound of the cost. FOCAL holds the states of OPEN whose f is within the bound. Expands the state of FOCAL
// with the least sum of f and a penalty for each conflict; of equals the one with fewest turns, then the latest. Keeps
// the states of one place and time that are not dominated in cost and conflicts. Times from which on nothing changes
// are not distinguished.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planners/ecbs8/constraint.hpp"
#include "planners/ecbs8/occupancy.hpp"
#include "planners/ecbs8/tour_distances.hpp"
#include "planners/mapf/stop_signal.hpp"

namespace dmrp::planners::ecbs8 {

struct BoundedPath {
  std::vector<Location> locations;
  Cost cost = 0;
  Cost lower_bound = 0;  // of all paths under the constraints
};

class FocalSearch {
 public:
  enum class Result { found, none, stopped };

  explicit FocalSearch(const Graph& graph) : graph_(graph) {}

  // Finds a path that costs at most `suboptimality` times the lower bound. The agent itself must not be among the
  // others. `lower_bound` is a known lower bound.
  Result search(const Agent& agent, const TourDistances& distances, const ConstraintTable& constraints,
                const Occupancy& others, Cost lower_bound, Suboptimality suboptimality, StopSignal& stop,
                BoundedPath& out);

  std::int64_t expanded() const { return expanded_; }

 private:
  // A state is useless if another one of the same place and time dominates it.
  enum class Status : std::uint8_t { open, expanded, useless };
  struct State {
    Cost g;
    Location location;
    std::int32_t parent;
    std::int32_t t;
    std::int32_t conflicts;   // so far
    std::int32_t turns;       // so far
    std::int32_t same_place;  // the next state of the same place and time, or -1
    std::int16_t leg;
    std::int8_t heading;
    bool rests;  // at the last goal for good
    Status status;
  };
  struct FocalEntry {
    Cost f_with_conflicts;
    std::uint64_t
        tie;  // from the highest bits: estimated turns of the whole path, remaining time, state (newest first)

    std::int32_t state() const { return static_cast<std::int32_t>(UINT32_MAX - static_cast<std::uint32_t>(tie)); }
  };
  struct OpenEntry {
    Cost f;
    std::int32_t state;
  };
  struct WaitingEntry {
    Cost f;
    FocalEntry focal;
  };
  // For heaps with the best on top.
  struct IsWorse {
    bool operator()(const FocalEntry& a, const FocalEntry& b) const {
      if (a.f_with_conflicts != b.f_with_conflicts) return a.f_with_conflicts > b.f_with_conflicts;
      return a.tie > b.tie;
    }
    bool operator()(const OpenEntry& a, const OpenEntry& b) const { return a.f > b.f; }
    bool operator()(const WaitingEntry& a, const WaitingEntry& b) const { return a.f > b.f; }
  };
  // The states of one place and time, in a hash table with open addressing. A new epoch empties all slots.
  struct Slot {
    std::uint64_t identity;
    std::uint32_t epoch;
    std::int32_t first;
  };
  struct Task {
    const Agent& agent;
    const TourDistances& distances;
    const ConstraintTable& constraints;
    const Occupancy& others;
    Suboptimality suboptimality;
    std::int32_t static_from;  // from here on times are not distinguished
    std::int32_t rest_from;    // the path cannot end before
  };

  // A place that is closed from some time on.
  struct Closing {
    Cost farthest;  // the greatest distance to go from there or beside it
    std::int32_t from;
  };

  void begin(const Task& task);
  void begin_detours(const Task& task, StopSignal& stop);
  Cost distance_to_go(const Task& task, const State& state) const;
  void expand(const Task& task, std::int32_t parent);
  void generate(const Task& task, const State& state, bool is_arrival);
  void push(const Task& task, const State& state);
  Cost f_with_conflicts(const State& state, Cost f) const;
  static bool is_as_good(const Task& task, const State& known, const State& state, std::int32_t turns_in_all);
  bool enter(const Task& task, const State& state, std::int32_t turns_in_all);
  void raise_bound(const Task& task, Cost lower_bound);
  std::int32_t pop_focal();
  std::int32_t conflicts_after(std::int32_t t) const;
  bool is_beaten(const Task& task, std::int32_t leg, Location location, std::int32_t t, Cost g, std::int32_t conflicts);
  std::uint64_t identity_of(const Task& task, std::int32_t leg, Location location, std::int32_t t) const;
  static std::uint64_t tie_of(std::int32_t turns, std::int32_t t, std::int32_t state);
  Slot& find_slot(std::uint64_t identity);
  void grow_slots();
  void trace_back(std::int32_t last, BoundedPath& out) const;

  const Graph& graph_;
  std::optional<Graph> graph_without_closed_;
  std::optional<TourDistances> detours_;  // distances without the places that close
  std::vector<Closing> closings_;
  std::vector<State> states_;
  std::vector<OpenEntry> open_;
  std::vector<FocalEntry> focal_;
  std::vector<WaitingEntry> waiting_;            // in OPEN, beyond the bound
  std::vector<std::int32_t> conflicts_at_rest_;  // by time: conflicts of resting at the last goal from then on
  std::int32_t quiet_from_ = 0;                  // the first of these times without conflicts
  std::vector<Slot> slots_;
  std::size_t slots_used_ = 0;
  std::uint32_t epoch_ = 0;
  Cost lower_bound_ = 0;
  Cost bound_ = 0;
  std::int64_t expanded_ = 0;
};

}  // namespace dmrp::planners::ecbs8
