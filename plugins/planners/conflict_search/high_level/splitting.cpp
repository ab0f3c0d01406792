// SPDX-License-Identifier: MIT
#include "planners/conflict_search/high_level/splitting.hpp"

#include <algorithm>
#include <cassert>
#include <tuple>

#include "planners/conflict_search/symmetry/rectangle.hpp"

namespace dmrp::planners {

namespace {

bool is_vertex(const Conflict& conflict) {
  return conflict.from == nowhere;
}

bool rests_at(const EnteredNode& node, std::int32_t agent, std::int32_t t) {
  return cost_of(node.path_of(agent).locations) <= t;
}

// Whether all paths of the agent's least cost arrive at `to` (from `from`, unless that is nowhere) at time t.
bool must_arrive(EnteredNode& node, std::int32_t agent, Location from, Location to, std::int32_t t) {
  const Mdd* const mdd = node.mdd_of(agent);
  return mdd && mdd->must_be_at(to, t) && (from == nowhere || mdd->must_be_at(from, t - 1));
}

NodeConflict::Cardinality cardinality_of(bool raises_a, bool raises_b) {
  if (raises_a && raises_b) return NodeConflict::Cardinality::full;
  return raises_a || raises_b ? NodeConflict::Cardinality::semi : NodeConflict::Cardinality::none;
}

}  // namespace

std::uint32_t Splitter::choose_conflict(EnteredNode& node) {
  assert(!node.conflicts().empty());
  const auto time_and_agents = [this](std::uint32_t index) {
    const Conflict& c = tree_.conflict(index);
    return std::tuple(c.t, c.a, c.b, c.from, c.location);
  };
  const auto is_earlier = [&](std::uint32_t x, std::uint32_t y) { return time_and_agents(x) < time_and_agents(y); };
  const std::vector<std::uint32_t>& conflicts = node.conflicts();
  if (!options_.prioritize_conflicts) {
    const std::uint32_t first = *std::min_element(conflicts.begin(), conflicts.end(), is_earlier);
    classify(node, tree_.conflict(first));
    return first;
  }
  for (const std::uint32_t index : conflicts) {
    if (context_.stop.poll_now()) break;
    classify(node, tree_.conflict(index));
  }
  return *std::min_element(conflicts.begin(), conflicts.end(), [&](std::uint32_t x, std::uint32_t y) {
    const NodeConflict& a = tree_.conflict(x);
    const NodeConflict& b = tree_.conflict(y);
    if (a.cardinality != b.cardinality) return a.cardinality < b.cardinality;
    if (a.reasoning != b.reasoning) return a.reasoning < b.reasoning;
    return is_earlier(x, y);
  });
}

// Fills in a conflict's cardinality and symmetry, unless an earlier node did.
void Splitter::classify(EnteredNode& node, NodeConflict& conflict) {
  if (conflict.is_known) return;
  conflict.is_known = true;
  const Conflict& c = conflict;
  bool raises_a = false;
  bool raises_b = false;
  if (options_.prioritize_conflicts) {
    raises_a = must_arrive(node, c.a, c.from, c.location, c.t);
    raises_b = is_vertex(c) ? must_arrive(node, c.b, nowhere, c.location, c.t)
                            : must_arrive(node, c.b, c.location, c.from, c.t);
  }
  conflict.cardinality = cardinality_of(raises_a, raises_b);
  const bool a_rests = rests_at(node, c.a, c.t);
  const bool b_rests = rests_at(node, c.b, c.t);
  if (options_.target_reasoning && is_vertex(c) && (a_rests || b_rests)) {
    // Either the agent at its goal comes to rest later, or the other one avoids the goal.
    conflict.reasoning = NodeConflict::Reasoning::target;
    conflict.cardinality = cardinality_of(a_rests || raises_a, b_rests || raises_b);
  } else if (auto symmetry = find_symmetry(node, conflict)) {
    conflict.cardinality = cardinality_of(symmetry->raises_cost[0], symmetry->raises_cost[1]);
    conflict.split = tree_.add_split(std::move(symmetry->constraints));
  }
}

// The corridor or rectangle of a conflict; sets conflict.reasoning.
std::optional<SymmetrySplit> Splitter::find_symmetry(EnteredNode& node, NodeConflict& conflict) {
  if (options_.corridor_reasoning) {
    if (auto corridor = find_corridor_split(node, conflict)) {
      conflict.reasoning = NodeConflict::Reasoning::corridor;
      return corridor;
    }
  }
  if (options_.rectangle_reasoning && is_vertex(conflict) && conflict.cardinality != NodeConflict::Cardinality::full) {
    if (auto rectangle = find_rectangle_split(node, conflict)) {
      conflict.reasoning = NodeConflict::Reasoning::rectangle;
      return rectangle;
    }
  }
  return std::nullopt;
}

std::optional<SymmetrySplit> Splitter::find_corridor_split(EnteredNode& node, const Conflict& conflict) {
  const PathView path_a = node.path_of(conflict.a).locations;
  const PathView path_b = node.path_of(conflict.b).locations;
  const auto passage = context_.corridors.find_passage(conflict, path_a, path_b);
  if (!passage) return std::nullopt;
  const Mdd* const mdd_a = node.mdd_of(conflict.a);
  const Mdd* const mdd_b = node.mdd_of(conflict.b);
  if (!mdd_a || !mdd_b) return std::nullopt;
  node.gather_constraints(conflict.a, constraints_a_);
  node.gather_constraints(conflict.b, constraints_b_);
  return context_.corridors.find_split(*passage, conflict, {conflict.a, path_a, constraints_a_, *mdd_a},
                                       {conflict.b, path_b, constraints_b_, *mdd_b});
}

std::optional<SymmetrySplit> Splitter::find_rectangle_split(EnteredNode& node, const Conflict& conflict) const {
  const Mdd* const mdd_a = node.mdd_of(conflict.a);
  const Mdd* const mdd_b = node.mdd_of(conflict.b);
  if (!mdd_a || !mdd_b) return std::nullopt;
  return find_rectangle(context_.problem.graph, conflict, *mdd_a, *mdd_b, node.path_of(conflict.a).locations,
                        node.path_of(conflict.b).locations);
}

Split Splitter::split(const EnteredNode& node, std::uint32_t index) const {
  const NodeConflict& conflict = tree_.conflict(index);
  const Conflict& c = conflict;
  switch (conflict.reasoning) {
    case NodeConflict::Reasoning::target: {
      const std::int32_t resting = rests_at(node, c.a, c.t) ? c.a : c.b;
      return {{{finish_after(resting, c.location, c.t)}, {finish_by(resting, c.location, c.t)}}};
    }
    case NodeConflict::Reasoning::corridor:
    case NodeConflict::Reasoning::rectangle:
      return tree_.split(conflict.split);
    case NodeConflict::Reasoning::plain:
      break;
  }
  return plain_split(c);
}

Split Splitter::plain_split(const Conflict& c) const {
  if (!is_vertex(c)) return {{{avoid_move(c.a, c.from, c.location, c.t)}, {avoid_move(c.b, c.location, c.from, c.t)}}};
  if (!options_.disjoint_splitting)
    return {{{avoid_vertex(c.a, c.location, c.t)}, {avoid_vertex(c.b, c.location, c.t)}}};
  return {{{pass_vertex(c.a, c.location, c.t)}, {avoid_vertex(c.a, c.location, c.t)}}};
}

}  // namespace dmrp::planners
