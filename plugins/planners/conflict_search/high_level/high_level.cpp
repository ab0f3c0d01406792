// SPDX-License-Identifier: MIT
#include "planners/conflict_search/high_level/high_level.hpp"

#include <algorithm>
#include <cassert>
#include <dmrp/toolkit/random.hpp>
#include <limits>
#include <span>
#include <tuple>

#include "planners/mapf/solvability.hpp"

namespace dmrp::planners {

namespace {

// The first search prefers few conflicts to few steps, which solves easy problems soonest. It gets 1 / first_share of
// the expansions of a restart.
constexpr std::int64_t first_share = 4;

// After so many expansions without a solution the search tries to prove that there is none ...
constexpr std::int64_t expansions_before_proof = 1000;
// ... by visiting all joint positions, if there are at most so many.
constexpr std::size_t joint_state_limit = 300'000;

}  // namespace

HighLevel::HighLevel(const SearchContext& context, const ConflictSearchOptions& options, PairWeights* weights)
    : context_(context),
      options_(options),
      weights_(weights),
      queue_(tree_, options.selection, options.suboptimality),
      node_(tree_, context),
      splitter_(tree_, context, options),
      replanner_(context, options) {
  assert(options.suboptimality >= 1);
}

ConflictSearchStatistics HighLevel::statistics() const {
  ConflictSearchStatistics out = statistics_;
  out.lower_bound = lower_bound();
  out.low_level_expanded = replanner_.expanded() + (weights_ ? weights_->low_level_expanded() : 0);
  return out;
}

// Searches until one search ends by itself. A restart keeps the proved lower bound and shuffles the agents.
HighLevel::Result HighLevel::run(const std::vector<std::int32_t>& members, const std::vector<Constraint>& constraints) {
  members_ = members;
  std::vector<std::int32_t> order = members;
  Limits limits{options_.node_limit, std::numeric_limits<std::int64_t>::max()};
  std::int64_t expansions_of_restart = options_.restart_after;
  proved_bound_ = 0;
  expansions_of_run_ = 0;
  obstruction_.clear();
  for (std::int32_t restart = 0;; ++restart) {
    if (options_.restart_after > 0) {
      limits.expansions = restart == 0 ? expansions_of_restart / first_share + 1 : expansions_of_restart;
      if (restart > 0) expansions_of_restart += expansions_of_restart / 2 + 1;
    }
    // neither way is better on all maps, so restarts alternate
    const bool weighs_steps = restart > 0 && restart % 2 == 0;
    replanner_.set_conflict_steps(weighs_steps ? options_.conflict_steps : 0);
    const Result result = search(order, constraints, limits);
    proved_bound_ = lower_bound();
    limits.nodes -= tree_.node_count();
    if (result != Result::limit || limits.nodes <= 0) return result;
    toolkit::Stream stream(options_.seed, "restart", restart);
    stream.shuffle(order);
  }
}

// One search, the agents' first paths planned in this order.
HighLevel::Result HighLevel::search(const std::vector<std::int32_t>& order, const std::vector<Constraint>& constraints,
                                    const Limits& limits) {
  StopSignal& stop = context_.stop;
  const std::int64_t expanded_before = statistics_.high_level_expanded;
  if (!insert_root(order, constraints)) return stop.raised() ? Result::stopped : Result::unsolvable;
  while (const NodeQueue::Choice choice = queue_.select()) {
    node_.enter(choice.node);
    if (node_.conflicts().empty()) return Result::solved;
    if (choice.for_its_bound && !raise_bound()) continue;

    ++statistics_.high_level_expanded;
    std::span<const Child> children;
    for (bool is_bypassed = true; is_bypassed && !stop.raised();) {
      children = {};
      if (options_.replan_in_place) replan_in_place();
      if (node_.conflicts().empty()) {
        queue_.insert(node_.id());  // the solution, once it is selected
        break;
      }
      const std::uint32_t conflict = splitter_.choose_conflict(node_);
      is_bypassed = false;
      for (const std::vector<Constraint>& further : splitter_.split(node_, conflict)) {
        Child& child = children_[children.size()];
        if (!replan(further, child)) continue;
        children = {children_.data(), children.size() + 1};
        if ((is_bypassed = try_bypass(child))) break;
      }
    }
    if (stop.poll_now()) return Result::stopped;
    estimate_.learn(node_.node(), children);
    for (const Child& child : children) insert(child);

    if (++expansions_of_run_ == expansions_before_proof) {
      const auto obstruction = find_joint_obstruction(context_.problem, joint_state_limit, stop);
      if (stop.raised()) return Result::stopped;
      if (obstruction) return obstruction_ = *obstruction, Result::unsolvable;
    }
    if (tree_.node_count() >= limits.nodes || statistics_.high_level_expanded - expanded_before >= limits.expansions) {
      queue_.raise_bound();
      return Result::limit;
    }
  }
  obstruction_ = "every way to resolve the robots' conflicts was tried";
  return Result::unsolvable;
}

// False if an agent has no path, or if the search was stopped.
bool HighLevel::insert_root(const std::vector<std::int32_t>& order, const std::vector<Constraint>& constraints) {
  node_.leave();
  tree_.reset(context_.problem.agents.size(), members_);
  queue_.reset(proved_bound_);
  Child& root = children_[0];
  if (!replanner_.plan_root(order, constraints, node_.occupied(), root)) return false;
  node_.leave();
  root.node.estimated_cost = estimate_.of(root.node);
  insert(root);
  return true;
}

// Raises the node's bound by the dependencies between its agents. False if the node is not to be expanded: it is back
// in the queue, or there is no solution below it.
bool HighLevel::raise_bound() {
  if (!weights_ || node_.node().is_informed) return true;
  const std::int32_t bound = weights_->bound(node_);
  if (context_.stop.raised()) return true;
  if (bound >= PairWeights::unsolvable) return false;
  Node& node = tree_.node(node_.id());
  node.is_informed = true;
  if (bound <= node.f) return true;
  node.f = bound;
  node.estimated_cost = std::max(node.estimated_cost, static_cast<double>(node.f));
  if (node.f <= lower_bound()) return true;
  queue_.insert(node_.id());
  return false;
}

// Replans agents one after the other, as long as that leaves fewer conflicting pairs (or as many at less cost): first
// agents_to_replan(), then those with which the replanned ones conflict. That takes no constraints, so the node with
// the new paths takes the place of the old one.
void HighLevel::replan_in_place() {
  if (node_.conflicts().empty()) return;
  std::vector<std::int32_t> agents = agents_to_replan();
  const std::size_t most = 10 * members_.size();
  std::vector<bool> is_due(context_.problem.agents.size(), false);
  for (const std::int32_t agent : agents) is_due[static_cast<std::size_t>(agent)] = true;
  const auto add_opponents = [&](std::int32_t agent) {
    for (const auto& [a, b] : node_.conflicting_pairs()) {
      if (a != agent && b != agent) continue;
      const std::int32_t other = a == agent ? b : a;
      if (!is_due[static_cast<std::size_t>(other)] && agents.size() < most) agents.push_back(other);
      is_due[static_cast<std::size_t>(other)] = true;
    }
  };
  Child& child = children_[0];
  for (std::size_t i = 0; i < agents.size() && !node_.conflicts().empty(); ++i) {
    const std::int32_t agent = agents[i];
    if (!is_due[static_cast<std::size_t>(agent)]) continue;
    is_due[static_cast<std::size_t>(agent)] = false;
    if (!replanner_.replan_agents(node_, {agent}, {}, child)) return;  // stopped
    const Node& node = node_.node();
    if (std::tie(child.node.pairs, child.node.cost) >= std::tie(node.pairs, node.cost)) continue;
    add_opponents(agent);
    child.node.estimated_cost = estimate_.of(child.node);
    node_.enter(add(child));
    add_opponents(agent);
  }
}

// At the root all agents with conflicts, elsewhere those of the conflict to split on.
std::vector<std::int32_t> HighLevel::agents_to_replan() {
  std::vector<std::int32_t> agents;
  if (node_.node().parent == no_node) {
    for (const auto& [a, b] : node_.conflicting_pairs()) agents.insert(agents.end(), {a, b});
  } else {
    const Conflict& conflict = tree_.conflict(splitter_.choose_conflict(node_));
    agents = {conflict.a, conflict.b};
  }
  return agents;
}

// A child of the node with further constraints. False if an agent has no path, or if the search was stopped.
bool HighLevel::replan(const std::vector<Constraint>& constraints, Child& child) {
  if (!replanner_.replan(node_, members_, constraints, child)) return false;
  child.node.estimated_cost = estimate_.of(child.node);
  return true;
}

// Bypass: where a child's paths have fewer conflicts within the same bounds, they take the place of the node's own, and
// the constraints are dropped.
bool HighLevel::try_bypass(Child& child) {
  const Node& node = node_.node();
  const auto is_within = [this](std::int32_t cost, std::int32_t bound) {
    return cost <= options_.suboptimality * bound + 1e-9;
  };
  if (!options_.bypass || child.node.pairs >= node.pairs || !is_within(child.node.cost, lower_bound())) return false;
  for (const AgentPath& path : child.paths)
    if (!is_within(cost_of(path.locations), node_.path_of(path.agent).lower_bound)) return false;

  // Without the constraints, the node's own bounds hold.
  child.constraints.clear();
  child.node.lower_bound = node.lower_bound;
  child.node.f = node.f;
  child.node.is_informed = node.is_informed;
  for (AgentPath& path : child.paths) path.lower_bound = node_.path_of(path.agent).lower_bound;
  node_.enter(add(child));
  return true;
}

void HighLevel::insert(const Child& child) {
  ++statistics_.high_level_generated;
  queue_.insert(add(child));
}

NodeId HighLevel::add(const Child& child) {
  return tree_.add(child.node, child.paths, child.constraints, child.conflicts);
}

}  // namespace dmrp::planners
