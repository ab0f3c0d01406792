// SPDX-License-Identifier: MIT
#include "planners/conflict_search/high_level/node_queue.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

namespace dmrp::planners {

// Ties go to the younger node: it has resolved more conflicts.
bool NodeQueue::is_later(const ByBound& a, const ByBound& b) {
  return std::tuple(a.f, a.pairs, -a.node) > std::tuple(b.f, b.pairs, -b.node);
}

bool NodeQueue::is_later_in_focal(const ByConflicts& a, const ByConflicts& b) {
  return std::tuple(a.pairs, a.cost, -a.node) > std::tuple(b.pairs, b.cost, -b.node);
}

void NodeQueue::reset(std::int32_t lower_bound) {
  lower_bound_ = lower_bound;
  focal_limit_ = -1;
  cleanup_.clear();
  open_.clear();
  focal_.clear();
  states_.clear();
}

void NodeQueue::insert(NodeId id) {
  if (states_.size() <= static_cast<std::size_t>(id)) states_.resize(static_cast<std::size_t>(id) + 1);
  state(id).is_open = true;
  cleanup_.push_back({tree_.node(id).f, tree_.node(id).pairs, id});
  std::push_heap(cleanup_.begin(), cleanup_.end(), is_later);
  if (selection_ == Selection::best_first) return;
  open_.emplace(rank(id), id);
  if (rank(id) <= focal_limit_) push_focal(id);
}

NodeQueue::Choice NodeQueue::select() {
  if (!raise_bound()) return {};
  const NodeId least_bound = cleanup_.front().node;
  if (selection_ == Selection::best_first) return {remove(least_bound), true};
  move_focal_limit();
  if (const NodeId id = first_in_focal(); id != no_node && is_within_bound(id)) return {remove(id), false};
  if (const NodeId id = open_.begin()->second; is_within_bound(id)) return {remove(id), false};
  return {remove(least_bound), true};
}

double NodeQueue::rank(NodeId id) const {
  return selection_ == Selection::focal ? tree_.node(id).cost : tree_.node(id).estimated_cost;
}

bool NodeQueue::raise_bound() {
  while (!cleanup_.empty() &&
         (!state(cleanup_.front().node).is_open || tree_.node(cleanup_.front().node).f != cleanup_.front().f)) {
    std::pop_heap(cleanup_.begin(), cleanup_.end(), is_later);
    cleanup_.pop_back();
  }
  if (cleanup_.empty()) return false;
  lower_bound_ = std::max(lower_bound_, cleanup_.front().f);
  return true;
}

// When the limit falls, first_in_focal() removes the nodes beyond it as they come up.
void NodeQueue::move_focal_limit() {
  const double least = selection_ == Selection::focal ? lower_bound_ : open_.begin()->first;
  const double limit = suboptimality_ * least + 1e-9;
  if (limit > focal_limit_)
    for (auto it = open_.upper_bound({focal_limit_, std::numeric_limits<NodeId>::max()});
         it != open_.end() && it->first <= limit; ++it)
      push_focal(it->second);
  focal_limit_ = limit;
}

void NodeQueue::push_focal(NodeId id) {
  if (state(id).is_in_focal) return;
  state(id).is_in_focal = true;
  focal_.push_back({tree_.node(id).pairs, rank(id), id});
  std::push_heap(focal_.begin(), focal_.end(), is_later_in_focal);
}

NodeId NodeQueue::first_in_focal() {
  while (!focal_.empty()) {
    const ByConflicts& first = focal_.front();
    const bool is_current = state(first.node).is_open && rank(first.node) == first.cost;
    if (is_current && first.cost <= focal_limit_) return first.node;
    state(first.node).is_in_focal = false;
    std::pop_heap(focal_.begin(), focal_.end(), is_later_in_focal);
    focal_.pop_back();
  }
  return no_node;
}

NodeId NodeQueue::remove(NodeId id) {
  state(id) = {};
  open_.erase({rank(id), id});
  return id;
}

}  // namespace dmrp::planners
