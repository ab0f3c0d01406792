// SPDX-License-Identifier: MIT
#include "planners/large_agents/conflict_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dmrp::planners {

namespace {

// Of a split on whose side an agent has no path.
constexpr std::int32_t impossible_rise = 1'000'000;

// A pair is solved as a pair after so many splits, by a search of at most so many nodes.
constexpr std::int32_t splits_of_a_pair = 8;
constexpr std::size_t pair_nodes = 300'000;

// Whether the paths of a child prove no more than those of its parent, so that they may stand for them without its bans.
template <class Node>
bool has_bounds_of(const Node& child, const Node& parent) {
  return std::equal(child.paths.begin(), child.paths.end(), parent.paths.begin(),
                    [](const auto& one, const auto& two) { return one->lower_bound == two->lower_bound; });
}

}  // namespace

LargeAgentSearch::LargeAgentSearch(const PreparedFleet& prepared, double suboptimality, std::int64_t node_limit,
                                   StopSignal& stop)
    : prepared_(prepared),
      fleet_(prepared.fleet),
      suboptimality_(suboptimality),
      node_limit_(node_limit),
      stop_(stop),
      low_level_(fleet_),
      pair_search_(fleet_),
      table_(fleet_),
      splits_(prepared.fleet.agents.size() * prepared.fleet.agents.size(), 0) {}

LargeAgentSearch::Result LargeAgentSearch::run() {
  bound_ = static_cast<std::int64_t>(prepared_.lower_bound());
  if (!make_root()) return Result::stopped;
  while (!open_.empty()) {
    if (stop_.poll_now()) return Result::stopped;
    advance();
    const NodeId best = std::get<2>(*focal_.begin());
    if (nodes_[static_cast<std::size_t>(best)].conflicts.empty()) {
      solved_ = best;
      return Result::solved;
    }
    if (generated() >= node_limit_) return Result::node_limit;
    if (suboptimality_ == 1 && !nodes_[static_cast<std::size_t>(best)].looked_ahead && look_ahead(best)) continue;
    expand(best);
  }
  return stop_.raised() ? Result::stopped : Result::unsolvable;
}

std::vector<PathView> LargeAgentSearch::solution() const {
  std::vector<PathView> paths;
  for (const Path& path : nodes_[static_cast<std::size_t>(solved_)].paths) paths.emplace_back(path->locations);
  return paths;
}

// Plans the agents one after the other, each with few conflicts with those before.
bool LargeAgentSearch::make_root() {
  Node root;
  root.paths.resize(fleet_.agents.size());
  bans_.clear();
  for (AgentIndex agent = 0; agent < fleet_.size(); ++agent)
    if (!replan(root, agent)) return false;
  for (AgentIndex a = 0; a < fleet_.size(); ++a)
    for (AgentIndex b = a + 1; b < fleet_.size(); ++b)
      if (const auto conflict = find_conflict(root, a, b)) root.conflicts.push_back(*conflict);
  insert(std::move(root));
  return true;
}

// Raises the bound to the least one of an open node and fills FOCAL.
void LargeAgentSearch::advance() {
  bound_ = std::max(bound_, open_.begin()->first);
  const auto most = static_cast<std::int64_t>(std::floor(suboptimality_ * static_cast<double>(bound_) + 1e-9));
  while (!beyond_.empty() && beyond_.begin()->first <= most) {
    const auto [dearness, id] = *beyond_.begin();
    focal_.emplace(nodes_[static_cast<std::size_t>(id)].conflicts.size(), dearness, id);
    beyond_.erase(beyond_.begin());
  }
}

// Finds out what the splits of the first of FOCAL cost. True if its bound rises: it is back in the queues then.
bool LargeAgentSearch::look_ahead(NodeId id) {
  Node& node = nodes_[static_cast<std::size_t>(id)];
  node.looked_ahead = true;
  for (Conflict& conflict : node.conflicts) {
    if (conflict.rise >= 0) continue;  // known from an ancestor with the same two paths
    const std::vector<Split> splits = splits_of(node, conflict);
    for (std::size_t i = 0; i < splits.size() && !stop_.raised(); ++i) {
      const std::int32_t first = rise_of(node, splits[i].first);
      const std::int32_t second = rise_of(node, splits[i].second);
      const auto [least, greatest] = std::minmax({first, second});
      if (std::pair(least, greatest) <= std::pair(conflict.rise, conflict.greatest)) continue;
      conflict.rise = least;
      conflict.greatest = greatest;
      conflict.best_split = i;
    }
  }
  return raise_bound(id);
}

