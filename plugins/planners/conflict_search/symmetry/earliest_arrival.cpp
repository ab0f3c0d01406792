// SPDX-License-Identifier: MIT
#include "planners/conflict_search/symmetry/earliest_arrival.hpp"

#include <algorithm>
#include <cassert>
#include <cstdlib>

namespace dmrp::planners {

namespace {

constexpr std::int32_t max_visits = 20'000;  // of one search

}  // namespace

EarliestArrival::EarliestArrival(const GridGraph& graph, StopSignal* stop)
    : graph_(&graph), stop_(stop), visited_in_(static_cast<std::size_t>(graph.location_count()), 0) {
  assert(graph.is_symmetric());
}

// One stage for each landmark: the agent is at the landmark at its time, unless it has reached query.to before.
std::optional<std::int32_t> EarliestArrival::search(const Query& query) {
  Location from = query.agent.start;
  std::int32_t t = 0;
  for (const ConstraintTable::Landmark& landmark : query.constraints.landmarks()) {
    if (landmark.t > query.latest) break;
    const Outcome outcome = search_stage(query, from, t, landmark.t - 1);
    if (outcome == Outcome::arrived) return arrival_;
    if (outcome == Outcome::gave_up) return std::nullopt;
    from = landmark.location;
    t = landmark.t;
  }
  switch (search_stage(query, from, t, query.latest)) {
    case Outcome::arrived:
      return arrival_;
    case Outcome::too_late:
      return query.latest + 1;
    case Outcome::gave_up:
      break;
  }
  return std::nullopt;
}

EarliestArrival::Outcome EarliestArrival::search_stage(const Query& query, Location from, std::int32_t t,
                                                       std::int32_t latest) {
  const auto is_worse = [](const Open& a, const Open& b) {
    if (a.estimate != b.estimate) return a.estimate > b.estimate;
    return a.t != b.t ? a.t < b.t : a.location > b.location;
  };
  ++stage_;
  open_.clear();
  visits_.clear();
  push(query, from, t, latest);
  for (std::int32_t count = 0; !open_.empty(); ++count) {
    if (count == max_visits || (stop_ && stop_->poll())) return Outcome::gave_up;
    std::pop_heap(open_.begin(), open_.end(), is_worse);
    const Open best = open_.back();
    open_.pop_back();
    if (best.location == query.to) {
      arrival_ = best.t;
      return Outcome::arrived;
    }
    if (!visit(query.constraints, best.location, best.t)) continue;
    const std::size_t known = open_.size();
    expand(query, best.location, best.t, latest);
    for (std::size_t i = known; i < open_.size(); ++i)
      std::push_heap(open_.begin(), open_.begin() + static_cast<std::ptrdiff_t>(i + 1), is_worse);
  }
  return Outcome::too_late;
}

// Adds the arrivals at the neighbors, after any wait: the earliest time of each safe interval there.
void EarliestArrival::expand(const Query& query, Location from, std::int32_t t, std::int32_t latest) {
  const ConstraintTable& constraints = query.constraints;
  for (Direction d = 0; d < GridGraph::direction_count; ++d) {
    const Location to = graph_->neighbor(from, d);
    if (to == nowhere || (to == query.to && from == query.not_from)) continue;
    if (!constraints.constrains(to)) {
      push(query, to, t + 1, latest);
      continue;
    }
    const std::int32_t end = std::min(latest, std::max(t + 1, constraints.constant_from()));
    bool has_interval = false;
    for (std::int32_t arrival = t + 1; arrival <= end; ++arrival) {
      if (arrival > t + 1 && !constraints.allows(from, from, arrival - 1)) break;
      if (!constraints.allows(to, to, arrival)) {
        has_interval = false;
      } else if (!has_interval && constraints.allows(from, to, arrival)) {
        push(query, to, arrival, latest);
        has_interval = true;
      }
    }
  }
}

// Appends to the heap's array without restoring the heap.
void EarliestArrival::push(const Query& query, Location location, std::int32_t t, std::int32_t latest) {
  const std::int32_t estimate = t + lower_bound(query, location);
  if (estimate <= latest) open_.push_back({estimate, t, location});
}

// False if an earlier visit could have waited until then.
bool EarliestArrival::visit(const ConstraintTable& constraints, Location location, std::int32_t t) {
  if (!constraints.constrains(location)) {
    std::uint32_t& visited = visited_in_[static_cast<std::size_t>(location)];
    if (visited == stage_) return false;
    visited = stage_;
    return true;
  }
  std::int32_t safe_from = t;
  while (safe_from > 0 && constraints.allows(location, location, safe_from)) --safe_from;
  for (const Visit& known : visits_)
    if (known.location == location && known.safe_from == safe_from) return false;
  visits_.push_back({location, safe_from});
  return true;
}

// The graph is symmetric, so the distances from two places to the last goal differ by at most the distance between
// them.
std::int32_t EarliestArrival::lower_bound(const Query& query, Location from) const {
  const std::int32_t leg = query.agent.last_leg();
  return std::abs(query.table.distance(leg, from) - query.table.distance(leg, query.to));
}

}  // namespace dmrp::planners
