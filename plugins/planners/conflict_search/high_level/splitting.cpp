// SPDX-License-Identifier: MIT
// What a search splits a node on: the conflict to take, what is known of it, and what its two children ask for.
#include <algorithm>
#include <tuple>

#include "planners/conflict_search/high_level/search.hpp"

namespace dmrp::planners {

namespace {

bool is_vertex(const Conflict& conflict) {
  return conflict.from == nowhere;
}

}  // namespace

std::uint32_t ConflictSearch::choose_conflict() {
  const auto when_and_who = [this](std::uint32_t index) {
    const Conflict& c = tree_.conflict(index).conflict;
    return std::tuple(c.t, c.a, c.b, c.from, c.location);
  };
  const auto earlier = [&](std::uint32_t x, std::uint32_t y) { return when_and_who(x) < when_and_who(y); };
  if (!options_.prioritize_conflicts) {
    const std::uint32_t first = *std::min_element(conflicts_.begin(), conflicts_.end(), earlier);
    classify(tree_.conflict(first));
    return first;
  }
  for (const std::uint32_t index : conflicts_) {
    if (stop_.poll_now()) break;
    classify(tree_.conflict(index));
  }
  return *std::min_element(conflicts_.begin(), conflicts_.end(), [&](std::uint32_t x, std::uint32_t y) {
    const NodeConflict& a = tree_.conflict(x);
    const NodeConflict& b = tree_.conflict(y);
    if (a.cardinality != b.cardinality) return a.cardinality < b.cardinality;
    if (a.reasoning != b.reasoning) return a.reasoning < b.reasoning;
    return earlier(x, y);
  });
}

void ConflictSearch::classify(NodeConflict& conflict) {
  if (conflict.is_known) return;
  conflict.is_known = true;
  const Conflict& c = conflict.conflict;
  const bool a_raises = options_.prioritize_conflicts && must_arrive(c.a, c.from, c.location, c.t);
  const bool b_raises = options_.prioritize_conflicts &&
                        must_arrive(c.b, is_vertex(c) ? nowhere : c.location, is_vertex(c) ? c.location : c.from, c.t);
  const auto cardinality = [](bool a, bool b) {
    return a && b   ? NodeConflict::Cardinality::full
           : a || b ? NodeConflict::Cardinality::semi
                    : NodeConflict::Cardinality::none;
  };
  conflict.cardinality = cardinality(a_raises, b_raises);
  const auto rests_at = [&](std::int32_t agent) { return cost_of(path_of(agent).locations) <= c.t; };
  if (options_.target_reasoning && is_vertex(c) && (rests_at(c.a) || rests_at(c.b))) {
    // The one at its goal has to come later, or the other one to stay away from there.
    conflict.reasoning = NodeConflict::Reasoning::target;
    conflict.cardinality = cardinality(rests_at(c.a) || a_raises, rests_at(c.b) || b_raises);
    return;
  }
  std::optional<SymmetrySplit> symmetry;
  if (options_.corridor_reasoning && (symmetry = find_corridor_split(c))) {
    conflict.reasoning = NodeConflict::Reasoning::corridor;
  } else if (options_.rectangle_reasoning && is_vertex(c) && conflict.cardinality != NodeConflict::Cardinality::full) {
    symmetry = find_rectangle_split(c);
    if (symmetry) conflict.reasoning = NodeConflict::Reasoning::rectangle;
  }
  if (!symmetry) return;
  conflict.cardinality = cardinality(symmetry->raises_cost[0], symmetry->raises_cost[1]);
  conflict.split = tree_.add_split(std::move(symmetry->constraints));
}

std::optional<SymmetrySplit> ConflictSearch::find_corridor_split(const Conflict& conflict) {
  const PathView path_a = path_of(conflict.a).locations;
  const PathView path_b = path_of(conflict.b).locations;
  const auto passage = corridors_.find_passage(conflict, path_a, path_b);
  if (!passage) return std::nullopt;
  const Mdd* const mdd_a = mdd_of(conflict.a);
  const Mdd* const mdd_b = mdd_of(conflict.b);
  if (!mdd_a || !mdd_b) return std::nullopt;
  tree_.gather_constraints(entered_, conflict.a, constraints_);
  tree_.gather_constraints(entered_, conflict.b, other_constraints_);
  return corridors_.find_split(*passage, conflict, {conflict.a, path_a, constraints_, *mdd_a},
                               {conflict.b, path_b, other_constraints_, *mdd_b});
}

std::optional<SymmetrySplit> ConflictSearch::find_rectangle_split(const Conflict& conflict) {
  const Mdd* const mdd_a = mdd_of(conflict.a);
  const Mdd* const mdd_b = mdd_of(conflict.b);
  if (!mdd_a || !mdd_b) return std::nullopt;
  return find_rectangle(problem_.graph, conflict, *mdd_a, *mdd_b, path_of(conflict.a).locations,
                        path_of(conflict.b).locations);
}

// Whether all of the agent's paths of least cost arrive there (from there) at that time.
bool ConflictSearch::must_arrive(std::int32_t agent, Location from, Location to, std::int32_t t) {
  const Mdd* const mdd = mdd_of(agent);
  return mdd && mdd->must_be_at(to, t) && (from == nowhere || mdd->must_be_at(from, t - 1));
}

Split ConflictSearch::split_on(const NodeConflict& conflict) {
  const Conflict& c = conflict.conflict;
  switch (conflict.reasoning) {
    case NodeConflict::Reasoning::target: {
      const std::int32_t resting = cost_of(path_of(c.a).locations) <= c.t ? c.a : c.b;
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

Split ConflictSearch::plain_split(const Conflict& c) {
  if (!is_vertex(c)) return {{{avoid_move(c.a, c.from, c.location, c.t)}, {avoid_move(c.b, c.location, c.from, c.t)}}};
  if (!options_.disjoint_splitting)
    return {{{avoid_vertex(c.a, c.location, c.t)}, {avoid_vertex(c.b, c.location, c.t)}}};
  return {{{pass_vertex(c.a, c.location, c.t)}, {avoid_vertex(c.a, c.location, c.t)}}};
}

}  // namespace dmrp::planners
