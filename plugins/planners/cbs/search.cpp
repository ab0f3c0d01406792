// SPDX-License-Identifier: MIT
#include "search.hpp"

#include <algorithm>
#include <tuple>

#include "../mapf/solvability.hpp"

namespace dmrp::planners {

namespace {

// A problem that is still unsolved after so many expansions is worth a proof that it has no plan ...
constexpr std::int64_t expansions_before_proof = 1000;
// ... if that visits at most so many joint positions.
constexpr std::size_t joint_state_limit = 300'000;

// What forbids each of two agents its part of their conflict.
std::array<Constraint, 2> split(const Conflict& conflict) {
  if (conflict.from == nowhere)
    return {
        {{conflict.a, conflict.location, nowhere, conflict.t}, {conflict.b, conflict.location, nowhere, conflict.t}}};
  return {{{conflict.a, conflict.location, conflict.from, conflict.t},
           {conflict.b, conflict.from, conflict.location, conflict.t}}};
}

bool involves(const Conflict& conflict, std::int32_t agent) {
  return conflict.a == agent || conflict.b == agent;
}

}  // namespace

CbsSearch::CbsSearch(const Problem& problem, const std::vector<TourTable>& tables, std::int64_t node_limit,
                     StopSignal& stop)
    : problem_(problem),
      tables_(tables),
      node_limit_(node_limit),
      stop_(stop),
      tree_(problem.agents.size()),
      occupied_(problem.graph, problem.agents.size()),
      low_level_(problem.graph),
      mdds_(problem, tables),
      constraint_table_(problem.graph) {}

CbsSearch::Result CbsSearch::run() {
  if (!plan_root()) return Result::stopped;
  while (!open_.empty()) {
    const NodeId best = pop();
    statistics_.lower_bound = tree_.node(best).cost;
    if (expand(best)) return Result::solved;
    if (stop_.poll_now()) return Result::stopped;
    if (statistics_.high_level_generated >= node_limit_) return Result::node_limit;
    if (statistics_.high_level_expanded == expansions_before_proof) {
      const auto found = find_joint_obstruction(problem_, joint_state_limit, stop_);
      if (stop_.raised()) return Result::stopped;
      if (found) return obstruction_ = *found, Result::unsolvable;
    }
  }
  obstruction_ = "every way to resolve the robots' conflicts was tried";
  return Result::unsolvable;
}

// Each agent's best path; ties are broken against conflicts with the agents before it.
bool CbsSearch::plan_root() {
  constraint_table_.fill({});
  Node root;
  std::vector<std::vector<Location>> paths(problem_.agents.size());
  std::vector<Conflict> conflicts;
  std::vector<AgentPath> agent_paths;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const auto agent = static_cast<std::int32_t>(i);
    const auto result =
        low_level_.search(problem_.agents[i], tables_[i], constraint_table_, occupied_, stop_, paths[i]);
    if (result != SpaceTimeAStar::Result::found) return false;
    occupied_.list(agent, paths[i], conflicts);
    occupied_.set(agent, paths[i]);
    agent_paths.push_back({agent, paths[i]});
    root.cost += cost_of(paths[i]);
    root.turns += count_turns(problem_.graph, paths[i]);
  }
  for (std::size_t i = 0; i < paths.size(); ++i) occupied_.set(static_cast<std::int32_t>(i), {});
  root.conflict_count = static_cast<std::int32_t>(conflicts.size());
  push(tree_.add(root, agent_paths, {}, conflicts));
  return true;
}

// Splits the node on a conflict. True if it has none: its paths are the solution.
//
// Bypass (Boyarski et al. 2015): where a child costs no more than the node and has fewer conflicts, its path takes the
// place of the agent's in the node, without the constraint, and nothing is split.
bool CbsSearch::expand(NodeId id) {
  ++statistics_.high_level_expanded;
  for (;;) {
    enter(id);
    if (conflicts_.empty()) return true;
    const std::array<Constraint, 2> constraints = split(choose_conflict(id));
    std::array<bool, 2> has_path{};
    const Child* bypass = nullptr;
    for (std::size_t i = 0; i < 2 && !bypass; ++i) {
      has_path[i] = make_child(id, constraints[i], children_[i]);
      const Node& child = children_[i].node;
      if (has_path[i] && child.cost == tree_.node(id).cost && child.conflict_count < tree_.node(id).conflict_count)
        bypass = &children_[i];
    }
    if (stop_.raised()) return false;
    if (bypass) {
      id = add(*bypass, false);
      continue;
    }
    for (std::size_t i = 0; i < 2; ++i)
      if (has_path[i]) push(add(children_[i], true));
    return false;
  }
}

