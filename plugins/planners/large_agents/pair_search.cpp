// SPDX-License-Identifier: MIT
#include "planners/large_agents/pair_search.hpp"

#include <algorithm>
#include <functional>

namespace dmrp::planners {

PairSearch::Result PairSearch::search(const Member& a, const Member& b, std::size_t most_nodes, StopSignal& stop,
                                      std::array<std::vector<Location>, 2>& paths) {
  members_ = {&a, &b};
  horizon_ = std::max(a.bans.constant_from(), b.bans.constant_from()) + 1;
  nodes_.clear();
  open_.clear();
  best_.clear();
  std::array<std::vector<Place>, 2> steps;
  for (std::size_t i = 0; i < 2; ++i) {
    const Place start{fleet_.agents[static_cast<std::size_t>(members_[i]->agent)].start, 0, false};
    if (members_[i]->bans.allows(start.location, start.location, 0)) steps[i].push_back(start);
    if (may_rest(i, start, 0)) steps[i].push_back({start.location, 0, true});
  }
  for (const Place& of_a : steps[0])
    for (const Place& of_b : steps[1]) offer({{of_a, of_b}, 0, 0, -1});
  while (!open_.empty()) {
    if (stop.poll()) return Result::stopped;
    if (nodes_.size() > most_nodes) return Result::too_large;
    const std::int64_t id = open_.front().second;
    std::pop_heap(open_.begin(), open_.end(), std::greater<>());
    open_.pop_back();
    const Node node = nodes_[static_cast<std::size_t>(id)];
    if (best_.at(key_of(node)) < node.cost) continue;
    if (node.places[0].rests && node.places[1].rests) {
      write(id, paths);
      return Result::found;
    }
    for (std::size_t i = 0; i < 2; ++i) list_steps(i, node.places[i], node.t + 1, steps[i]);
    const std::int32_t cost = node.cost + (node.places[0].rests ? 0 : 1) + (node.places[1].rests ? 0 : 1);
    for (const Place& of_a : steps[0])
      for (const Place& of_b : steps[1])
        if (fleet_.clash(a.agent, node.places[0].location, of_a.location, b.agent, node.places[1].location,
                         of_b.location) == Clash::none)
          offer({{of_a, of_b}, node.t + 1, cost, id});
  }
  return Result::none;
}

// Where the agent can be at time t, one step after `from`.
void PairSearch::list_steps(std::size_t member, const Place& from, std::int32_t t, std::vector<Place>& steps) const {
  steps.clear();
  if (from.rests) {
    steps.push_back(from);
    return;
  }
  const Member& self = *members_[member];
  const Agent& agent = fleet_.agents[static_cast<std::size_t>(self.agent)];
  const GridGraph& graph = fleet_.graph(self.agent);
  const std::int32_t leg = agent.leg_after(from.leg, from.location);
  for (Direction d = 0; d <= GridGraph::direction_count; ++d) {
    const bool is_wait = d == GridGraph::direction_count;
    const Location to = is_wait ? from.location : graph.neighbor(from.location, d);
    if (to == nowhere || self.table.distance(leg, to) >= TourTable::unreachable) continue;
    if (!self.bans.allows(from.location, to, t)) continue;
    steps.push_back({to, leg, false});
    // an agent that waits at its goal and then rests would have rested before
    if ((!is_wait || leg != from.leg) && may_rest(member, steps.back(), t)) steps.push_back({to, leg, true});
  }
}

bool PairSearch::may_rest(std::size_t member, const Place& place, std::int32_t t) const {
  const Member& self = *members_[member];
  const Agent& agent = fleet_.agents[static_cast<std::size_t>(self.agent)];
  return place.leg == agent.last_leg() && place.location == agent.last_goal() && t >= self.bans.finish_from() &&
         t <= self.bans.finish_until();
}

// The steps that the agent takes at least until it rests.
std::int32_t PairSearch::estimate(std::size_t member, const Place& place, std::int32_t t) const {
  if (place.rests) return 0;
  const Member& self = *members_[member];
  const std::int32_t rest = self.table.distance(place.leg, place.location);
  return std::max(rest == 0 ? 2 : rest, self.bans.finish_from() - t);  // at its goal: away and back
}

void PairSearch::offer(const Node& node) {
  std::int32_t estimated = node.cost;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::int32_t rest = estimate(i, node.places[i], node.t);
    if (!node.places[i].rests && node.t + rest > members_[i]->bans.finish_until()) return;
    estimated += rest;
  }
  const auto [known, is_new] = best_.emplace(key_of(node), node.cost);
  if (!is_new && known->second <= node.cost) return;
  known->second = node.cost;
  const std::int64_t order = (std::int64_t{estimated} << 32) - node.cost;
  open_.emplace_back(order, static_cast<std::int64_t>(nodes_.size()));
  std::push_heap(open_.begin(), open_.end(), std::greater<>());
  nodes_.push_back(node);
}

std::uint64_t PairSearch::key_of(const Node& node) const {
  auto key = static_cast<std::uint64_t>(std::min(node.t, horizon_));
  for (std::size_t i = 0; i < 2; ++i) {
    const Place& place = node.places[i];
    const AgentIndex agent = members_[i]->agent;
    key = key * static_cast<std::uint64_t>(fleet_.graph(agent).location_count()) +
          static_cast<std::uint64_t>(place.location);
    key = key * fleet_.agents[static_cast<std::size_t>(agent)].goals.size() + static_cast<std::uint64_t>(place.leg);
    key = key * 2 + (place.rests ? 1 : 0);
  }
  return key;
}

// A path ends where its agent comes to rest.
void PairSearch::write(std::int64_t id, std::array<std::vector<Location>, 2>& paths) const {
  for (auto& path : paths) path.clear();
  for (; id >= 0; id = nodes_[static_cast<std::size_t>(id)].parent) {
    const Node& node = nodes_[static_cast<std::size_t>(id)];
    const bool is_first = node.parent < 0;
    for (std::size_t i = 0; i < 2; ++i)
      if (is_first || !nodes_[static_cast<std::size_t>(node.parent)].places[i].rests)
        paths[i].push_back(node.places[i].location);
  }
  for (auto& path : paths) std::reverse(path.begin(), path.end());
}

}  // namespace dmrp::planners