// Adds up the rises of pairs without a common agent, the greatest ones first. True if that raises the bound of the first
// of FOCAL: it is back in the queues then.
bool LargeAgentSearch::raise_bound(NodeId id) {
  Node& node = nodes_[static_cast<std::size_t>(id)];
  std::vector<const Conflict*> by_rise;
  for (const Conflict& conflict : node.conflicts) by_rise.push_back(&conflict);
  std::stable_sort(by_rise.begin(), by_rise.end(),
                   [](const Conflict* one, const Conflict* two) { return one->rise > two->rise; });
  std::vector<bool> is_taken(node.paths.size(), false);
  std::int64_t bound = 0;
  for (const Path& path : node.paths) bound += path->lower_bound;
  for (const Conflict* conflict : by_rise) {
    const auto a = static_cast<std::size_t>(conflict->a);
    const auto b = static_cast<std::size_t>(conflict->b);
    if (conflict->rise <= 0 || is_taken[a] || is_taken[b]) continue;
    is_taken[a] = is_taken[b] = true;
    bound += conflict->rise;
  }
  if (bound <= node.bound) return false;
  open_.erase({node.bound, id});
  focal_.erase(focal_.begin());
  node.bound = bound;
  open_.emplace(node.bound, id);
  beyond_.emplace(node.dearness(), id);
  return true;
}

void LargeAgentSearch::expand(NodeId id) {
  ++expanded_;
  Node& node = nodes_[static_cast<std::size_t>(id)];
  Conflict& conflict = choose(node);
  if (suboptimality_ == 1 && !conflict.path_a &&
      ++splits_[static_cast<std::size_t>(conflict.a) * node.paths.size() + static_cast<std::size_t>(conflict.b)] >
          splits_of_a_pair) {
    solve_pair(node, conflict);
    if (raise_bound(id)) return;
  }
  open_.erase({node.bound, id});
  focal_.erase(focal_.begin());
  if (auto solved = with_pair(node, conflict)) {
    insert(std::move(*solved));
    return;
  }
  const Split split = splits_of(node, conflict)[conflict.best_split];
  std::optional<Node> children[2] = {make_child(id, split.first.bans), make_child(id, split.second.bans)};
  if (suboptimality_ == 1)
    for (std::optional<Node>& child : children)
      if (child && has_bounds_of(*child, node) && child->conflicts.size() < node.conflicts.size()) {
        child->parent = node.parent;
        child->bans = node.bans;
        insert(std::move(*child));
        return;
      }
  for (std::optional<Node>& child : children)
    if (child) insert(std::move(*child));
}

// Finds what the two agents cost at least under the node's bans, and paths that cost so much.
void LargeAgentSearch::solve_pair(const Node& node, Conflict& conflict) {
  gather_bans(node);
  BanTable bans_a(fleet_);
  BanTable bans_b(fleet_);
  bans_a.fill(conflict.a, bans_);
  bans_b.fill(conflict.b, bans_);
  const auto a = static_cast<std::size_t>(conflict.a);
  const auto b = static_cast<std::size_t>(conflict.b);
  std::array<std::vector<Location>, 2> paths;
  const PairSearch::Result result = pair_search_.search(
      {conflict.a, prepared_.tables[a], bans_a}, {conflict.b, prepared_.tables[b], bans_b}, pair_nodes, stop_, paths);
  const std::int32_t bound_a = node.paths[a]->lower_bound;
  const std::int32_t bound_b = node.paths[b]->lower_bound;
  if (result == PairSearch::Result::none) conflict.rise = impossible_rise;
  if (result != PairSearch::Result::found) return;
  conflict.rise = std::max(conflict.rise, cost_of(paths[0]) + cost_of(paths[1]) - bound_a - bound_b);
  conflict.path_a = std::make_shared<const SinglePath>(SinglePath{std::move(paths[0]), bound_a});
  conflict.path_b = std::make_shared<const SinglePath>(SinglePath{std::move(paths[1]), bound_b});
}

// The node with the cheapest pair of paths for the two agents, if these are known, it has fewer conflicts then, and it
// costs no more than its bound: FOCAL of an optimal search has only nodes that do not.
std::optional<LargeAgentSearch::Node> LargeAgentSearch::with_pair(const Node& node, const Conflict& conflict) const {
  if (!conflict.path_a) return std::nullopt;
  Node solved;
  solved.parent = node.parent;
  solved.bans = node.bans;
  solved.paths = node.paths;
  solved.bound = node.bound;
  std::vector<bool> is_new(node.paths.size(), false);
  for (const auto& [agent, path] : {std::pair(conflict.a, conflict.path_a), std::pair(conflict.b, conflict.path_b)}) {
    solved.paths[static_cast<std::size_t>(agent)] = path;
    is_new[static_cast<std::size_t>(agent)] = true;
  }
  for (const Path& path : solved.paths) solved.cost += cost_of(path->locations);
  if (solved.cost > solved.bound) return std::nullopt;
  find_conflicts(solved, node.conflicts, is_new);
  return solved.conflicts.size() < node.conflicts.size() ? std::optional(std::move(solved)) : std::nullopt;
}

