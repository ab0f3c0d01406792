// SPDX-License-Identifier: MIT
#include "planners/conflict_search/high_level/search.hpp"

#include <algorithm>
#include <dmrp/toolkit/random.hpp>

#include "planners/mapf/solvability.hpp"

namespace dmrp::planners {

namespace {

// The first search takes conflicts before steps, which finds what is easy soonest; it gets this part of a restart.
constexpr std::int64_t first_share = 4;

// A problem that is still unsolved after so many expansions is worth a proof that it has no plan ...
constexpr std::int64_t expansions_before_proof = 1000;
// ... if that visits at most so many joint positions.
constexpr std::size_t joint_state_limit = 300'000;

// Two agents are searched for their least joint cost with so many nodes at most.
constexpr std::int64_t pair_node_limit = 10;

// The cost of a pair without any solution.
constexpr std::int32_t no_solution = 1 << 24;

// What the agents' paths will hardly exceed.
std::int32_t expected_steps(const Problem& problem, const std::vector<TourTable>& tables) {
  std::int32_t longest = 0;
  for (std::size_t i = 0; i < tables.size(); ++i)
    longest = std::max(longest, tables[i].distance(0, problem.agents[i].start));
  return longest + longest / 4;
}

}  // namespace

ConflictSearch::ConflictSearch(const Problem& problem, const std::vector<TourTable>& tables,
                               CorridorReasoning& corridors, MddCache& mdds, const ConflictSearchOptions& options,
                               StopSignal& stop)
    : problem_(problem),
      tables_(tables),
      corridors_(corridors),
      mdds_(mdds),
      options_(options),
      stop_(stop),
      queue_(tree_, options.selection, options.suboptimality),
      safe_interval_search_(problem.graph),
      space_time_search_(problem.graph),
      paths_(problem.agents.size()),
      occupied_(problem.graph, problem.agents.size(), expected_steps(problem, tables)),
      signatures_(problem.agents.size()),
      node_mdds_(problem.agents.size()),
      constraint_table_(problem.graph) {}

ConflictSearch::~ConflictSearch() = default;

ConflictSearchStatistics ConflictSearch::statistics() const {
  ConflictSearchStatistics out = statistics_;
  out.lower_bound = queue_.lower_bound();
  out.low_level_expanded = safe_interval_search_.expanded() + space_time_search_.expanded();
  if (pair_search_) out.low_level_expanded += pair_search_->statistics().low_level_expanded;
  return out;
}

ConflictSearch::Result ConflictSearch::run(std::vector<std::int32_t> members, std::vector<Constraint> constraints) {
  for (const std::int32_t agent : members_) occupied_.set(agent, {});
  members_ = std::move(members);
  std::vector<std::int32_t> order = members_;
  std::int64_t nodes_left = options_.node_limit;
  std::int64_t nodes_of_restart = options_.restart_after;
  lower_bound_ = 0;
  expansions_of_run_ = 0;
  for (std::int32_t restart = 0;; ++restart) {
    std::int64_t nodes = nodes_left;
    if (options_.restart_after > 0) {
      nodes = std::min(nodes, restart == 0 ? nodes_of_restart / first_share + 1 : nodes_of_restart);
      if (restart > 0) nodes_of_restart += nodes_of_restart / 2 + 1;
    }
    conflict_steps_ = restart == 0 ? 0 : options_.conflict_steps;
    const Result result = search_from(order, constraints, nodes);
    lower_bound_ = queue_.lower_bound();
    nodes_left -= nodes;
    if (result != Result::node_limit || nodes_left <= 0) return result;
    for (const std::int32_t agent : members_) occupied_.set(agent, {});
    toolkit::Stream stream(options_.seed, "restart", restart);
    stream.shuffle(order);
  }
}

// One search, the agents' first paths planned in the order given.
ConflictSearch::Result ConflictSearch::search_from(const std::vector<std::int32_t>& order,
                                                   const std::vector<Constraint>& constraints,
                                                   std::int64_t node_limit) {
  tree_.reset(problem_.agents.size(), members_);
  queue_.reset(lower_bound_);
  entered_ = no_node;
  if (!plan_root(order, constraints)) return stop_.raised() ? Result::stopped : Result::unsolvable;
  for (;;) {
    const NodeQueue::Choice choice = queue_.pop();
    if (choice.node == no_node) {
      obstruction_ = "every way to resolve the robots' conflicts was tried";
      return Result::unsolvable;
    }
    enter(choice.node);
    if (pairs_.empty()) return Result::solved;
    if (choice.for_its_bound && options_.dependency_graph && !tree_.node(choice.node).is_informed &&
        !inform(choice.node))
      continue;
    expand(choice.node);
    if (stop_.poll_now()) return Result::stopped;
    if (++expansions_of_run_ == expansions_before_proof) {
      const auto found = find_joint_obstruction(problem_, joint_state_limit, stop_);
      if (stop_.raised()) return Result::stopped;
      if (found) return obstruction_ = *found, Result::unsolvable;
    }
    if (tree_.node_count() >= node_limit) {
      queue_.raise_bound();
      return Result::node_limit;
    }
  }
}

// Each agent's path by itself, with few conflicts with the agents before it.
bool ConflictSearch::plan_root(const std::vector<std::int32_t>& order, const std::vector<Constraint>& constraints) {
  Child& root = children_[0];
  root.node = {};
  root.constraints = constraints;
  root.paths.clear();
  root.conflicts.clear();
  root.conflicting_pairs = 0;
  for (const std::int32_t agent : order)
    if (!replan(no_node, agent, root)) return false;
  for (const std::int32_t agent : members_) occupied_.set(agent, {});
  push(add(root, no_node, true));
  return true;
}

void ConflictSearch::enter(NodeId id) {
  if (entered_ == id) return;
  entered_ = id;
  mdds_.trim();
  tree_.gather_signatures(id, signatures_);
  tree_.gather_paths(id, paths_);
  for (const std::int32_t agent : members_) occupied_.set(agent, path_of(agent).locations);
  tree_.gather_conflicts(id, conflicts_);
  pairs_.clear();
  for (const std::uint32_t index : conflicts_) {
    const Conflict& conflict = tree_.conflict(index).conflict;
    if (const Pair pair(conflict.a, conflict.b); pairs_.empty() || pairs_.back() != pair) pairs_.push_back(pair);
  }
}

// Raises the node's bound by what its agents' true least costs and the pairs that depend on each other add. False if
// the node is no longer the one to expand: it is back in the queue, or there is nothing below it.
bool ConflictSearch::inform(NodeId id) {
  std::int32_t raise = 0;
  std::vector<bool> is_counted(problem_.agents.size(), false);
  for (const auto& [a, b] : pairs_)
    for (const std::int32_t agent : {a, b}) {
      if (is_counted[static_cast<std::size_t>(agent)]) continue;
      is_counted[static_cast<std::size_t>(agent)] = true;
      const Mdd* const mdd = mdd_of(agent);
      if (!mdd || stop_.poll_now()) return true;  // stopped
      raise += mdd->cost() - path_of(agent).lower_bound;
    }
  std::vector<DependentPair> dependent;
  for (const Pair& pair : pairs_) {
    const std::int32_t weight = pair_weight(pair);
    if (stop_.poll_now()) return true;
    if (weight >= no_solution) return false;
    if (weight > 0) dependent.push_back({pair.first, pair.second, weight});
  }
  const std::int32_t cover = least_edge_weighted_cover(dependent, stop_);
  if (stop_.raised()) return true;
  Node& node = tree_.node(id);
  node.is_informed = true;
  const std::int32_t informed = node.lower_bound + raise + cover;
  if (informed <= node.f) return true;
  node.f = informed;
  node.estimated_cost = std::max(node.estimated_cost, static_cast<double>(node.f));
  if (node.f <= queue_.lower_bound()) return true;
  queue_.push(id);
  return false;
}

// Splits the node on a conflict, or finds that a child's path helps without one.
void ConflictSearch::expand(NodeId id) {
  ++statistics_.high_level_expanded;
  for (;;) {
    enter(id);
    if (options_.replan_in_place) id = replan_in_place(id);
    if (pairs_.empty()) break;
    const Split split = split_on(tree_.conflict(choose_conflict()));
    std::array<bool, 2> has_paths{};
    Child* bypass = nullptr;
    for (std::size_t i = 0; i < 2 && !bypass; ++i) {
      has_paths[i] = make_child(id, split[i], children_[i]);
      if (has_paths[i] && options_.bypass && is_bypass(id, children_[i])) bypass = &children_[i];
    }
    if (stop_.raised()) return;
    if (bypass) {
      id = add(*bypass, id, false);
      continue;
    }
    std::vector<const Node*> nodes;
    for (std::size_t i = 0; i < 2; ++i)
      if (has_paths[i]) nodes.push_back(&children_[i].node);
    note_errors(tree_.node(id), nodes);
    for (std::size_t i = 0; i < 2; ++i)
      if (has_paths[i]) push(add(children_[i], id, true));
    return;
  }
  queue_.push(id);  // the last bypass or replanning left no conflict
}

// Replans agents, one after the other, as long as that leaves fewer pairs in conflict (or as many at less cost): at the
// root all that are in conflict, elsewhere those of the conflict to split on; then those that they meet. No constraint
// is needed for that, so the node that results may take the place of the one given.
NodeId ConflictSearch::replan_in_place(NodeId id) {
  std::vector<std::int32_t> agents;
  if (tree_.node(id).parent == no_node) {
    for (const auto& [a, b] : pairs_) agents.insert(agents.end(), {a, b});
  } else {
    const Conflict& conflict = tree_.conflict(choose_conflict()).conflict;
    agents = {conflict.a, conflict.b};
  }
  const std::size_t most = 10 * members_.size();
  std::vector<bool> is_due(problem_.agents.size(), false);
  for (const std::int32_t agent : agents) is_due[static_cast<std::size_t>(agent)] = true;
  const auto add_met_by = [&](std::int32_t agent) {
    for (const auto& [a, b] : pairs_) {
      if (a != agent && b != agent) continue;
      const std::int32_t other = a == agent ? b : a;
      if (!is_due[static_cast<std::size_t>(other)] && agents.size() < most) agents.push_back(other);
      is_due[static_cast<std::size_t>(other)] = true;
    }
  };
  Child& child = children_[0];
  for (std::size_t i = 0; i < agents.size() && !pairs_.empty(); ++i) {
    const std::int32_t agent = agents[i];
    if (!is_due[static_cast<std::size_t>(agent)]) continue;
    is_due[static_cast<std::size_t>(agent)] = false;
    if (!replan_all(id, {agent}, {}, child)) return id;  // stopped
    const Node& node = tree_.node(id);
    if (std::pair(child.node.pairs, child.node.cost) >= std::pair(node.pairs, node.cost)) continue;
    add_met_by(agent);
    id = add(child, id, true);
    enter(id);
    add_met_by(agent);
  }
  return id;
}

// Null if the search was stopped.
const Mdd* ConflictSearch::mdd_of(std::int32_t agent) {
  const std::uint64_t signature = signatures_[static_cast<std::size_t>(agent)];
  NodeMdd& known = node_mdds_[static_cast<std::size_t>(agent)];
  if (!known.mdd || known.signature != signature) {
    tree_.gather_constraints(entered_, agent, constraints_);
    known = {signature, mdds_.get(agent, constraints_, path_of(agent).lower_bound)};
  }
  return known.mdd.get();
}

// False if an agent has no path under the constraints (or the search was stopped).
bool ConflictSearch::make_child(NodeId parent, const std::vector<Constraint>& constraints, Child& child) {
  std::vector<std::int32_t> agents;
  for (const Constraint& c : constraints)
    for (const std::int32_t agent : members_) {
      if (agent != c.agent && !c.binds_others()) continue;
      if (satisfies(path_of(agent).locations, agent == c.agent ? c : c.for_another(agent))) continue;
      if (std::find(agents.begin(), agents.end(), agent) == agents.end()) agents.push_back(agent);
    }
  return replan_all(parent, agents, constraints, child);
}

// A child with other paths for some agents.
bool ConflictSearch::replan_all(NodeId parent, const std::vector<std::int32_t>& agents,
                                const std::vector<Constraint>& constraints, Child& child) {
  child.node = tree_.node(parent);
  child.node.is_informed = false;
  child.constraints = constraints;
  child.paths.clear();
  child.conflicts.clear();
  child.conflicting_pairs = 0;

  for (const std::int32_t agent : agents) occupied_.set(agent, {});
  bool has_paths = true;
  for (const std::int32_t agent : agents)
    if (has_paths) has_paths = replan(parent, agent, child);
  for (const std::int32_t agent : agents) occupied_.set(agent, path_of(agent).locations);

  const auto is_replanned = [&](std::int32_t agent) {
    return std::find(agents.begin(), agents.end(), agent) != agents.end();
  };
  child.node.pairs = child.conflicting_pairs;
  for (const auto& [a, b] : pairs_)
    if (!is_replanned(a) && !is_replanned(b)) ++child.node.pairs;
  child.node.f = std::max(child.node.f, child.node.lower_bound);
  child.node.estimated_cost = estimate(child.node);
  return has_paths;
}

// Plans an agent that is not in `occupied_`, and puts it there.
bool ConflictSearch::replan(NodeId parent, std::int32_t agent, Child& child) {
  const auto who = static_cast<std::size_t>(agent);
  tree_.gather_constraints(parent, agent, constraints_);
  for (const Constraint& c : child.constraints) {
    if (c.agent == agent)
      constraints_.push_back(c);
    else if (c.binds_others())
      constraints_.push_back(c.for_another(agent));
  }
  constraint_table_.fill(problem_.agents[who], constraints_);
  const std::size_t number = child.paths.size();
  if (child.found.size() <= number) child.found.resize(number + 1);
  LowLevelPath& found = child.found[number];
  LowLevelRequest request = {problem_.agents[who], tables_[who], constraint_table_, occupied_};
  request.suboptimality = options_.suboptimality;
  request.conflict_steps = conflict_steps_;
  request.lower_bound = parent == no_node ? 0 : path_of(agent).lower_bound;
  const LowLevelResult result = options_.safe_intervals ? safe_interval_search_.search(request, stop_, found)
                                                        : space_time_search_.search(request, stop_, found);
  if (result != LowLevelResult::found) return false;

  const std::size_t first = child.conflicts.size();
  occupied_.list(agent, found.locations, child.conflicts);
  std::stable_sort(child.conflicts.begin() + static_cast<std::ptrdiff_t>(first), child.conflicts.end(),
                   [](const Conflict& x, const Conflict& y) { return std::pair(x.a, x.b) < std::pair(y.a, y.b); });
  for (std::size_t i = first; i < child.conflicts.size(); ++i)
    if (i == first || std::pair(child.conflicts[i].a, child.conflicts[i].b) !=
                          std::pair(child.conflicts[i - 1].a, child.conflicts[i - 1].b))
      ++child.conflicting_pairs;
  occupied_.set(agent, found.locations);
  child.paths.push_back({agent, found.lower_bound, found.locations});
  child.node.cost += cost_of(found.locations);
  child.node.lower_bound += found.lower_bound;
  if (parent != no_node) {
    child.node.cost -= cost_of(path_of(agent).locations);
    child.node.lower_bound -= path_of(agent).lower_bound;
  }
  return true;
}

// Whether the child's paths may take the place of the node's own: fewer conflicts within the same bounds.
bool ConflictSearch::is_bypass(NodeId parent, const Child& child) const {
  const Node& node = tree_.node(parent);
  if (child.node.pairs >= node.pairs || child.node.cost > options_.suboptimality * queue_.lower_bound() + 1e-9)
    return false;
  for (const AgentPath& path : child.paths)
    if (cost_of(path.locations) > options_.suboptimality * path_of(path.agent).lower_bound + 1e-9) return false;
  return true;
}

void ConflictSearch::push(NodeId id) {
  ++statistics_.high_level_generated;
  queue_.push(id);
}

NodeId ConflictSearch::add(Child& child, NodeId parent, bool with_constraints) {
  Node node = child.node;
  node.parent = parent;
  if (parent == no_node) {
    node.pairs = child.conflicting_pairs;
    node.f = node.lower_bound;
    node.estimated_cost = estimate(node);
  }
  if (!with_constraints) {
    // without the constraints their bounds are not the node's
    node.lower_bound = tree_.node(parent).lower_bound;
    node.f = tree_.node(parent).f;
    node.is_informed = tree_.node(parent).is_informed;
    for (AgentPath& path : child.paths) path.lower_bound = path_of(path.agent).lower_bound;
  }
  return tree_.add(node, child.paths,
                   with_constraints ? std::span<const Constraint>(child.constraints) : std::span<const Constraint>(),
                   child.conflicts);
}

void ConflictSearch::note_errors(const Node& parent, const std::vector<const Node*>& children) {
  if (children.empty()) return;
  const Node& best = **std::min_element(children.begin(), children.end(), [](const Node* a, const Node* b) {
    return std::pair(a->estimated_cost, a->pairs) < std::pair(b->estimated_cost, b->pairs);
  });
  cost_error_sum_ += best.cost - parent.cost;
  distance_error_sum_ += best.pairs - (parent.pairs - 1);
  ++error_count_;
}

// The cost so far, plus what resolving the conflicts has cost until now for each pair.
double ConflictSearch::estimate(const Node& node) const {
  double estimated = node.cost;
  if (error_count_ > 0) {
    const double cost_error = std::max(0.0, cost_error_sum_ / static_cast<double>(error_count_));
    const double distance_error = std::clamp(distance_error_sum_ / static_cast<double>(error_count_), 0.0, 0.95);
    estimated += node.pairs * cost_error / (1 - distance_error);
  }
  return std::max(estimated, static_cast<double>(node.f));
}

// How much more the two agents' least joint cost is than their least costs together, under the node's constraints.
std::int32_t ConflictSearch::pair_weight(const Pair& pair) {
  const auto [a, b] = pair;
  const Mdd* const mdd_a = mdd_of(a);
  const Mdd* const mdd_b = mdd_of(b);
  if (!mdd_a || !mdd_b) return 0;  // stopped
  const std::int32_t least = mdd_a->cost() + mdd_b->cost();
  const PairKey key = {a, b, signatures_[static_cast<std::size_t>(a)], signatures_[static_cast<std::size_t>(b)]};
  const auto [at, is_new] = pair_weights_.emplace(key, 0);
  if (!is_new) return at->second;

  if (!pair_search_) {
    ConflictSearchOptions options = options_;
    options.suboptimality = 1;
    options.selection = Selection::best_first;
    options.dependency_graph = false;
    options.replan_in_place = false;
    options.restart_after = 0;
    options.node_limit = pair_node_limit;
    pair_search_ = std::make_unique<ConflictSearch>(problem_, tables_, corridors_, mdds_, options, stop_);
  }
  std::vector<Constraint> both;
  for (const std::int32_t agent : {a, b}) {
    tree_.gather_constraints(entered_, agent, constraints_);
    both.insert(both.end(), constraints_.begin(), constraints_.end());
  }
  const Result result = pair_search_->run({a, b}, both);
  if (result == Result::stopped) return 0;
  const std::int32_t joint = result == Result::unsolvable ? no_solution + least : pair_search_->queue_.lower_bound();
  return at->second = std::max(0, joint - least);
}

}  // namespace dmrp::planners
