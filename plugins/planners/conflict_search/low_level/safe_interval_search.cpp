// SPDX-License-Identifier: MIT
#include "planners/conflict_search/low_level/safe_interval_search.hpp"

namespace dmrp::planners {

SafeIntervalSearch::SafeIntervalSearch(const GridGraph& graph)
    : graph_(graph), slots_(static_cast<std::size_t>(graph.location_count())) {}

LowLevelResult SafeIntervalSearch::search(const LowLevelRequest& request, StopSignal& stop, LowLevelPath& found) {
  reset(request);
  const ConstraintTable& constraints = request.constraints;
  if (constraints.finish_from() == forever || constraints.finish_from() > constraints.finish_until())
    return LowLevelResult::none;
  const Interval at_start = interval_at(request.agent.start, 0, 0);
  if (!at_start.is_allowed) return LowLevelResult::none;
  Node start{};
  start.location = request.agent.start;
  start.first = at_start.first;
  start.end = at_start.end;
  start.f = focal_.least_f();
  start.parent = none;
  offer(start);
  while (focal_.advance()) {
    if (stop.poll()) return LowLevelResult::stopped;
    const Id best = focal_.pop([this](Id id) { return nodes_[id].is_open; });
    if (best == none) continue;
    nodes_[best].is_open = false;
    if (nodes_[best].is_end) {
      extract(best, found);
      return LowLevelResult::found;
    }
    expand(best);
  }
  return LowLevelResult::none;
}

void SafeIntervalSearch::reset(const LowLevelRequest& request) {
  request_ = &request;
  const std::int32_t least_f =
      std::max(request.lower_bound, least_cost_by_way_of(request, 0, request.agent.start, 0, false));
  focal_.reset(least_f, request.suboptimality);
  nodes_.clear();
  ++epoch_;
}

// Adds the successors up to the focal bound that earlier expansions did not.
void SafeIntervalSearch::expand(Id id) {
  ++expanded_;
  Expansion expansion{id, nodes_[id], request_->agent.leg_after(nodes_[id].leg, nodes_[id].location)};
  const Node& from = expansion.from;
  if (from.expanded_to < 0 && !from.waited_at_end && may_end(*request_, from.leg, from.location, from.t)) offer_end(id);
  for (Direction d = 0; d < GridGraph::direction_count; ++d) move(expansion, d);
  wait(expansion);
  const bool was_fresh = from.fresh_f >= 0;
  set_fresh(id, -1);
  nodes_[id].expanded_to = focal_.focal_bound();
  if (expansion.missing_f == forever || expansion.missing_f > request_->constraints.finish_until()) return;
  nodes_[id].f = expansion.missing_f;
  if (was_fresh) set_fresh(id, expansion.missing_f);
  open(id);
}

void SafeIntervalSearch::move(Expansion& expansion, Direction d) {
  const Node& from = expansion.from;
  const Location to = graph_.neighbor(from.location, d);
  if (to == nowhere || request_->table.distance(expansion.leg, to) >= TourTable::unreachable) return;
  const std::int32_t latest = from.end;  // the agent leaves before the interval ends
  for (std::int32_t t = from.t + 1; t <= latest;) {
    if (const std::int32_t f = estimate(expansion.leg, to, t, false); f > focal_.focal_bound()) {
      expansion.missing_f = std::min(expansion.missing_f, f);
      // Later arrivals cost more, except for the first time at which the path may end.
      if (t >= request_->constraints.finish_from() || request_->table.distance(expansion.leg, to) > 0) return;
      t = request_->constraints.finish_from();
      continue;
    }
    const Interval interval = interval_at(to, expansion.leg, t);
    const auto skip_forbidden = [&] {
      while (t <= latest && t < interval.end && !request_->constraints.allows_move(from.location, to, t)) ++t;
      return t <= latest && t < interval.end;
    };
    if (interval.is_allowed && skip_forbidden()) {
      // Only an agent that is at `to` one step before can swap.
      const std::int32_t swaps =
          t == interval.first ? request_->others.count_at(from.location, to, t) - interval.conflicts : 0;
      add_successor(expansion, to, d, interval, t, interval.conflicts + swaps);
      if (swaps > 0 && ++t <= latest && skip_forbidden())
        add_successor(expansion, to, d, interval, t, interval.conflicts);
    }
    if (interval.end == forever) return;
    t = interval.end;
  }
}

// Stays at the location: until the next interval or, where the tour has the same goal twice, within this one.
void SafeIntervalSearch::wait(Expansion& expansion) {
  const Node& from = expansion.from;
  const Agent& agent = request_->agent;
  const std::int32_t leg = expansion.leg;
  if (request_->table.distance(leg, from.location) >= TourTable::unreachable) return;
  if (leg != from.leg && from.location == agent.goal(leg) && from.t + 1 < from.end)
    add_successor(expansion, from.location, GridGraph::no_direction, interval_at(from.location, leg, from.t + 1),
                  from.t + 1, 0);
  if (from.end == forever) return;
  const Interval next = interval_at(from.location, leg, from.end);
  if (next.is_allowed) add_successor(expansion, from.location, GridGraph::no_direction, next, from.end, next.conflicts);
}

void SafeIntervalSearch::add_successor(Expansion& expansion, Location to, Direction d, const Interval& interval,
                                       std::int32_t t, std::int32_t conflicts) {
  const Node& from = expansion.from;
  const bool is_move = d != GridGraph::no_direction;
  const bool waited_at_end = !is_move && to == request_->agent.last_goal() && expansion.leg == from.leg &&
                             expansion.leg == request_->agent.last_leg();
  const std::int32_t f = estimate(expansion.leg, to, t, waited_at_end);
  if (f > focal_.focal_bound()) {
    expansion.missing_f = std::min(expansion.missing_f, f);
    return;
  }
  if (f <= from.expanded_to || f > request_->constraints.finish_until()) return;
  Node node{};
  node.location = to;
  node.leg = expansion.leg;
  node.first = interval.first;
  node.end = interval.end;
  node.t = t;
  node.f = f;
  node.conflicts = from.conflicts + conflicts;
  node.turns = from.turns + (is_move && from.heading != GridGraph::no_direction && from.heading != d ? 1 : 0);
  node.parent = expansion.id;
  node.heading = is_move ? static_cast<std::uint8_t>(d) : from.heading;
  node.waited_at_end = waited_at_end;
  offer(node);
}

// Adds a node unless one of the same interval is as early with as few conflicts.
void SafeIntervalSearch::offer(const Node& node) {
  Id& first = first_at(node.location);
  bool is_earliest = true;
  std::int32_t fresh_f = -1;  // inherited from an equally early node that the new one replaces
  for (Id* link = &first; *link != none;) {
    Node& other = nodes_[*link];
    if (other.first != node.first || other.leg != node.leg || other.waited_at_end != node.waited_at_end) {
      link = &other.next;
      continue;
    }
    if (other.t <= node.t && other.conflicts <= node.conflicts) {
      const bool is_straighter = other.t == node.t && other.conflicts == node.conflicts && other.turns > node.turns;
      if (!is_straighter || !other.is_open || other.expanded_to >= 0) return;
    }
    if (node.t > other.t || node.conflicts > other.conflicts) {
      is_earliest = is_earliest && other.t > node.t;
      link = &other.next;
      continue;
    }
    if (other.t == node.t) {
      is_earliest = is_earliest && other.fresh_f >= 0;
      fresh_f = other.fresh_f;
    }
    set_fresh(*link, -1);
    other.is_open = false;
    *link = other.next;
  }
  const auto id = static_cast<Id>(nodes_.size());
  nodes_.push_back(node);
  nodes_.back().next = first;
  first = id;
  if (is_earliest) set_fresh(id, fresh_f >= 0 ? fresh_f : node.f);
  open(id);
}

// Adds the node in which the agent comes to rest here. Its conflicts include those with agents that pass later.
void SafeIntervalSearch::offer_end(Id id) {
  Node end = nodes_[id];
  end.parent = id;
  end.f = std::max(end.t, focal_.least_f());
  end.conflicts += request_->others.count_after(end.location, end.t);
  end.is_end = true;
  end.fresh_f = -1;
  const bool is_fresh = nodes_[id].fresh_f >= 0;
  const auto end_id = static_cast<Id>(nodes_.size());
  nodes_.push_back(end);
  if (is_fresh) set_fresh(end_id, end.f);
  open(end_id);
}

SafeIntervalSearch::Interval SafeIntervalSearch::interval_at(Location location, std::int32_t leg,
                                                             std::int32_t t) const {
  const ConflictTable& others = request_->others;
  const ConstraintTable& constraints = request_->constraints;
  Interval interval{0, forever, true, 0};
  interval.is_allowed = constraints.narrow(location, t, interval.first, interval.end);
  if (!interval.is_allowed) return interval;
  if (others.is_passed(location, t)) return {t, t + 1, true, others.count_at(location, location, t)};
  interval.first = std::max(interval.first, others.previous_passed(location, t) + 1);
  interval.end = std::min(interval.end, others.next_passed(location, t));
  const std::int32_t rest = others.resting_from(location);
  if (rest < t) {
    interval.first = std::max(interval.first, rest + 1);
    interval.conflicts = 1;
  } else if (rest != forever) {
    interval.end = std::min(interval.end, rest + 1);
  }
  const Agent& agent = request_->agent;
  const std::int32_t finish_from = constraints.finish_from();
  // Where all remaining goals are this location, an agent that arrives before it may come to rest has to leave again:
  // a path must not end with a wait.
  const auto is_here = [&](Location goal) { return goal == location; };
  if (leg < agent.last_leg() && std::all_of(agent.goals.begin() + leg, agent.goals.end(), is_here)) {
    if (t < finish_from) return {t, t + 1, true, interval.conflicts};
    interval.first = std::max(interval.first, finish_from);
  }
  // Times at which the path may end differ from those before.
  if (location == agent.last_goal() && leg == agent.last_leg()) {
    if (t < finish_from)
      interval.end = std::min(interval.end, finish_from);
    else
      interval.first = std::max(interval.first, finish_from);
  }
  return interval;
}

std::int32_t SafeIntervalSearch::estimate(std::int32_t leg, Location location, std::int32_t t,
                                          bool waited_at_end) const {
  return std::max(least_cost_by_way_of(*request_, leg, location, t, waited_at_end), focal_.least_f());
}

void SafeIntervalSearch::open(Id id) {
  Node& node = nodes_[id];
  node.is_open = true;
  const std::int32_t rest = node.is_end ? 0 : node.f - node.t + 1;
  focal_.push(id, node.f,
              focal_order(node.conflicts, request_->conflict_steps, node.f - focal_.least_f(), rest, node.turns));
}

void SafeIntervalSearch::set_fresh(Id id, std::int32_t f) {
  Node& node = nodes_[id];
  if (node.fresh_f >= 0) focal_.add_fresh(node.fresh_f, -1);
  if (f >= 0) focal_.add_fresh(f, 1);
  node.fresh_f = f;
}

SafeIntervalSearch::Id& SafeIntervalSearch::first_at(Location location) {
  Slot& slot = slots_[static_cast<std::size_t>(location)];
  if (slot.epoch != epoch_) slot = {epoch_, none};
  return slot.first;
}

void SafeIntervalSearch::extract(Id id, LowLevelPath& found) const {
  found.lower_bound = focal_.bound();
  found.conflicts = nodes_[id].conflicts;
  found.locations.resize(static_cast<std::size_t>(nodes_[id].t) + 1);
  std::int32_t later = nodes_[id].t + 1;
  for (Id n = id; n != none; n = nodes_[n].parent) {
    for (std::int32_t t = nodes_[n].t; t < later; ++t)
      found.locations[static_cast<std::size_t>(t)] = nodes_[n].location;
    later = std::min(later, nodes_[n].t);
  }
}

}  // namespace dmrp::planners