std::vector<LargeAgentSearch::Split> LargeAgentSearch::splits_of(const Node& node, const Conflict& conflict) const {
  // an agent that rests: it comes to rest later, or the others keep away for good
  for (const auto& [resting, passing] : {std::pair(conflict.a, conflict.b), std::pair(conflict.b, conflict.a)}) {
    // it must have rested during a whole step if the other one touches it on its way
    const std::int32_t t = conflict.clash == Clash::at_end ? conflict.t : conflict.t - 1;
    if (rests_from(node, resting) > t) continue;
    const Location goal = fleet_.agents[static_cast<std::size_t>(resting)].last_goal();
    const Ban early{Ban::Kind::finish_by, resting, -1, nowhere, goal, t};
    const Ban late{Ban::Kind::finish_after, resting, -1, nowhere, goal, t};
    const Ban keep_away{Ban::Kind::rest_near, -1, resting, nowhere, goal, t};
    return {Split{{resting, {early}}, {passing, {late, keep_away}}}};
  }
  const bool at_end = conflict.clash == Clash::at_end;
  const Ban::Kind own = at_end ? Ban::Kind::place : Ban::Kind::step;
  const Ban::Kind near = at_end ? Ban::Kind::places_near : Ban::Kind::steps_near;
  std::vector<Split> splits;
  for (const auto& [one, other] : {std::pair(conflict.a, conflict.b), std::pair(conflict.b, conflict.a)}) {
    const std::vector<Location>& path = node.paths[static_cast<std::size_t>(one)]->locations;
    const Location from = location_at(path, conflict.t - 1);
    const Location to = location_at(path, conflict.t);
    const Ban here{own, one, -1, from, to, conflict.t};
    const Ban around{near, other, one, from, to, conflict.t};
    splits.push_back({{one, {here}}, {other, {around}}});
  }
  return splits;
}

// By how much the cost of the side's agent rises at least.
std::int32_t LargeAgentSearch::rise_of(const Node& node, const Side& side) {
  const auto index = static_cast<std::size_t>(side.agent);
  gather_bans(node);
  bans_.insert(bans_.end(), side.bans.begin(), side.bans.end());
  table_.fill(side.agent, bans_);
  const std::vector<PathView> nobody(node.paths.size());
  const std::int32_t known = node.paths[index]->lower_bound;
  SinglePath path;
  const SingleRequest request{side.agent, prepared_.tables[index], table_, nobody, 1, known};
  switch (low_level_.search(request, stop_, path)) {
    case SingleSearch::Result::found:
      return path.lower_bound - known;
    case SingleSearch::Result::none:
      return impossible_rise;
    case SingleSearch::Result::stopped:
      return 0;
  }
  return 0;
}

// The conflict whose split raises the cost most, as far as that is known. Otherwise an agent at rest in another's way
// first, because its split raises the cost most; then the earliest conflict.
LargeAgentSearch::Conflict& LargeAgentSearch::choose(Node& node) const {
  const auto rank = [&](const Conflict& conflict) {
    const bool rests = std::min(rests_from(node, conflict.a), rests_from(node, conflict.b)) < conflict.t;
    return std::tuple(-conflict.rise, -conflict.greatest, rests ? 0 : 1, conflict.t, conflict.a, conflict.b);
  };
  return *std::min_element(node.conflicts.begin(), node.conflicts.end(),
                           [&](const Conflict& one, const Conflict& two) { return rank(one) < rank(two); });
}

// Nothing if an agent has no path under the bans, or after a stop.
std::optional<LargeAgentSearch::Node> LargeAgentSearch::make_child(NodeId parent, std::vector<Ban> bans) {
  if (stop_.raised()) return std::nullopt;
  const Node& above = nodes_[static_cast<std::size_t>(parent)];
  Node child;
  child.parent = parent;
  child.bans = std::move(bans);
  child.paths = above.paths;
  child.bound = above.bound;
  gather_bans(child);
  std::vector<bool> is_new(child.paths.size(), false);
  for (AgentIndex agent = 0; agent < fleet_.size(); ++agent) {
    const SinglePath& path = *child.paths[static_cast<std::size_t>(agent)];
    const bool is_of_pair = suboptimality_ == 1 && cost_of(path.locations) > path.lower_bound;
    if (!is_of_pair && obeys(child, agent)) continue;
    if (!replan(child, agent)) return std::nullopt;
    is_new[static_cast<std::size_t>(agent)] = true;
  }
  find_conflicts(child, above.conflicts, is_new);
  for (Conflict& conflict : child.conflicts)
    if (std::any_of(child.bans.begin(), child.bans.end(),
                    [&](const Ban& ban) { return ban.binds(conflict.a) || ban.binds(conflict.b); }))
      conflict.path_a = conflict.path_b = nullptr;  // they may break the new bans
  for (const Path& path : child.paths) child.cost += cost_of(path->locations);
  return child;
}

