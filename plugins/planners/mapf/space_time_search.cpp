// SPDX-License-Identifier: MIT
#include "space_time_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <tuple>

namespace dmrp::planners {

namespace {

constexpr auto lower_order = [](const auto& a, const auto& b) { return a.order > b.order; };

// A part of a packed order: what does not fit ranks with the largest that does.
std::uint64_t part(std::int32_t value, int bits, int shift) {
  const std::int32_t most = (1 << bits) - 1;
  return static_cast<std::uint64_t>(std::clamp(value, 0, most)) << shift;
}

}  // namespace

SpaceTimeSearch::Result SpaceTimeSearch::search(const Request& request, StopSignal& stop, Found& found) {
  reset(request);
  const Location start = request.agent.start;
  const ConstraintTable& constraints = request.constraints;
  if (constraints.finish_from() == forever || constraints.finish_from() > constraints.finish_until() ||
      !constraints.allows(start, start, 0) || !keeps_landmarks(start, 0))
    return Result::none;
  offer({0, no_node, start, 0, 0, 0, 0, 0, GridGraph::no_direction, true, false, false});
  while (advance_bound()) {
    if (stop.poll()) return Result::stopped;
    const NodeId best = pop_focal();
    if (best == no_node) continue;  // of a level that has nothing left
    if (nodes_[best].is_end) {
      extract(best, found);
      return Result::found;
    }
    expand(best);
  }
  return Result::none;
}

void SpaceTimeSearch::reset(const Request& request) {
  request_ = &request;
  const ConstraintTable& constraints = request.constraints;
  horizon_ = std::max(constraints.constant_from(), request.others.rest_from() + 1);
  if (constraints.finish_from() != forever) horizon_ = std::max(horizon_, constraints.finish_from());
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
  ++epoch_;
}

// Moves the bound to the least f of an open node, and the nodes within it to FOCAL. False if there is none. Nodes that
// are open again because they can be reached with fewer conflicts say nothing new about cost.
bool SpaceTimeSearch::advance_bound() {
  while (bound_level_ < level_count_ && levels_[static_cast<std::size_t>(bound_level_)].fresh == 0) ++bound_level_;
  if (bound_level_ >= level_count_) return false;
  const double bound = request_->suboptimality * (least_f_ + bound_level_) + request_->slack;
  const auto last =
      std::max(bound_level_, static_cast<std::int32_t>(std::min(std::floor(bound + 1e-9), 1e9)) - least_f_);
  while (focal_level_ < last && focal_level_ + 1 < level_count_) {
    Level& level = levels_[static_cast<std::size_t>(++focal_level_)];
    for (const NodeId id : level.waiting)
      if (nodes_[id].is_open && nodes_[id].f - least_f_ == focal_level_) push_focal(id);
    level.waiting.clear();
  }
  return true;
}

void SpaceTimeSearch::expand(NodeId id) {
  ++expanded_;
  if (can_end(nodes_[id])) offer_end(id);
  const Node from = nodes_[id];
  const Agent& agent = request_->agent;
  const std::int32_t t = from.t + 1;
  const std::int32_t leg = agent.leg_after(from.leg, from.location);
  for (Direction d = 0; d <= GridGraph::direction_count; ++d) {
    const bool is_wait = d == GridGraph::direction_count;
    const Location to = is_wait ? from.location : graph_.neighbor(from.location, d);
    if (to == nowhere || request_->table.distance(leg, to) >= TourTable::unreachable) continue;
    if (!request_->constraints.allows(from.location, to, t) || !keeps_landmarks(to, t)) continue;
    const bool turns = !is_wait && from.heading != GridGraph::no_direction && from.heading != d;
    offer({0, id, to, t, leg, 0, from.conflicts + request_->others.count_at(from.location, to, t),
           from.turns + (turns ? 1 : 0), is_wait ? from.heading : static_cast<std::uint8_t>(d), true, false, false});
  }
}

// Keeps a node unless a better one of the same key is known.
void SpaceTimeSearch::offer(Node node) {
  const bool waited = waits_at_the_end(node);
  node.f = std::max(estimate(node.leg, node.location, node.t, waited), least_f_);
  if (node.f > request_->constraints.finish_until()) return;
  const auto locations = static_cast<std::uint64_t>(graph_.location_count());
  const auto time = static_cast<std::uint64_t>(std::min(node.t, horizon_));
  node.key =
      (((static_cast<std::uint64_t>(node.leg) << 28 | time) * locations) + static_cast<std::uint64_t>(node.location)) *
          2 +
      (waited ? 1 : 0);
  NodeId& known = slot_of(node.key);
  if (known == no_node) {
    known = static_cast<NodeId>(nodes_.size());
    nodes_.push_back(node);
    open(known);
    if (nodes_.size() * 2 > slots_.size()) grow_slots();
    return;
  }
  Node& other = nodes_[known];
  const auto rank = [](const Node& n) { return std::tuple(n.f, n.conflicts, n.turns); };
  if (rank(other) <= rank(node) || (!other.is_open && other.f == node.f && other.conflicts == node.conflicts)) return;
  if (other.is_open && !other.was_expanded) --levels_[static_cast<std::size_t>(other.f - least_f_)].fresh;
  node.was_expanded = other.was_expanded && other.f <= node.f;
  other = node;
  open(known);
}

// The agent may stay where the node is: a node of its own, since others that pass there later count.
void SpaceTimeSearch::offer_end(NodeId id) {
  Node end = nodes_[id];
  end.parent = id;
  end.f = std::max(end.t, least_f_);
  end.conflicts += request_->others.count_after(end.location, end.t);
  end.is_open = true;
  end.was_expanded = false;
  end.is_end = true;
  nodes_.push_back(end);
  open(static_cast<NodeId>(nodes_.size() - 1));
}

// Whether the node's last step is a wait where the path could have ended: it cannot end here then.
bool SpaceTimeSearch::waits_at_the_end(const Node& node) const {
  if (node.parent == no_node || node.location != request_->agent.last_goal()) return false;
  const Node& parent = nodes_[node.parent];
  return parent.location == node.location && parent.leg == node.leg && node.leg == request_->agent.last_leg();
}

bool SpaceTimeSearch::can_end(const Node& node) const {
  return node.location == request_->agent.last_goal() && node.leg == request_->agent.last_leg() &&
         node.t >= request_->constraints.finish_from() && node.t <= request_->constraints.finish_until() &&
         !waits_at_the_end(node);
}

// The least cost of a path by way of a place at a time.
std::int32_t SpaceTimeSearch::estimate(std::int32_t leg, Location location, std::int32_t t, bool waited_at_end) const {
  std::int32_t rest = request_->table.distance(leg, location);
  const std::int32_t finish_from = request_->constraints.finish_from();
  if (rest == 0 && (waited_at_end || t < finish_from)) rest = 2;  // away and back
  std::int32_t f = std::max(t + rest, finish_from);
  if (request_->agent.last_leg() == 0)
    for (const ConstraintTable::Landmark& landmark : request_->constraints.landmarks())
      if (landmark.t >= t) f = std::max(f, landmark.t + request_->table.distance(0, landmark.location));
  return f;
}

bool SpaceTimeSearch::keeps_landmarks(Location location, std::int32_t t) const {
  for (const ConstraintTable::Landmark& landmark : request_->constraints.landmarks()) {
    if (landmark.t < t) continue;
    return columns_and_rows_between(location, landmark.location) <= landmark.t - t;
  }
  return true;
}

std::int32_t SpaceTimeSearch::columns_and_rows_between(Location a, Location b) const {
  return std::abs(a % graph_.width() - b % graph_.width()) + std::abs(a / graph_.width() - b / graph_.width());
}

// Fewest conflicts first, then least f, then nearest to the end, then fewest turns.
std::uint64_t SpaceTimeSearch::order_of(const Node& node) const {
  const std::int32_t rest = node.is_end ? 0 : node.f - node.t + 1;
  return part(node.conflicts, 16, 48) | part(node.f - least_f_, 16, 32) | part(rest, 18, 14) | part(node.turns, 14, 0);
}

void SpaceTimeSearch::open(NodeId id) {
  const std::int32_t level = nodes_[id].f - least_f_;
  if (static_cast<std::size_t>(level) >= levels_.size()) levels_.resize(static_cast<std::size_t>(level) + 1);
  level_count_ = std::max(level_count_, level + 1);
  if (!nodes_[id].was_expanded) ++levels_[static_cast<std::size_t>(level)].fresh;
  if (level <= focal_level_)
    push_focal(id);
  else
    levels_[static_cast<std::size_t>(level)].waiting.push_back(id);
}

void SpaceTimeSearch::push_focal(NodeId id) {
  focal_.push_back({order_of(nodes_[id]), id});
  std::push_heap(focal_.begin(), focal_.end(), lower_order);
}

// Takes the first of FOCAL that is still what it was when it was put there.
SpaceTimeSearch::NodeId SpaceTimeSearch::pop_focal() {
  while (!focal_.empty()) {
    const FocalEntry entry = focal_.front();
    std::pop_heap(focal_.begin(), focal_.end(), lower_order);
    focal_.pop_back();
    Node& node = nodes_[entry.node];
    if (!node.is_open || order_of(node) != entry.order) continue;
    node.is_open = false;
    if (!node.was_expanded) --levels_[static_cast<std::size_t>(node.f - least_f_)].fresh;
    node.was_expanded = true;
    return entry.node;
  }
  return no_node;
}

SpaceTimeSearch::NodeId& SpaceTimeSearch::slot_of(std::uint64_t key) {
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t i = (key * 0x9E3779B97F4A7C15u) >> 20 & mask;; i = (i + 1) & mask) {
    Slot& slot = slots_[i];
    if (slot.epoch != epoch_) {
      slot = {epoch_, no_node};
      return slot.node;
    }
    if (slot.node == no_node || nodes_[slot.node].key == key) return slot.node;
  }
}

void SpaceTimeSearch::grow_slots() {
  slots_.assign(slots_.size() * 2, {});
  epoch_ = 1;
  for (NodeId id = 0; id < nodes_.size(); ++id)
    if (!nodes_[id].is_end) slot_of(nodes_[id].key) = id;
}

void SpaceTimeSearch::extract(NodeId id, Found& found) const {
  found.lower_bound = least_f_ + bound_level_;
  found.conflicts = nodes_[id].conflicts;
  found.path.resize(static_cast<std::size_t>(nodes_[id].t) + 1);
  for (NodeId n = nodes_[id].parent; n != no_node; n = nodes_[n].parent)
    found.path[static_cast<std::size_t>(nodes_[n].t)] = nodes_[n].location;
}

}  // namespace dmrp::planners
