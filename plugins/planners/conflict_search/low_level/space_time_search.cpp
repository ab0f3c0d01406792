// SPDX-License-Identifier: MIT
#include "planners/conflict_search/low_level/space_time_search.hpp"

#include <cstdlib>
#include <tuple>

namespace dmrp::planners {

LowLevelResult SpaceTimeSearch::search(const LowLevelRequest& request, StopSignal& stop, LowLevelPath& found) {
  reset(request);
  const Location start = request.agent.start;
  const ConstraintTable& constraints = request.constraints;
  if (constraints.finish_from() == forever || constraints.finish_from() > constraints.finish_until() ||
      !constraints.allows(start, start, 0) || !can_keep_landmarks(start, 0))
    return LowLevelResult::none;
  Node node{};
  node.parent = none;
  node.location = start;
  offer(node);
  while (focal_.advance()) {
    if (stop.poll()) return LowLevelResult::stopped;
    const Id best = focal_.pop([this](Id id) { return nodes_[id].is_open; });
    if (best == none) continue;
    if (nodes_[best].is_end) {
      extract(best, found);
      return LowLevelResult::found;
    }
    expand(best);
  }
  return LowLevelResult::none;
}

void SpaceTimeSearch::reset(const LowLevelRequest& request) {
  request_ = &request;
  const ConstraintTable& constraints = request.constraints;
  horizon_ = std::max(constraints.constant_from(), request.others.rest_from() + 1);
  if (constraints.finish_from() != forever) horizon_ = std::max(horizon_, constraints.finish_from());
  const std::int32_t least_f =
      std::max(request.lower_bound, least_cost_by_way_of(request, 0, request.agent.start, 0, false));
  focal_.reset(least_f, request.suboptimality);
  nodes_.clear();
  if (slots_.empty()) slots_.resize(1024);
  ++epoch_;
}

void SpaceTimeSearch::expand(Id id) {
  ++expanded_;
  const Node from = nodes_[id];
  if (!from.waited_at_end && may_end(*request_, from.leg, from.location, from.t)) offer_end(id);
  close(id);
  const Agent& agent = request_->agent;
  Node node{};
  node.parent = id;
  node.t = from.t + 1;
  node.leg = agent.leg_after(from.leg, from.location);
  for (Direction d = 0; d <= GridGraph::direction_count; ++d) {
    const bool is_wait = d == GridGraph::direction_count;
    node.location = is_wait ? from.location : graph_.neighbor(from.location, d);
    if (node.location == nowhere || request_->table.distance(node.leg, node.location) >= TourTable::unreachable)
      continue;
    if (!request_->constraints.allows(from.location, node.location, node.t) ||
        !can_keep_landmarks(node.location, node.t))
      continue;
    const bool turns = !is_wait && from.heading != GridGraph::no_direction && from.heading != d;
    node.conflicts = from.conflicts + request_->others.count_at(from.location, node.location, node.t);
    node.turns = from.turns + (turns ? 1 : 0);
    node.heading = is_wait ? from.heading : static_cast<std::uint8_t>(d);
    node.waited_at_end =
        is_wait && node.location == agent.last_goal() && node.leg == from.leg && node.leg == agent.last_leg();
    offer(node);
  }
}

// Adds a node unless a better one with the same key is known.
void SpaceTimeSearch::offer(Node node) {
  node.f =
      std::max(least_cost_by_way_of(*request_, node.leg, node.location, node.t, node.waited_at_end), focal_.least_f());
  if (node.f > request_->constraints.finish_until()) return;
  const auto time = static_cast<std::uint64_t>(std::min(node.t, horizon_));
  node.key =
      ((static_cast<std::uint64_t>(node.leg) << 28 | time) * static_cast<std::uint64_t>(graph_.location_count()) +
       static_cast<std::uint64_t>(node.location)) *
          2 +
      (node.waited_at_end ? 1 : 0);
  node.is_fresh = true;
  Id& known = slot_of(node.key);
  if (known != none) {
    const Node& other = nodes_[known];
    // by time, not by f: with f raised to the lower bound, a later node may have the same f
    const auto rank = [](const Node& n) { return std::tuple(n.t, n.conflicts, n.turns); };
    const bool is_only_straighter = other.t == node.t && other.conflicts == node.conflicts;
    if (rank(other) <= rank(node) || (is_only_straighter && !other.is_open)) return;
    node.is_fresh = other.is_fresh || other.t > node.t;
    close(known);
  }
  known = static_cast<Id>(nodes_.size());
  nodes_.push_back(node);
  open(nodes_.back());
  if (nodes_.size() * 2 > slots_.size()) grow_slots();
}

// Adds the node in which the agent comes to rest here. Its conflicts include those with agents that pass later.
void SpaceTimeSearch::offer_end(Id id) {
  Node end = nodes_[id];
  end.parent = id;
  end.f = std::max(end.t, focal_.least_f());
  end.conflicts += request_->others.count_after(end.location, end.t);
  end.is_end = true;
  nodes_.push_back(end);
  open(nodes_.back());
}

// Whether the agent can still reach the next landmark in time.
bool SpaceTimeSearch::can_keep_landmarks(Location location, std::int32_t t) const {
  const auto steps_to = [&](Location to) {
    return std::abs(graph_.column(location) - graph_.column(to)) + std::abs(graph_.row(location) - graph_.row(to));
  };
  for (const ConstraintTable::Landmark& landmark : request_->constraints.landmarks())
    if (landmark.t >= t) return steps_to(landmark.location) <= landmark.t - t;
  return true;
}

// Opens the last node.
void SpaceTimeSearch::open(const Node& node) {
  const auto id = static_cast<Id>(nodes_.size() - 1);
  nodes_[id].is_open = true;
  if (node.is_fresh) focal_.add_fresh(node.f, 1);
  const std::int32_t rest = node.is_end ? 0 : node.f - node.t + 1;
  focal_.push(id, node.f,
              focal_order(node.conflicts, request_->conflict_steps, node.f - focal_.least_f(), rest, node.turns));
}

void SpaceTimeSearch::close(Id id) {
  Node& node = nodes_[id];
  if (node.is_fresh) focal_.add_fresh(node.f, -1);
  node.is_open = false;
  node.is_fresh = false;
}

SpaceTimeSearch::Id& SpaceTimeSearch::slot_of(std::uint64_t key) {
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t i = (key * 0x9E3779B97F4A7C15u) >> 20 & mask;; i = (i + 1) & mask) {
    Slot& slot = slots_[i];
    if (slot.epoch != epoch_) {
      slot = {epoch_, none};
      return slot.node;
    }
    if (slot.node == none || nodes_[slot.node].key == key) return slot.node;
  }
}

void SpaceTimeSearch::grow_slots() {
  slots_.assign(slots_.size() * 2, {});
  epoch_ = 1;
  // of nodes with equal keys the last one is the best
  for (Id id = 0; id < nodes_.size(); ++id)
    if (!nodes_[id].is_end) slot_of(nodes_[id].key) = id;
}

void SpaceTimeSearch::extract(Id id, LowLevelPath& found) const {
  found.lower_bound = focal_.bound();
  found.conflicts = nodes_[id].conflicts;
  found.locations.resize(static_cast<std::size_t>(nodes_[id].t) + 1);
  for (Id n = nodes_[id].parent; n != none; n = nodes_[n].parent)
    found.locations[static_cast<std::size_t>(nodes_[n].t)] = nodes_[n].location;
}

}  // namespace dmrp::planners