// Of the conflicts before, those of agents without a new path stay.
void LargeAgentSearch::find_conflicts(Node& node, const std::vector<Conflict>& before,
                                      const std::vector<bool>& is_new) const {
  const auto changed = [&](AgentIndex agent) { return is_new[static_cast<std::size_t>(agent)]; };
  for (const Conflict& conflict : before)
    if (!changed(conflict.a) && !changed(conflict.b)) node.conflicts.push_back(conflict);
  for (AgentIndex a = 0; a < fleet_.size(); ++a)
    for (AgentIndex b = a + 1; b < fleet_.size(); ++b)
      if (changed(a) || changed(b))
        if (const auto conflict = find_conflict(node, a, b)) node.conflicts.push_back(*conflict);
}

void LargeAgentSearch::insert(Node node) {
  std::int64_t bound = 0;
  node.cost = 0;
  for (const Path& path : node.paths) {
    bound += path->lower_bound;
    node.cost += cost_of(path->locations);
  }
  node.bound = std::max(node.bound, bound);
  const auto id = static_cast<NodeId>(nodes_.size());
  open_.emplace(node.bound, id);
  beyond_.emplace(node.dearness(), id);
  nodes_.push_back(std::move(node));
}

// The bans of a node and its ancestors.
void LargeAgentSearch::gather_bans(const Node& node) {
  bans_ = node.bans;
  for (NodeId id = node.parent; id >= 0; id = nodes_[static_cast<std::size_t>(id)].parent) {
    const std::vector<Ban>& above = nodes_[static_cast<std::size_t>(id)].bans;
    bans_.insert(bans_.end(), above.begin(), above.end());
  }
}

// Whether the agent's path obeys the node's own bans.
bool LargeAgentSearch::obeys(const Node& node, AgentIndex agent) const {
  const std::vector<Location>& path = node.paths[static_cast<std::size_t>(agent)]->locations;
  BanTable table(fleet_);
  table.fill(agent, node.bans);
  const std::int32_t end = cost_of(path);
  if (end < table.finish_from() || end > table.finish_until()) return false;
  for (std::int32_t t = 0; t <= end; ++t)
    if (!table.allows(location_at(path, std::max(t - 1, 0)), location_at(path, t), t)) return false;
  return true;
}

// False if there is no path, or after a stop.
bool LargeAgentSearch::replan(Node& node, AgentIndex agent) {
  const auto index = static_cast<std::size_t>(agent);
  std::vector<PathView> others;
  for (const Path& path : node.paths) others.emplace_back(path ? PathView(path->locations) : PathView());
  others[index] = {};
  table_.fill(agent, bans_);
  const std::int32_t known = node.paths[index] ? node.paths[index]->lower_bound : 0;
  auto path = std::make_shared<SinglePath>();
  const SingleRequest request{agent, prepared_.tables[index], table_, others, suboptimality_, known};
  if (low_level_.search(request, stop_, *path) != SingleSearch::Result::found) return false;
  node.paths[index] = std::move(path);
  return true;
}

std::optional<LargeAgentSearch::Conflict> LargeAgentSearch::find_conflict(const Node& node, AgentIndex a,
                                                                          AgentIndex b) const {
  const std::vector<Location>& path_a = node.paths[static_cast<std::size_t>(a)]->locations;
  const std::vector<Location>& path_b = node.paths[static_cast<std::size_t>(b)]->locations;
  const std::int32_t end = std::max(cost_of(path_a), cost_of(path_b));
  for (std::int32_t t = 1; t <= end; ++t) {
    const Clash clash = fleet_.clash(a, location_at(path_a, t - 1), location_at(path_a, t), b,
                                     location_at(path_b, t - 1), location_at(path_b, t));
    if (clash != Clash::none) return Conflict{a, b, clash, t, -1, 0, 0, {}, {}};
  }
  return std::nullopt;
}

std::int32_t LargeAgentSearch::rests_from(const Node& node, AgentIndex agent) const {
  return cost_of(node.paths[static_cast<std::size_t>(agent)]->locations);
}

}  // namespace dmrp::planners
