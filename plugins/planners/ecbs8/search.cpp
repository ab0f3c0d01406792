// SPDX-License-Identifier: MIT
#include "planners/ecbs8/search.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "planners/mapf/solvability.hpp"

namespace dmrp::planners::ecbs8 {

namespace {

// After so many expansions without a solution the search tries to prove that there is none ...
constexpr std::int64_t expansions_before_proof = 1000;
// ... by visiting all joint positions, if there are at most so many.
constexpr std::size_t joint_state_limit = 100'000;

bool involves(const Conflict& conflict, std::int32_t agent) {
  return conflict.a == agent || conflict.b == agent;
}

}  // namespace

Search::Search(const Problem& problem, const std::vector<TourDistances>& distances, double suboptimality,
               std::int64_t node_limit, StopSignal& stop)
    : problem_(problem),
      distances_(distances),
      suboptimality_(suboptimality),
      node_limit_(node_limit),
      stop_(stop),
      tree_(problem.agents.size()),
      paths_(problem.agents.size()),
      occupied_(problem.graph, problem.agents.size()),
      low_level_(problem.graph),
      constraint_table_(problem.graph) {}

Search::Result Search::run() {
  if (!plan_root()) return Result::stopped;
  for (;;) {
    const NodeId best = choose();
    if (best == no_node)
      return obstruction_ = "every way to resolve the robots' conflicts was tried", Result::unsolvable;
    if (expand(best)) return Result::solved;
    if (stop_.poll_now()) return Result::stopped;
    if (statistics_.high_level_generated >= node_limit_) return Result::node_limit;
    if (statistics_.high_level_expanded != expansions_before_proof) continue;
    const auto found = find_joint_obstruction(problem_, joint_state_limit, stop_);
    if (stop_.raised()) return Result::stopped;
    if (found) return obstruction_ = *found, Result::unsolvable;
  }
}

// Plans the agents one after the other, each with few conflicts with those before it. Agents with short distances come
// first, because their cost limits leave less slack.
bool Search::plan_root() {
  constraint_table_.fill({});
  Node root;
  std::vector<BoundedPath> paths(problem_.agents.size());
  std::vector<Conflict> conflicts;
  std::vector<AgentPath> agent_paths;
  for (const std::size_t i : by_distance()) {
    const auto agent = static_cast<std::int32_t>(i);
    const auto result = low_level_.search(problem_.agents[i], distances_[i], constraint_table_, occupied_, 0,
                                          suboptimality_, stop_, paths[i]);
    if (result != FocalSearch::Result::found) return false;
    const PathView path = paths[i].locations;
    occupied_.list(agent, path, conflicts);
    occupied_.set(agent, path);
    agent_paths.push_back({agent, path, paths[i].cost, paths[i].lower_bound});
    root.cost += paths[i].cost;
    root.lower_bound += paths[i].lower_bound;
    root.turns += count_turns(problem_.graph, path);
  }
  for (const AgentPath& path : agent_paths) occupied_.set(path.agent, {});
  for (const Conflict& conflict : conflicts) root.conflicting_pairs += conflict.is_first ? 1 : 0;
  push(tree_.add(root, agent_paths, conflicts));
  return true;
}

std::vector<std::size_t> Search::by_distance() const {
  const auto distance = [this](std::size_t i) { return distances_[i].distance(0, problem_.agents[i].start); };
  std::vector<std::size_t> order(problem_.agents.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
  return order;
}

// The node of FOCAL with fewest conflicts, or no_node if none is left. Raises the lower bound.
//
// Every path is within the limit of its own lower bound, so the node with the least lower bound is always in FOCAL.
NodeId Search::choose() {
  while (!open_.empty() && is_closed_[static_cast<std::size_t>(open_.front().node)]) {
    std::pop_heap(open_.begin(), open_.end(), IsWorse{});
    open_.pop_back();
  }
  if (open_.empty()) return no_node;
  statistics_.lower_bound = std::max(statistics_.lower_bound, open_.front().lower_bound);
  const Cost bound = suboptimality_.limit(statistics_.lower_bound);
  while (!waiting_.empty() && waiting_.front().cost <= bound) {
    focal_.push_back(waiting_.front());
    std::push_heap(focal_.begin(), focal_.end(), IsWorse{});
    std::pop_heap(waiting_.begin(), waiting_.end(), IsDearer{});
    waiting_.pop_back();
  }
  const NodeId best = focal_.front().node;
  std::pop_heap(focal_.begin(), focal_.end(), IsWorse{});
  focal_.pop_back();
  is_closed_[static_cast<std::size_t>(best)] = 1;
  return best;
}

// Splits the node on a conflict. True if it has none: then its paths are the solution.
//
// Bypass (Boyarski et al. 2015): if a child has fewer conflicting pairs, and its path is within the limits that hold
// without the constraint, the node adopts the path and is not split.
bool Search::expand(NodeId id) {
  ++statistics_.high_level_expanded;
  for (;;) {
    enter(id);
    if (conflicts_.empty()) return cost_ = tree_.node(id).cost, true;
    const std::array<Side, 2> sides = split(choose_conflict());
    std::array<bool, 2> has_path{};
    const Child* bypass = nullptr;
    for (std::size_t i = 0; i < 2 && !bypass; ++i) {
      has_path[i] = make_child(id, sides[i], children_[i]);
      if (has_path[i] && may_bypass(id, children_[i])) bypass = &children_[i];
    }
    if (stop_.poll_now()) return false;
    if (bypass) {
      id = add_without_constraint(*bypass, id);
      continue;
    }
    for (std::size_t i = 0; i < 2; ++i)
      if (has_path[i]) push(add(children_[i]));
    return false;
  }
}

bool Search::may_bypass(NodeId parent, const Child& child) const {
  const Cost lower_bound = paths_[static_cast<std::size_t>(child.node.constrained_agent)].lower_bound;
  return child.node.conflicting_pairs < tree_.node(parent).conflicting_pairs &&
         child.path.cost <= suboptimality_.limit(lower_bound) &&
         child.node.cost <= suboptimality_.limit(statistics_.lower_bound);
}

void Search::enter(NodeId id) {
  tree_.gather_paths(id, paths_);
  for (const AgentPath& path : paths_) occupied_.set(path.agent, path.locations);
  tree_.gather_conflicts(id, conflicts_);
}

// The earliest conflict.
const Conflict& Search::choose_conflict() const {
  const auto order = [this](std::uint32_t index) {
    const Conflict& c = tree_.conflict(index);
    return std::tuple(c.t, c.a, c.b, c.location);
  };
  return tree_.conflict(
      *std::min_element(conflicts_.begin(), conflicts_.end(),
                        [&](std::uint32_t left, std::uint32_t right) { return order(left) < order(right); }));
}

// Every use that one side forbids excludes every use that the other side forbids, so every plan satisfies one side.
//
// A robot at a location excludes others there, and diagonals beside it that begin or end then. So one side forbids one
// agent to be there, the other side forbids the other agent to touch the location. If the first agent rests there
// (target reasoning, Li et al. 2021), either it comes to rest later, or the other one does not touch the location from
// then on.
std::array<Search::Side, 2> Search::split(const Conflict& conflict) const {
  using Use = Constraint::Use;
  const Location location = conflict.location;
  const std::int32_t t = conflict.t;
  const auto rests = [&](std::int32_t agent) {
    return t + 1 >= static_cast<std::int32_t>(paths_[static_cast<std::size_t>(agent)].locations.size());
  };
  if (conflict.kind == Conflict::Kind::edge || conflict.kind == Conflict::Kind::corner) {
    const Use use = conflict.kind == Conflict::Kind::edge ? Use::edge : Use::corner;
    const Constraint constraint{use, location, conflict.other, t, t};
    return {{{conflict.a, constraint}, {conflict.b, constraint}}};
  }
  std::int32_t there = conflict.a;
  std::int32_t other = conflict.b;
  if (conflict.kind == Conflict::Kind::vertex && rests(other)) std::swap(there, other);
  if (rests(there))
    return {{{there, {Use::end, nowhere, nowhere, 0, t}}, {other, {Use::touch, location, nowhere, t, forever}}}};
  return {{{there, {Use::at, location, nowhere, t, t}}, {other, {Use::touch, location, nowhere, t, t}}}};
}

// False if there is no path under the constraint, or if the search was stopped.
bool Search::make_child(NodeId parent, const Side& side, Child& child) {
  const auto index = static_cast<std::size_t>(side.agent);
  const AgentPath& before = paths_[index];
  tree_.gather_constraints(parent, side.agent, constraints_);
  constraints_.push_back(side.constraint);
  constraint_table_.fill(constraints_);

  occupied_.set(side.agent, {});
  const auto result = low_level_.search(problem_.agents[index], distances_[index], constraint_table_, occupied_,
                                        before.lower_bound, suboptimality_, stop_, child.path);
  child.conflicts.clear();
  const bool found = result == FocalSearch::Result::found;
  if (found) occupied_.list(side.agent, child.path.locations, child.conflicts);
  occupied_.set(side.agent, before.locations);
  if (!found) return false;

  child.node = tree_.node(parent);
  child.node.parent = parent;
  child.node.constrained_agent = side.agent;
  child.node.constraint = side.constraint;
  child.node.cost += child.path.cost - before.cost;
  child.node.lower_bound += child.path.lower_bound - before.lower_bound;
  child.node.turns += count_turns(problem_.graph, child.path.locations) - count_turns(problem_.graph, before.locations);
  child.node.conflicting_pairs = count_pairs(child);
  return true;
}

std::int32_t Search::count_pairs(const Child& child) const {
  std::int32_t count = 0;
  for (const Conflict& conflict : child.conflicts) count += conflict.is_first ? 1 : 0;
  for (const std::uint32_t index : conflicts_) {
    const Conflict& conflict = tree_.conflict(index);
    count += conflict.is_first && !involves(conflict, child.node.constrained_agent) ? 1 : 0;
  }
  return count;
}

NodeId Search::add(const Child& child) {
  const AgentPath path{child.node.constrained_agent, child.path.locations, child.path.cost, child.path.lower_bound};
  return tree_.add(child.node, {&path, 1}, child.conflicts);
}

// Without the constraint, the lower bounds are those of the parent.
NodeId Search::add_without_constraint(const Child& child, NodeId parent) {
  const std::int32_t agent = child.node.constrained_agent;
  const AgentPath path{agent, child.path.locations, child.path.cost,
                       paths_[static_cast<std::size_t>(agent)].lower_bound};
  Node node = child.node;
  node.constrained_agent = -1;
  node.lower_bound = tree_.node(parent).lower_bound;
  return tree_.add(node, {&path, 1}, child.conflicts);
}

void Search::push(NodeId id) {
  ++statistics_.high_level_generated;
  const Node& node = tree_.node(id);
  is_closed_.resize(static_cast<std::size_t>(id) + 1, 0);
  open_.push_back({node.lower_bound, id});
  std::push_heap(open_.begin(), open_.end(), IsWorse{});
  const FocalEntry entry{node.conflicting_pairs, node.turns, node.cost, id};
  if (node.cost <= suboptimality_.limit(statistics_.lower_bound)) {
    focal_.push_back(entry);
    std::push_heap(focal_.begin(), focal_.end(), IsWorse{});
  } else {
    waiting_.push_back(entry);
    std::push_heap(waiting_.begin(), waiting_.end(), IsDearer{});
  }
}

bool Search::IsWorse::operator()(const OpenEntry& a, const OpenEntry& b) const {
  return a.lower_bound != b.lower_bound ? a.lower_bound > b.lower_bound : a.node > b.node;
}

bool Search::IsWorse::operator()(const FocalEntry& a, const FocalEntry& b) const {
  return std::tie(a.conflicting_pairs, a.cost, a.turns, a.node) >
         std::tie(b.conflicting_pairs, b.cost, b.turns, b.node);
}

bool Search::IsDearer::operator()(const FocalEntry& a, const FocalEntry& b) const {
  return std::tie(a.cost, a.node) > std::tie(b.cost, b.node);
}

std::vector<PathView> Search::solution() const {
  std::vector<PathView> out;
  for (const AgentPath& path : paths_) out.push_back(path.locations);
  return out;
}

Statistics Search::statistics() const {
  Statistics statistics = statistics_;
  statistics.low_level_expanded = low_level_.expanded();
  return statistics;
}

}  // namespace dmrp::planners::ecbs8
