// SPDX-License-Identifier: MIT
#include "search.hpp"

#include <algorithm>
#include <tuple>

#include "../mapf/solvability.hpp"

namespace dmrp::planners::ecbs8 {

namespace {

// A problem that is still unsolved after so many expansions is worth a proof that it has no plan ...
constexpr std::int64_t expansions_before_proof = 1000;
// ... if that visits at most so many joint positions.
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
      occupied_(problem.graph, problem.agents.size()),
      low_level_(problem.graph),
      constraint_table_(problem.graph) {}

Search::Result Search::run() {
  if (!plan_root()) return Result::stopped;
  for (;;) {
    const NodeId best = choose();
    if (best < 0) return obstruction_ = "every way to resolve the robots' conflicts was tried", Result::unsolvable;
    if (expand(best)) return Result::solved;
    if (stop_.poll_now()) return Result::stopped;
    if (statistics_.high_level_generated >= node_limit_) return Result::node_limit;
    if (statistics_.high_level_expanded != expansions_before_proof) continue;
    const auto found = find_joint_obstruction(problem_, joint_state_limit, stop_);
    if (stop_.raised()) return Result::stopped;
    if (found) return obstruction_ = *found, Result::unsolvable;
  }
}

// Each agent's path in turn, with few conflicts with those before it, which also leave it what they did not use of
// their limits.
bool Search::plan_root() {
  constraint_table_.fill({});
  Node root;
  std::vector<BoundedPath> paths(problem_.agents.size());
  std::vector<Conflict> conflicts;
  std::vector<AgentPath> agent_paths;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const auto agent = static_cast<std::int32_t>(i);
    const CostLimit limit{suboptimality_, root.lower_bound, root.cost};
    const auto result =
        low_level_.search(problem_.agents[i], distances_[i], constraint_table_, occupied_, 0, limit, stop_, paths[i]);
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

// The node of FOCAL with fewest conflicts, or -1 if there is none left. Raises the lower bound.
NodeId Search::choose() {
  while (!open_.empty() && is_closed_[static_cast<std::size_t>(open_.front().node)]) {
    std::pop_heap(open_.begin(), open_.end(), IsWorse{});
    open_.pop_back();
  }
  if (open_.empty()) return -1;
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

// Splits the node on a conflict. True if it has none: its paths are the solution.
//
// Bypass (Boyarski et al. 2015): where a child's paths keep to the limit of all plans and fewer robots conflict, they take
// the place of those in the node, without the constraint, and nothing is split.
bool Search::expand(NodeId id) {
  ++statistics_.high_level_expanded;
  for (;;) {
    enter(id);
    if (conflicts_.empty()) return cost_ = tree_.node(id).cost, true;
    const std::array<Side, 2> sides = split(choose_conflict());
    std::array<bool, 2> has_paths{};
    const Child* bypass = nullptr;
    for (std::size_t i = 0; i < 2 && !bypass; ++i) {
      has_paths[i] = make_child(id, sides[i], children_[i]);
      const Node& child = children_[i].node;
      if (has_paths[i] && child.conflicting_pairs < tree_.node(id).conflicting_pairs &&
          child.cost <= suboptimality_.limit(statistics_.lower_bound))
        bypass = &children_[i];
    }
    if (stop_.poll_now()) return false;
    if (bypass) {
      id = add_without_constraint(*bypass, id);
      continue;
    }
    for (std::size_t i = 0; i < 2; ++i)
      if (has_paths[i]) push(add(children_[i]));
    return false;
  }
}

void Search::enter(NodeId id) {
  tree_.gather_paths(id, paths_);
  for (const AgentPath& path : paths_) occupied_.set(path.agent, path.locations);
  tree_.gather_conflicts(id, conflicts_);
}

// The earliest.
const Conflict& Search::choose_conflict() const {
  const auto order = [this](std::uint32_t index) {
    const Conflict& c = tree_.conflict(index);
    return std::tuple(c.t, c.a, c.b, c.location);
  };
  return tree_.conflict(
      *std::min_element(conflicts_.begin(), conflicts_.end(),
                        [&](std::uint32_t left, std::uint32_t right) { return order(left) < order(right); }));
}

// No plan does what both sides forbid, as every use that one side names rules out every use that the other one does.
//
// Whoever stands somewhere rules out others there and diagonals beside it that begin or end then; so one agent is
// forbidden to be there, the other one to touch the place. If the first one rests there for good (target reasoning,
// Li et al. 2021), either it comes to rest later than that, or the other one does not touch the place from then on.
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

// False if there are no paths under the constraint (or the search was stopped).
bool Search::make_child(NodeId parent, const Side& side, Child& child) {
  child.node = tree_.node(parent);
  child.node.parent = parent;
  child.node.constrained_agent = side.agent;
  child.node.constraint = side.constraint;
  child.paths.clear();
  child.conflicts.clear();
  const bool has_paths = replan(parent, side.agent, &side.constraint, true, child) && keep_within_limit(parent, child);
  occupied_.set(side.agent, paths_[static_cast<std::size_t>(side.agent)].locations);
  for (const Replanned& replanned : child.paths)
    occupied_.set(replanned.agent, paths_[static_cast<std::size_t>(replanned.agent)].locations);
  if (has_paths) count_pairs(child);
  return has_paths;
}

// A path for the agent under its constraints in the parent and an added one, and who conflicts with it. Leaves the path
// in occupied_. With `share_slack` it may use what the others leave of the limit.
bool Search::replan(NodeId parent, std::int32_t agent, const Constraint* added, bool share_slack, Child& child) {
  const auto who = static_cast<std::size_t>(agent);
  const AgentPath& before = paths_[who];
  tree_.gather_constraints(parent, agent, constraints_);
  if (added) constraints_.push_back(*added);
  constraint_table_.fill(constraints_);

  const Cost others_bound = child.node.lower_bound - before.lower_bound;
  const Cost others_cost = child.node.cost - before.cost;
  const CostLimit limit{suboptimality_, share_slack ? others_bound : 0, share_slack ? others_cost : 0};
  BoundedPath path;
  occupied_.set(agent, {});
  if (low_level_.search(problem_.agents[who], distances_[who], constraint_table_, occupied_, before.lower_bound, limit,
                        stop_, path) != FocalSearch::Result::found)
    return false;
  std::erase_if(child.conflicts, [agent](const Conflict& conflict) { return involves(conflict, agent); });
  occupied_.list(agent, path.locations, child.conflicts);
  occupied_.set(agent, path.locations);
  child.node.cost = others_cost + path.cost;
  child.node.lower_bound = others_bound + path.lower_bound;
  child.node.turns += count_turns(problem_.graph, path.locations) - count_turns(problem_.graph, before.locations);
  child.paths.push_back({agent, std::move(path)});
  return true;
}

// Agents that use more than their own limit may have to give it back: the dearest first.
bool Search::keep_within_limit(NodeId parent, Child& child) {
  while (child.node.cost > suboptimality_.limit(child.node.lower_bound)) {
    const AgentPath* dearest = nullptr;
    Cost most = 0;
    for (const AgentPath& path : paths_) {
      const Cost excess = path.cost - suboptimality_.limit(path.lower_bound);
      const bool is_replanned = std::any_of(child.paths.begin(), child.paths.end(),
                                            [&](const Replanned& replanned) { return replanned.agent == path.agent; });
      if (excess <= most || is_replanned) continue;
      most = excess;
      dearest = &path;
    }
    if (!dearest) return true;
    if (!replan(parent, dearest->agent, nullptr, false, child)) return false;
  }
  return true;
}

void Search::count_pairs(Child& child) const {
  child.node.conflicting_pairs = 0;
  for (const Conflict& conflict : child.conflicts) child.node.conflicting_pairs += conflict.is_first ? 1 : 0;
  for (const std::uint32_t index : conflicts_) {
    const Conflict& conflict = tree_.conflict(index);
    const bool stays = conflict.is_first && std::none_of(child.paths.begin(), child.paths.end(), [&](const auto& path) {
                         return involves(conflict, path.agent);
                       });
    child.node.conflicting_pairs += stays ? 1 : 0;
  }
}

NodeId Search::add(const Child& child) {
  std::vector<AgentPath> paths;
  for (const Replanned& replanned : child.paths)
    paths.push_back({replanned.agent, replanned.path.locations, replanned.path.cost, replanned.path.lower_bound});
  return tree_.add(child.node, paths, child.conflicts);
}

// Lower bounds that the constraint raised hold no longer.
NodeId Search::add_without_constraint(const Child& child, NodeId parent) {
  Node node = child.node;
  node.constrained_agent = -1;
  node.lower_bound = tree_.node(parent).lower_bound;
  std::vector<AgentPath> paths;
  for (const Replanned& replanned : child.paths)
    paths.push_back({replanned.agent, replanned.path.locations, replanned.path.cost,
                     paths_[static_cast<std::size_t>(replanned.agent)].lower_bound});
  return tree_.add(node, paths, child.conflicts);
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
