// SPDX-License-Identifier: MIT
#include "safe_interval_search.hpp"

#include <algorithm>
#include <cmath>

namespace dmrp::planners {

namespace {

constexpr auto lower_order = [](const auto& a, const auto& b) { return a.order > b.order; };

// A part of a packed order: what does not fit ranks with the largest that does.
std::uint64_t part(std::int32_t value, int bits, int shift) {
  const std::int32_t most = (1 << bits) - 1;
  return static_cast<std::uint64_t>(std::clamp(value, 0, most)) << shift;
}

}  // namespace

SafeIntervalSearch::Result SafeIntervalSearch::search(const Request& request, StopSignal& stop, Found& found) {
  reset(request);
  const ConstraintTable& constraints = request.constraints;
  if (constraints.finish_from() == forever || constraints.finish_from() > constraints.finish_until())
    return Result::none;
  const Interval at_start = interval_at(request.agent.start, 0, 0);
  if (!at_start.is_allowed) return Result::none;
  Node start{};
  start.location = request.agent.start;
  start.first = at_start.first;
  start.end = at_start.end;
  start.f = std::max(estimate(0, start.location, 0, false), least_f_);
  start.parent = none;
  start.next = none;
  offer(start);
  while (advance_bound()) {
    if (stop.poll()) return Result::stopped;
    const Id best = pop_focal();
    if (best == none) continue;
    if (nodes_[best].is_end) {
      extract(best, found);
      return Result::found;
    }
    expand(best);
  }
  return Result::none;
}

void SafeIntervalSearch::reset(const Request& request) {
  request_ = &request;
  for (std::int32_t i = 0; i < level_count_; ++i) {
    levels_[static_cast<std::size_t>(i)].fresh = 0;
    levels_[static_cast<std::size_t>(i)].waiting.clear();
  }
  level_count_ = 0;
  least_f_ = std::max(request.lower_bound, estimate(0, request.agent.start, 0, false));
  bound_level_ = 0;
  focal_level_ = -1;
  nodes_.clear();
  focal_.clear();
  slots_used_ = 0;
  ++epoch_;
}

// Moves the bound to the least f of a fresh node, and the nodes within it to FOCAL. False if there is none. Nodes that
// are not fresh are there for their conflicts: they say nothing new about cost.
bool SafeIntervalSearch::advance_bound() {
  while (bound_level_ < level_count_ && levels_[static_cast<std::size_t>(bound_level_)].fresh == 0) ++bound_level_;
  if (bound_level_ >= level_count_) return false;
  const double bound = request_->suboptimality * (least_f_ + bound_level_) + request_->slack;
  const auto last =
      std::max(bound_level_, static_cast<std::int32_t>(std::min(std::floor(bound + 1e-9), 1e9)) - least_f_);
  while (focal_level_ < last) {
    ++focal_level_;
    if (focal_level_ >= level_count_) continue;
    Level& level = levels_[static_cast<std::size_t>(focal_level_)];
    for (const Id id : level.waiting)
      if (nodes_[id].is_open && nodes_[id].f - least_f_ == focal_level_) push_focal(id);
    level.waiting.clear();
  }
  return true;
}

// Adds the successors up to the focal bound that the node does not have yet.
void SafeIntervalSearch::expand(Id id) {
  ++expanded_;
  if (nodes_[id].expanded_to < 0 && can_end(nodes_[id])) offer_end(id);
  std::int32_t left_out = forever;  // least f of what is beyond the bound
  for (Direction d = 0; d < GridGraph::direction_count; ++d) move(id, d, left_out);
  wait(id, left_out);
  Node& node = nodes_[id];
  node.expanded_to = least_f_ + focal_level_;
  const bool was_fresh = node.fresh_level >= 0;
  set_fresh(id, -1);
  if (left_out == forever || left_out > request_->constraints.finish_until()) return;
  node.f = left_out;
  open(id, was_fresh);
}

void SafeIntervalSearch::move(Id id, Direction d, std::int32_t& left_out) {
  const Node from = nodes_[id];
  const Location to = graph_.neighbor(from.location, d);
  if (to == nowhere) return;
  const std::int32_t leg = request_->agent.leg_after(from.leg, from.location);
  if (request_->table.distance(leg, to) >= TourTable::unreachable) return;
  const std::int32_t focal_f = least_f_ + focal_level_;
  const std::int32_t latest = from.end;  // the agent leaves before the interval ends
  for (std::int32_t t = from.t + 1; t <= latest;) {
    if (const std::int32_t f = estimate(leg, to, t, false); f > focal_f) {
      left_out = std::min(left_out, std::max(f, least_f_));
      // Later is dearer, but for the time when the path may end.
      if (t >= request_->constraints.finish_from() || request_->table.distance(leg, to) > 0) return;
      t = request_->constraints.finish_from();
      continue;
    }
    const Interval interval = interval_at(to, leg, t);
    if (interval.is_allowed) {
      const auto skip_forbidden = [&] {
        while (t <= latest && t < interval.end && !request_->constraints.allows_move(from.location, to, t)) ++t;
        return t <= latest && t < interval.end;
      };
      if (skip_forbidden()) {
        // Only someone who is there just before can swap.
        const std::int32_t swaps =
            t == interval.first ? request_->others.count_at(from.location, to, t) - interval.conflicts : 0;
        successor(id, to, d, leg, interval, t, interval.conflicts + swaps, left_out);
        if (swaps > 0 && ++t <= latest && skip_forbidden())
          successor(id, to, d, leg, interval, t, interval.conflicts, left_out);
      }
    }
    if (interval.end == forever) return;
    t = interval.end;
  }
}

// On in the same place: in the next interval, or, where a tour has the same goal twice, in the same.
void SafeIntervalSearch::wait(Id id, std::int32_t& left_out) {
  const Node from = nodes_[id];
  const Agent& agent = request_->agent;
  const std::int32_t leg = agent.leg_after(from.leg, from.location);
  if (request_->table.distance(leg, from.location) >= TourTable::unreachable) return;
  if (leg != from.leg && from.location == agent.goal(leg) && from.t + 1 < from.end) {
    const Interval here = interval_at(from.location, leg, from.t + 1);
    successor(id, from.location, GridGraph::no_direction, leg, here, from.t + 1, 0, left_out);
  }
  if (from.end == forever) return;
  const Interval next = interval_at(from.location, leg, from.end);
  if (next.is_allowed)
    successor(id, from.location, GridGraph::no_direction, leg, next, from.end, next.conflicts, left_out);
}

void SafeIntervalSearch::successor(Id id, Location to, Direction d, std::int32_t leg, const Interval& interval,
                                   std::int32_t t, std::int32_t conflicts, std::int32_t& left_out) {
  const Node& from = nodes_[id];
  const bool is_move = d != GridGraph::no_direction;
  const bool waited_at_end =
      !is_move && to == request_->agent.last_goal() && leg == from.leg && leg == request_->agent.last_leg();
  const std::int32_t f = std::max(estimate(leg, to, t, waited_at_end), least_f_);
  if (f > least_f_ + focal_level_) {
    left_out = std::min(left_out, f);
    return;
  }
  if (f <= from.expanded_to || f > request_->constraints.finish_until()) return;
  Node node{};
  node.location = to;
  node.leg = leg;
  node.first = interval.first;
  node.end = interval.end;
  node.t = t;
  node.f = f;
  node.conflicts = from.conflicts + conflicts;
  node.turns = from.turns + (is_move && from.heading != GridGraph::no_direction && from.heading != d ? 1 : 0);
  node.parent = id;
  node.next = none;
  node.heading = is_move ? static_cast<std::uint8_t>(d) : from.heading;
  node.waited_at_end = waited_at_end;
  offer(node);
}

// Keeps a node unless one of the same interval came as early with as few conflicts.
void SafeIntervalSearch::offer(const Node& node) {
  Id* link = &slot_of(node);
  bool is_fresh = true;
  std::int32_t fresh_level = -1;
  while (*link != none) {
    Node& other = nodes_[*link];
    if (other.t <= node.t && other.conflicts <= node.conflicts) {
      const bool is_straighter = other.t == node.t && other.conflicts == node.conflicts && other.turns > node.turns;
      if (!is_straighter || !other.is_open || other.expanded_to >= 0) return;
    }
    if (node.t <= other.t && node.conflicts <= other.conflicts) {
      // The other one gives way; what it still had to say about cost, the new one has to say now.
      if (other.t == node.t) {
        is_fresh = is_fresh && other.fresh_level >= 0;
        fresh_level = other.fresh_level;
      }
      set_fresh(*link, -1);
      other.is_open = false;
      *link = other.next;
    } else {
      is_fresh = is_fresh && other.t > node.t;
      link = &other.next;
    }
  }
  const auto id = static_cast<Id>(nodes_.size());
  nodes_.push_back(node);
  Id& first = slot_of(node);
  if (first == none) ++slots_used_;
  nodes_.back().next = first;
  first = id;
  open(id, is_fresh && fresh_level < 0);
  if (is_fresh && fresh_level >= 0) set_fresh(id, fresh_level);
  if (slots_used_ * 2 > slots_.size()) grow_slots();
}

// The agent may stay where the node is: a node of its own, since others that pass there later count.
void SafeIntervalSearch::offer_end(Id id) {
  Node end = nodes_[id];
  end.parent = id;
  end.next = none;
  end.f = std::max(end.t, least_f_);
  end.conflicts += request_->others.count_after(end.location, end.t);
  end.fresh_level = -1;
  end.is_end = true;
  const bool is_fresh = nodes_[id].fresh_level >= 0;
  nodes_.push_back(end);
  open(static_cast<Id>(nodes_.size() - 1), is_fresh);
}

SafeIntervalSearch::Interval SafeIntervalSearch::interval_at(Location location, std::int32_t leg,
                                                             std::int32_t t) const {
  const ConflictTable& others = request_->others;
  const ConstraintTable& constraints = request_->constraints;
  Interval interval{0, forever, true, 0};
  interval.is_allowed = constraints.narrow(location, t, interval.first, interval.end);
  if (!interval.is_allowed) return interval;
  const std::int32_t rest = others.resting_from(location);
  if (others.is_passed(location, t)) return {t, t + 1, true, others.count_at(location, location, t)};
  interval.first = std::max(interval.first, others.previous_passed(location, t) + 1);
  interval.end = std::min(interval.end, others.next_passed(location, t));
  if (rest < t) {
    interval.first = std::max(interval.first, rest + 1);
    interval.conflicts = 1;
  } else if (rest != forever) {
    interval.end = std::min(interval.end, rest + 1);
  }
  // Where the path may end, those times are not like the ones before.
  if (location == request_->agent.last_goal() && leg == request_->agent.last_leg()) {
    const std::int32_t finish_from = constraints.finish_from();
    if (t < finish_from)
      interval.end = std::min(interval.end, finish_from);
    else
      interval.first = std::max(interval.first, finish_from);
  }
  return interval;
}

bool SafeIntervalSearch::can_end(const Node& node) const {
  return node.location == request_->agent.last_goal() && node.leg == request_->agent.last_leg() &&
         node.t >= request_->constraints.finish_from() && node.t <= request_->constraints.finish_until() &&
         !node.waited_at_end;
}

// The least cost of a path by way of a place at a time.
std::int32_t SafeIntervalSearch::estimate(std::int32_t leg, Location location, std::int32_t t,
                                          bool waited_at_end) const {
  std::int32_t rest = request_->table.distance(leg, location);
  const std::int32_t finish_from = request_->constraints.finish_from();
  if (rest == 0 && (waited_at_end || t < finish_from)) rest = 2;  // away and back
  std::int32_t f = std::max(t + rest, finish_from);
  if (request_->agent.last_leg() == 0)
    for (const ConstraintTable::Landmark& landmark : request_->constraints.landmarks())
      if (landmark.t >= t) f = std::max(f, landmark.t + request_->table.distance(0, landmark.location));
  return f;
}

// Fewest conflicts first, then least f, then nearest to the end, then fewest turns.
std::uint64_t SafeIntervalSearch::order_of(const Node& node) const {
  const std::int32_t rest = node.is_end ? 0 : node.f - node.t + 1;
  static const int K = getenv("LLK") ? atoi(getenv("LLK")) : 0;
  if (K > 0)
    return part(node.conflicts * K + node.f - least_f_, 16, 48) | part(node.conflicts, 16, 32) | part(rest, 18, 14) |
           part(node.turns, 14, 0);
  return part(node.conflicts, 16, 48) | part(node.f - least_f_, 16, 32) | part(rest, 18, 14) | part(node.turns, 14, 0);
}

SafeIntervalSearch::Level& SafeIntervalSearch::level_of(std::int32_t f) {
  const std::int32_t level = f - least_f_;
  if (static_cast<std::size_t>(level) >= levels_.size()) levels_.resize(static_cast<std::size_t>(level) + 1);
  level_count_ = std::max(level_count_, level + 1);
  return levels_[static_cast<std::size_t>(level)];
}

void SafeIntervalSearch::open(Id id, bool is_fresh) {
  Node& node = nodes_[id];
  node.is_open = true;
  Level& level = level_of(node.f);
  if (is_fresh) set_fresh(id, node.f - least_f_);
  if (node.f - least_f_ <= focal_level_)
    push_focal(id);
  else
    level.waiting.push_back(id);
}

void SafeIntervalSearch::set_fresh(Id id, std::int32_t level) {
  Node& node = nodes_[id];
  if (node.fresh_level >= 0) --levels_[static_cast<std::size_t>(node.fresh_level)].fresh;
  if (level >= 0) ++levels_[static_cast<std::size_t>(level)].fresh;
  node.fresh_level = level;
}

void SafeIntervalSearch::push_focal(Id id) {
  focal_.push_back({order_of(nodes_[id]), id});
  std::push_heap(focal_.begin(), focal_.end(), lower_order);
}

// Takes the first of FOCAL that is still open.
SafeIntervalSearch::Id SafeIntervalSearch::pop_focal() {
  while (!focal_.empty()) {
    const Id id = focal_.front().node;
    std::pop_heap(focal_.begin(), focal_.end(), lower_order);
    focal_.pop_back();
    if (!nodes_[id].is_open) continue;
    nodes_[id].is_open = false;
    return id;
  }
  return none;
}

SafeIntervalSearch::Id& SafeIntervalSearch::slot_of(const Node& node) {
  const auto is_same = [&](const Node& other) {
    return other.location == node.location && other.first == node.first && other.leg == node.leg &&
           other.waited_at_end == node.waited_at_end;
  };
  const std::uint64_t key = (static_cast<std::uint64_t>(node.location) << 32 | static_cast<std::uint32_t>(node.first)) +
                            (static_cast<std::uint64_t>(node.leg) << 1 | (node.waited_at_end ? 1u : 0u)) * 0x9E37u;
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t i = (key * 0x9E3779B97F4A7C15u) >> 24 & mask;; i = (i + 1) & mask) {
    Slot& slot = slots_[i];
    if (slot.epoch != epoch_) {
      slot = {epoch_, none};
      return slot.node;
    }
    if (slot.node == none || is_same(nodes_[slot.node])) return slot.node;
  }
}

void SafeIntervalSearch::grow_slots() {
  std::vector<Slot> old(slots_.size() * 2);
  old.swap(slots_);
  for (const Slot& slot : old)
    if (slot.epoch == epoch_ && slot.node != none) slot_of(nodes_[slot.node]) = slot.node;
}

void SafeIntervalSearch::extract(Id id, Found& found) const {
  found.lower_bound = least_f_ + bound_level_;
  found.conflicts = nodes_[id].conflicts;
  found.path.resize(static_cast<std::size_t>(nodes_[id].t) + 1);
  std::int32_t later = nodes_[id].t + 1;
  for (Id n = id; n != none; n = nodes_[n].parent) {
    for (std::int32_t t = nodes_[n].t; t < later; ++t) found.path[static_cast<std::size_t>(t)] = nodes_[n].location;
    later = std::min(later, nodes_[n].t);
  }
}

}  // namespace dmrp::planners