void CbsSearch::enter(NodeId id) {
  tree_.gather_paths(id, paths_);
  for (std::size_t i = 0; i < paths_.size(); ++i) occupied_.set(static_cast<std::int32_t>(i), paths_[i]);
  tree_.gather_conflicts(id, conflicts_);
  const auto order = [this](std::uint32_t index) {
    const Conflict& c = tree_.conflict(index).conflict;
    return std::tuple(c.t, c.a, c.b, c.from, c.location);
  };
  std::sort(conflicts_.begin(), conflicts_.end(),
            [&](std::uint32_t left, std::uint32_t right) { return order(left) < order(right); });
}

// False if the agent has no path under the constraint (or the search was stopped).
bool CbsSearch::make_child(NodeId parent, const Constraint& constraint, Child& child) {
  const std::int32_t agent = constraint.agent;
  const auto who = static_cast<std::size_t>(agent);
  tree_.gather_constraints(parent, agent, constraints_);
  constraints_.push_back(constraint);
  constraint_table_.fill(constraints_);

  occupied_.set(agent, {});
  const auto result =
      low_level_.search(problem_.agents[who], tables_[who], constraint_table_, occupied_, stop_, child.path);
  child.conflicts.clear();
  const bool found = result == SpaceTimeAStar::Result::found;
  if (found) occupied_.list(agent, child.path, child.conflicts);
  occupied_.set(agent, paths_[who]);
  if (!found) return false;

  const Node& from = tree_.node(parent);
  child.constraint = constraint;
  child.node = Node{};
  child.node.parent = parent;
  child.node.cost = from.cost - cost_of(paths_[who]) + cost_of(child.path);
  child.node.turns = from.turns - count_turns(problem_.graph, paths_[who]) + count_turns(problem_.graph, child.path);
  child.node.conflict_count = static_cast<std::int32_t>(child.conflicts.size());
  for (const std::uint32_t index : conflicts_)
    if (!involves(tree_.conflict(index).conflict, agent)) ++child.node.conflict_count;
  return true;
}

NodeId CbsSearch::add(const Child& child, bool with_constraint) {
  std::vector<Constraint> constraints;
  if (with_constraint) constraints.push_back(child.constraint);
  return tree_.add(child.node, {{child.constraint.agent, child.path}}, constraints, child.conflicts);
}

// The earliest cardinal conflict, else the earliest semi-cardinal one, else the earliest. Only as many as needed are
// classified.
const Conflict& CbsSearch::choose_conflict(NodeId id) {
  std::uint32_t chosen = conflicts_.front();
  Cardinality best = Cardinality::unknown;
  for (const std::uint32_t index : conflicts_) {
    if (stop_.poll_now()) break;
    NodeConflict& candidate = tree_.conflict(index);
    if (candidate.cardinality == Cardinality::unknown) candidate.cardinality = classify(id, candidate.conflict);
    if (candidate.cardinality > best) {
      best = candidate.cardinality;
      chosen = index;
    }
    if (best == Cardinality::full) break;
  }
  return tree_.conflict(chosen).conflict;
}

Cardinality CbsSearch::classify(NodeId id, const Conflict& conflict) {
  const std::array<Constraint, 2> sides = split(conflict);
  const int bound = (must_be_there(id, sides[0]) ? 1 : 0) + (must_be_there(id, sides[1]) ? 1 : 0);
  return bound == 2 ? Cardinality::full : bound == 1 ? Cardinality::semi : Cardinality::none;
}

// Whether all the agent's best paths do what the constraint would forbid.
bool CbsSearch::must_be_there(NodeId id, const Constraint& constraint) {
  const std::int32_t cost = cost_of(paths_[static_cast<std::size_t>(constraint.agent)]);
  if (constraint.t >= cost && constraint.from == nowhere) return true;  // it would have to end later
  tree_.gather_constraints(id, constraint.agent, constraints_);
  const Mdd& mdd = mdds_.get(constraint.agent, constraints_, cost);
  return mdd.must_be_at(constraint.location, constraint.t) &&
         (constraint.from == nowhere || mdd.must_be_at(constraint.from, constraint.t - 1));
}

bool CbsSearch::is_worse(const OpenEntry& a, const OpenEntry& b) {
  if (a.cost != b.cost) return a.cost > b.cost;
  if (a.conflict_count != b.conflict_count) return a.conflict_count > b.conflict_count;
  if (a.turns != b.turns) return a.turns > b.turns;
  return a.node < b.node;
}

void CbsSearch::push(NodeId id) {
  const Node& node = tree_.node(id);
  ++statistics_.high_level_generated;
  open_.push_back({node.cost, node.conflict_count, node.turns, id});
  std::push_heap(open_.begin(), open_.end(), is_worse);
}

NodeId CbsSearch::pop() {
  std::pop_heap(open_.begin(), open_.end(), is_worse);
  const NodeId id = open_.back().node;
  open_.pop_back();
  return id;
}

CbsStatistics CbsSearch::statistics() const {
  CbsStatistics statistics = statistics_;
  statistics.low_level_expanded = low_level_.expanded();
  return statistics;
}

}  // namespace dmrp::planners
