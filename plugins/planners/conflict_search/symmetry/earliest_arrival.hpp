// SPDX-License-Identifier: MIT
// earliest_arrival.hpp: the earliest time at which an agent can be at a location, under its constraints.
//
// A* over locations and safe intervals, the time spans during which the agent may stay there (Phillips, Likhachev
// 2011). A location without constraints is visited once, whatever the time.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planners/conflict_search/low_level/constraint.hpp"
#include "planners/mapf/stop_signal.hpp"
#include "planners/mapf/tour_table.hpp"

namespace dmrp::planners {

class EarliestArrival {
 public:
  struct Query {
    const Agent& agent;
    const TourTable& table;
    const ConstraintTable& constraints;
    Location to;
    Location not_from = nowhere;  // the search ignores the move from here to `to`
    std::int32_t latest = 0;
  };

  explicit EarliestArrival(const GridGraph& graph, StopSignal* stop = nullptr);

  // A lower bound of the time at which the agent can be there: ignores constraints that apply after the arrival.
  // query.latest + 1 if it is later than query.latest. Nothing if the search takes too long or `stop` was raised. The
  // graph must be symmetric.
  std::optional<std::int32_t> search(const Query& query);

 private:
  struct Open {
    std::int32_t estimate;  // of the arrival
    std::int32_t t;
    Location location;
  };
  struct Visit {
    Location location;
    std::int32_t safe_from;  // the start of the interval
  };
  enum class Outcome { arrived, too_late, gave_up };

  Outcome search_stage(const Query& query, Location from, std::int32_t t, std::int32_t latest);
  void expand(const Query& query, Location from, std::int32_t t, std::int32_t latest);
  void push(const Query& query, Location location, std::int32_t t, std::int32_t latest);
  bool visit(const ConstraintTable& constraints, Location location, std::int32_t t);
  std::int32_t lower_bound(const Query& query, Location from) const;

  const GridGraph* graph_;
  StopSignal* stop_;
  std::vector<Open> open_;
  std::vector<std::uint32_t> visited_in_;  // by location without constraints: the stage
  std::vector<Visit> visits_;              // of locations with constraints
  std::uint32_t stage_ = 0;
  std::int32_t arrival_ = 0;
};

}  // namespace dmrp::planners
