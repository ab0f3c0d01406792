// SPDX-License-Identifier: MIT
#include "planners/large_agents/single_search.hpp"

#include <algorithm>
#include <tuple>

#include "planners/conflict_search/low_level/low_level.hpp"

namespace dmrp::planners {

SingleSearch::Result SingleSearch::search(const SingleRequest& request, StopSignal& stop, SinglePath& found) {
  reset(request);
  const BanTable& bans = request.bans;
  if (bans.finish_from() > bans.finish_until() || bans.finish_from() == forever ||
      !bans.allows(agent_->start, agent_->start, 0))
    return Result::none;
  Node start;
  start.location = agent_->start;
  offer(start);
  while (focal_.advance()) {
    if (stop.poll()) return Result::stopped;
    const Id best = focal_.pop([this](Id id) { return nodes_[id].is_open; });
    if (best == none) continue;
    if (!nodes_[best].is_end) {
      expand(best);
      continue;
    }
    found.lower_bound = focal_.bound();
    found.locations.resize(static_cast<std::size_t>(nodes_[best].t) + 1);
    for (Id id = nodes_[best].parent; id != none; id = nodes_[id].parent)
      found.locations[static_cast<std::size_t>(nodes_[id].t)] = nodes_[id].location;
    return Result::found;
  }
  return Result::none;
}

void SingleSearch::reset(const SingleRequest& request) {
  request_ = &request;
  agent_ = &fleet_.agents[static_cast<std::size_t>(request.agent)];
  others_rest_from_ = 0;
  for (const PathView path : request.others)
    if (!path.empty()) others_rest_from_ = std::max(others_rest_from_, cost_of(path));
  horizon_ = std::max(request.bans.constant_from(), others_rest_from_) + 1;
  if (request.bans.finish_from() != forever) horizon_ = std::max(horizon_, request.bans.finish_from());
  nodes_.clear();
  best_.clear();
  Node start;
  start.location = agent_->start;
  focal_.reset(std::max(request.lower_bound, least_cost_by_way_of(start)), request.suboptimality);
}

// The least cost of a path through the node.
std::int32_t SingleSearch::least_cost_by_way_of(const Node& node) const {
  std::int32_t rest = request_->table.distance(node.leg, node.location);
  const std::int32_t finish_from = request_->bans.finish_from();
  if (rest == 0 && (node.waited_at_end || node.t < finish_from)) rest = 2;  // away and back
  return std::max(node.t + rest, finish_from);
}

void SingleSearch::expand(Id id) {
  ++expanded_;
  const Node from = nodes_[id];
  const BanTable& bans = request_->bans;
  if (!from.waited_at_end && from.leg == agent_->last_leg() && from.location == agent_->last_goal() &&
      from.t >= bans.finish_from() && from.t <= bans.finish_until())
    offer_end(id);
  close(id);
  const GridGraph& graph = fleet_.graph(request_->agent);
  Node node;
  node.parent = id;
  node.t = from.t + 1;
  node.leg = agent_->leg_after(from.leg, from.location);
  for (Direction d = 0; d <= GridGraph::direction_count; ++d) {
    const bool is_wait = d == GridGraph::direction_count;
    node.location = is_wait ? from.location : graph.neighbor(from.location, d);
    if (node.location == nowhere || request_->table.distance(node.leg, node.location) >= TourTable::unreachable)
      continue;
    if (!bans.allows(from.location, node.location, node.t)) continue;
    const bool turns = !is_wait && from.heading != GridGraph::no_direction && from.heading != d;
    node.conflicts = from.conflicts + count_conflicts(from.location, node.location, node.t);
    node.turns = from.turns + (turns ? 1 : 0);
    node.heading = is_wait ? from.heading : static_cast<std::uint8_t>(d);
    node.waited_at_end =
        is_wait && node.location == agent_->last_goal() && node.leg == from.leg && node.leg == agent_->last_leg();
    offer(node);
  }
}

std::int32_t SingleSearch::count_conflicts(Location from, Location to, std::int32_t t) const {
  std::int32_t count = 0;
  for (AgentIndex other = 0; other < fleet_.size(); ++other) {
    const PathView path = request_->others[static_cast<std::size_t>(other)];
    if (!path.empty() &&
        fleet_.clash(request_->agent, from, to, other, location_at(path, t - 1), location_at(path, t)) != Clash::none)
      ++count;
  }
  return count;
}

// Adds a node unless a better one at the same place, time and leg is known.
void SingleSearch::offer(Node node) {
  node.f = std::max(least_cost_by_way_of(node), focal_.least_f());
  if (node.f > request_->bans.finish_until()) return;
  const auto time = static_cast<std::uint64_t>(std::min(node.t, horizon_));
  const auto locations = static_cast<std::uint64_t>(fleet_.graph(request_->agent).location_count());
  const std::uint64_t key =
      ((static_cast<std::uint64_t>(node.leg) << 28 | time) * locations + static_cast<std::uint64_t>(node.location)) *
          2 +
      (node.waited_at_end ? 1 : 0);
  node.is_fresh = true;
  const auto [known, is_new] = best_.emplace(key, none);
  if (!is_new) {
    const Node& other = nodes_[known->second];
    const auto rank = [](const Node& n) { return std::tuple(n.t, n.conflicts, n.turns); };
    const bool is_only_straighter = other.t == node.t && other.conflicts == node.conflicts;
    if (rank(other) <= rank(node) || (is_only_straighter && !other.is_open)) return;
    node.is_fresh = other.is_fresh || other.t > node.t;
    close(known->second);
  }
  known->second = static_cast<Id>(nodes_.size());
  nodes_.push_back(node);
  open(nodes_.back());
}

// Adds the node in which the agent comes to rest here.
void SingleSearch::offer_end(Id id) {
  Node end = nodes_[id];
  end.parent = id;
  end.f = std::max(end.t, focal_.least_f());
  for (std::int32_t t = end.t + 1; t <= others_rest_from_; ++t)
    end.conflicts += count_conflicts(end.location, end.location, t);
  end.is_end = true;
  nodes_.push_back(end);
  open(nodes_.back());
}

// Opens the last node.
void SingleSearch::open(const Node& node) {
  const auto id = static_cast<Id>(nodes_.size() - 1);
  nodes_[id].is_open = true;
  if (node.is_fresh) focal_.add_fresh(node.f, 1);
  const std::int32_t rest = node.is_end ? 0 : node.f - node.t + 1;
  focal_.push(id, node.f, focal_order(node.conflicts, 0, node.f - focal_.least_f(), rest, node.turns));
}

void SingleSearch::close(Id id) {
  Node& node = nodes_[id];
  if (node.is_fresh) focal_.add_fresh(node.f, -1);
  node.is_open = false;
  node.is_fresh = false;
}

}  // namespace dmrp::planners
