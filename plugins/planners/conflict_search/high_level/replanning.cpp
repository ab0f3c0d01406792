// SPDX-License-Identifier: MIT
#include "planners/conflict_search/high_level/replanning.hpp"

#include <algorithm>

namespace dmrp::planners {

namespace {

bool contains(const std::vector<std::int32_t>& agents, std::int32_t agent) {
  return std::find(agents.begin(), agents.end(), agent) != agents.end();
}

void reset(Child& child, const Node& node, const std::vector<Constraint>& constraints) {
  child.node = node;
  child.constraints = constraints;
  child.paths.clear();
  child.conflicts.clear();
}

}  // namespace

Replanner::Replanner(const SearchContext& context, const ConflictSearchOptions& options)
    : problem_(context.problem),
      tables_(context.tables),
      stop_(context.stop),
      suboptimality_(options.suboptimality),
      safe_intervals_(options.safe_intervals),
      safe_interval_search_(context.problem.graph),
      space_time_search_(context.problem.graph),
      constraint_table_(context.problem.graph) {}

bool Replanner::plan_root(const std::vector<std::int32_t>& order, const std::vector<Constraint>& constraints,
                          ConflictTable& occupied, Child& root) {
  reset(root, {}, constraints);
  for (const std::int32_t agent : order) {
    constraints_.clear();
    if (!plan(agent, 0, occupied, root)) return false;
  }
  root.node.f = root.node.lower_bound;
  return true;
}

bool Replanner::replan(EnteredNode& node, const std::vector<std::int32_t>& members,
                       const std::vector<Constraint>& constraints, Child& child) {
  std::vector<std::int32_t> agents;
  for (const Constraint& c : constraints)
    for (const std::int32_t agent : members) {
      if (agent != c.agent && !c.binds_others()) continue;
      if (satisfies(node.path_of(agent).locations, agent == c.agent ? c : c.for_another(agent))) continue;
      if (!contains(agents, agent)) agents.push_back(agent);
    }
  return replan_agents(node, agents, constraints, child);
}

bool Replanner::replan_agents(EnteredNode& node, const std::vector<std::int32_t>& agents,
                              const std::vector<Constraint>& constraints, Child& child) {
  reset(child, node.node(), constraints);
  child.node.parent = node.id();
  child.node.is_informed = false;
  child.node.pairs = 0;
  for (const auto& [a, b] : node.conflicting_pairs())
    if (!contains(agents, a) && !contains(agents, b)) ++child.node.pairs;

  ConflictTable& occupied = node.occupied();
  for (const std::int32_t agent : agents) occupied.set(agent, {});
  bool has_paths = true;
  for (std::size_t i = 0; i < agents.size() && has_paths; ++i) {
    const AgentPath& before = node.path_of(agents[i]);
    node.gather_constraints(agents[i], constraints_);
    has_paths = plan(agents[i], before.lower_bound, occupied, child);
    child.node.cost -= cost_of(before.locations);
    child.node.lower_bound -= before.lower_bound;
  }
  for (const std::int32_t agent : agents) occupied.set(agent, node.path_of(agent).locations);
  child.node.f = std::max(child.node.f, child.node.lower_bound);
  return has_paths;
}

// Plans an agent that is not in `occupied`, and puts it there. No path of the agent costs less than `lower_bound`.
// `constraints_` holds its constraints in the parent.
bool Replanner::plan(std::int32_t agent, std::int32_t lower_bound, ConflictTable& occupied, Child& child) {
  const auto index = static_cast<std::size_t>(agent);
  for (const Constraint& c : child.constraints) {
    if (c.agent == agent)
      constraints_.push_back(c);
    else if (c.binds_others())
      constraints_.push_back(c.for_another(agent));
  }
  constraint_table_.fill(problem_.agents[index], constraints_);
  if (child.found.size() <= child.paths.size()) child.found.resize(child.paths.size() + 1);
  LowLevelPath& found = child.found[child.paths.size()];
  LowLevelRequest request = {problem_.agents[index], tables_[index], constraint_table_, occupied};
  request.suboptimality = suboptimality_;
  request.conflict_steps = conflict_steps_;
  request.lower_bound = lower_bound;
  const LowLevelResult result = safe_intervals_ ? safe_interval_search_.search(request, stop_, found)
                                                : space_time_search_.search(request, stop_, found);
  if (result != LowLevelResult::found) return false;

  add_conflicts(agent, found.locations, occupied, child);
  occupied.set(agent, found.locations);
  child.paths.push_back({agent, found.lower_bound, found.locations});
  child.node.cost += cost_of(found.locations);
  child.node.lower_bound += found.lower_bound;
  return true;
}

// Lists the conflicts of a new path, those of one pair together, and counts the pairs.
void Replanner::add_conflicts(std::int32_t agent, PathView path, const ConflictTable& occupied, Child& child) const {
  const auto pair_of = [](const Conflict& conflict) { return AgentPair(conflict.a, conflict.b); };
  std::vector<Conflict>& conflicts = child.conflicts;
  const std::size_t first = conflicts.size();
  occupied.list(agent, path, conflicts);
  std::stable_sort(conflicts.begin() + static_cast<std::ptrdiff_t>(first), conflicts.end(),
                   [&](const Conflict& x, const Conflict& y) { return pair_of(x) < pair_of(y); });
  for (std::size_t i = first; i < conflicts.size(); ++i)
    if (i == first || pair_of(conflicts[i]) != pair_of(conflicts[i - 1])) ++child.node.pairs;
}

}  // namespace dmrp::planners
