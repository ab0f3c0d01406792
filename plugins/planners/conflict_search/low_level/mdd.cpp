// SPDX-License-Identifier: MIT
#include "planners/conflict_search/low_level/mdd.hpp"

#include <algorithm>

namespace dmrp::planners {

namespace {

// A node during construction, with its successors in the next level.
struct GrowingNode {
  Mdd::Node node;
  std::uint32_t successors_begin;
  std::uint32_t successors_end;
  bool leads_to_the_end;
};

struct Growth {
  std::vector<GrowingNode> nodes;
  std::vector<std::uint32_t> level_begin;
  std::vector<std::uint32_t> successors;
  bool may_wait_at_end = false;
};

// False if a landmark requires the agent elsewhere at that time.
bool at_landmark(const ConstraintTable& constraints, Location location, std::int32_t t) {
  for (const ConstraintTable::Landmark& landmark : constraints.landmarks())
    if (landmark.t == t && landmark.location != location) return false;
  return true;
}

// Adds level t: the places reached from level t - 1 from which the end can still be reached by `cost`.
void grow_level(Growth& growth, const GridGraph& graph, const Agent& agent, const TourTable& table,
                const ConstraintTable& constraints, std::int32_t t, std::int32_t cost,
                std::vector<std::uint32_t>& node_at, StopSignal* stop) {
  const auto level_begin = static_cast<std::uint32_t>(growth.nodes.size());
  const std::uint32_t previous = growth.level_begin.back();
  growth.level_begin.push_back(level_begin);
  const auto locations = static_cast<std::size_t>(graph.location_count());
  for (std::uint32_t parent = previous; parent < level_begin; ++parent) {
    if (stop && stop->poll()) return;
    const Mdd::Node from = growth.nodes[parent].node;
    const std::int32_t leg = agent.leg_after(from.leg, from.location);
    growth.nodes[parent].successors_begin = static_cast<std::uint32_t>(growth.successors.size());
    for (Direction d = 0; d <= GridGraph::direction_count; ++d) {
      const Location to = d == GridGraph::direction_count ? from.location : graph.neighbor(from.location, d);
      if (to == nowhere || t + table.distance(leg, to) > cost || !constraints.allows(from.location, to, t)) continue;
      if (!at_landmark(constraints, to, t)) continue;
      if (t == cost && to == from.location && leg == from.leg) {  // the path would have ended before
        growth.may_wait_at_end = true;
        continue;
      }
      // Indices of earlier levels are below level_begin; those not set are 0.
      std::uint32_t& at = node_at[static_cast<std::size_t>(leg) * locations + static_cast<std::size_t>(to)];
      const bool known = at >= level_begin && at < growth.nodes.size();
      if (!known) {
        at = static_cast<std::uint32_t>(growth.nodes.size());
        growth.nodes.push_back({{to, leg}, 0, 0, false});
      }
      growth.successors.push_back(at);
    }
    growth.nodes[parent].successors_end = static_cast<std::uint32_t>(growth.successors.size());
  }
}

// Marks the nodes from which the end can be reached, from the last level back.
void mark(Growth& growth, const Agent& agent) {
  for (std::size_t i = growth.nodes.size(); i-- > 0;) {
    GrowingNode& node = growth.nodes[i];
    node.leads_to_the_end =
        i >= growth.level_begin.back() && node.node.leg == agent.last_leg() && node.node.location == agent.last_goal();
    for (std::uint32_t s = node.successors_begin; s < node.successors_end; ++s)
      node.leads_to_the_end = node.leads_to_the_end || growth.nodes[growth.successors[s]].leads_to_the_end;
  }
}

}  // namespace

Mdd::Mdd(const GridGraph& graph, const Agent& agent, const TourTable& table, const ConstraintTable& constraints,
         std::int32_t cost, StopSignal* stop) {
  if (cost < constraints.finish_from() || cost > constraints.finish_until()) return;
  Growth growth;
  growth.level_begin.push_back(0);
  growth.nodes.push_back({{agent.start, 0}, 0, 0, false});
  std::vector<std::uint32_t> node_at(agent.goals.size() * static_cast<std::size_t>(graph.location_count()), 0);
  for (std::int32_t t = 1; t <= cost; ++t) {
    grow_level(growth, graph, agent, table, constraints, t, cost, node_at, stop);
    if (stop && stop->raised()) return;
  }
  mark(growth, agent);
  if (!growth.nodes.front().leads_to_the_end) return;
  may_wait_at_end_ = growth.may_wait_at_end;

  growth.level_begin.push_back(static_cast<std::uint32_t>(growth.nodes.size()));
  for (std::size_t level = 0; level + 1 < growth.level_begin.size(); ++level) {
    level_begin_.push_back(static_cast<std::uint32_t>(nodes_.size()));
    for (std::uint32_t i = growth.level_begin[level]; i < growth.level_begin[level + 1]; ++i)
      if (growth.nodes[i].leads_to_the_end) nodes_.push_back(growth.nodes[i].node);
  }
  level_begin_.push_back(static_cast<std::uint32_t>(nodes_.size()));
}

bool Mdd::must_be_at(Location location, std::int32_t t) const {
  for (const Node& node : level(std::min(t, cost())))
    if (node.location != location) return false;
  return true;
}

namespace {

constexpr std::size_t size_limit = 8'000'000;

}  // namespace

std::shared_ptr<const Mdd> MddCache::get(std::int32_t agent, std::vector<Constraint>& constraints,
                                         std::int32_t at_least) {
  const auto index = static_cast<std::size_t>(agent);
  std::sort(constraints.begin(), constraints.end());
  constraints.erase(std::unique(constraints.begin(), constraints.end()), constraints.end());
  std::uint64_t hash = 0;
  for (const Constraint& constraint : constraints) hash += hash_of(constraint);
  const auto [first, last] = of_agent_[index].equal_range(hash);
  for (auto it = first; it != last; ++it)
    if (it->second.constraints == constraints) return it->second.mdd;
  constraint_table_.fill(problem_.agents[index], constraints);
  for (std::int32_t cost = at_least;; ++cost) {
    Mdd mdd(problem_.graph, problem_.agents[index], tables_[index], constraint_table_, cost, stop_);
    if (stop_ && stop_->poll()) return nullptr;
    if (mdd.is_empty()) continue;
    size_ += mdd.node_count() + 2 * static_cast<std::size_t>(cost) + 4 * constraints.size();
    return of_agent_[index].emplace(hash, Entry{constraints, std::make_shared<const Mdd>(std::move(mdd))})->second.mdd;
  }
}

void MddCache::trim() {
  if (size_ < size_limit) return;
  for (ByHash& mdds : of_agent_) mdds.clear();
  size_ = 0;
}

}  // namespace dmrp::planners
