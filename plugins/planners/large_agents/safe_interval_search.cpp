// SPDX-License-Identifier: MIT
#include "planners/large_agents/safe_interval_search.hpp"

#include <algorithm>

namespace dmrp::planners {

FleetSipp::Result FleetSipp::search(AgentIndex agent, const TourTable& table, const std::vector<PathView>& others,
                                    std::int32_t delay, StopSignal& stop, std::vector<Location>& path) {
  reset(agent, table, others);
  const Agent& self = fleet_.agents[static_cast<std::size_t>(agent)];
  const std::vector<Interval>& at_start = intervals(self.start);
  if (at_start.empty() || at_start[0].from > 0 || at_start[0].to < delay) return Result::none;
  offer(self.start, 0, delay, 0, -1);
  while (!open_.empty()) {
    if (stop.poll()) return Result::stopped;
    const std::int32_t id = open_.top().second;
    open_.pop();
    const Node& node = nodes_[static_cast<std::size_t>(id)];
    const auto interval = static_cast<std::size_t>(node.interval);
    const std::vector<Interval>& here = intervals(node.location);
    if (earliest_[static_cast<std::size_t>(node.leg)][static_cast<std::size_t>(node.location)][interval] < node.t)
      continue;
    if (node.leg == self.last_leg() && node.location == self.last_goal() && here[interval].to == forever) {
      write(id, path);
      return Result::found;
    }
    expand(id);
  }
  return Result::none;
}

void FleetSipp::reset(AgentIndex agent, const TourTable& table, const std::vector<PathView>& others) {
  agent_ = agent;
  table_ = &table;
  others_ = &others;
  rest_from_ = 0;
  for (const PathView path : others)
    if (!path.empty()) rest_from_ = std::max(rest_from_, cost_of(path));
  const auto locations = static_cast<std::size_t>(fleet_.graph(agent).location_count());
  intervals_.assign(locations, {});
  is_known_.assign(locations, false);
  const std::size_t legs = fleet_.agents[static_cast<std::size_t>(agent)].goals.size();
  earliest_.assign(legs, std::vector<std::vector<std::int32_t>>(locations));
  nodes_.clear();
  open_ = {};
}

bool FleetSipp::is_blocked(Location from, Location to, std::int32_t t) const {
  for (AgentIndex other = 0; other < fleet_.size(); ++other) {
    const PathView path = (*others_)[static_cast<std::size_t>(other)];
    if (!path.empty() && fleet_.clash(agent_, from, to, other, location_at(path, std::max(t - 1, 0)),
                                      location_at(path, t)) != Clash::none)
      return true;
  }
  return false;
}

// An interval goes on while the agent can wait from each step to the next.
const std::vector<FleetSipp::Interval>& FleetSipp::intervals(Location location) {
  const auto index = static_cast<std::size_t>(location);
  std::vector<Interval>& found = intervals_[index];
  if (is_known_[index]) return found;
  is_known_[index] = true;
  const auto is_occupied = [&](std::int32_t t) {
    for (AgentIndex other = 0; other < fleet_.size(); ++other) {
      const PathView path = (*others_)[static_cast<std::size_t>(other)];
      if (!path.empty() && fleet_.exclude(agent_, location, other, location_at(path, t))) return true;
    }
    return false;
  };
  bool goes_on = false;
  for (std::int32_t t = 0; t <= rest_from_ + 1; ++t) {
    if (goes_on && is_blocked(location, location, t)) goes_on = false;
    if (goes_on) {
      found.back().to = t;
    } else if (!is_occupied(t)) {
      found.push_back({t, t});
      goes_on = true;
    }
  }
  if (goes_on) found.back().to = forever;
  for (auto& of_leg : earliest_) of_leg[index].assign(found.size(), forever);
  return found;
}

// Into each interval of a neighbour the first step that is free; the agent waits before it.
void FleetSipp::expand(std::int32_t id) {
  ++expanded_;
  const Node node = nodes_[static_cast<std::size_t>(id)];
  const Agent& self = fleet_.agents[static_cast<std::size_t>(agent_)];
  const GridGraph& graph = fleet_.graph(agent_);
  const std::int32_t leg = self.leg_after(node.leg, node.location);
  const std::int32_t leave_by = intervals(node.location)[static_cast<std::size_t>(node.interval)].to;
  // of two equal goals in a row the second one is reached by a wait
  if (leg != node.leg && node.location == self.goal(leg) && node.t < leave_by)
    offer(node.location, leg, node.t + 1, node.interval, id);
  for (Direction d = 0; d < GridGraph::direction_count; ++d) {
    const Location to = graph.neighbor(node.location, d);
    if (to == nowhere || table_->distance(leg, to) >= TourTable::unreachable) continue;
    const std::vector<Interval>& there = intervals(to);
    for (std::size_t i = 0; i < there.size(); ++i) {
      const std::int32_t first = std::max(there[i].from, node.t + 1);
      // once all others rest, a step that is blocked stays blocked
      const std::int32_t last =
          std::min({there[i].to, leave_by < forever ? leave_by + 1 : forever, std::max(first, rest_from_ + 1)});
      for (std::int32_t t = first; t <= last; ++t) {
        if (is_blocked(node.location, to, t)) continue;
        offer(to, leg, t, static_cast<std::int32_t>(i), id);
        break;
      }
    }
  }
}

void FleetSipp::offer(Location location, std::int32_t leg, std::int32_t t, std::int32_t interval, std::int32_t parent) {
  std::int32_t& earliest =
      earliest_[static_cast<std::size_t>(leg)][static_cast<std::size_t>(location)][static_cast<std::size_t>(interval)];
  if (earliest <= t) return;
  earliest = t;
  const std::int64_t f = t + table_->distance(leg, location);
  open_.emplace((f << 32) - t, static_cast<std::int32_t>(nodes_.size()));
  nodes_.push_back({location, leg, t, interval, parent});
}

// Waits lie before the move that follows them.
void FleetSipp::write(std::int32_t id, std::vector<Location>& path) const {
  path.assign(static_cast<std::size_t>(nodes_[static_cast<std::size_t>(id)].t) + 1, nowhere);
  std::int32_t until = nodes_[static_cast<std::size_t>(id)].t + 1;
  for (; id >= 0; id = nodes_[static_cast<std::size_t>(id)].parent) {
    const Node& node = nodes_[static_cast<std::size_t>(id)];
    const std::int32_t from = node.parent < 0 ? 0 : node.t;
    std::fill(path.begin() + from, path.begin() + until, node.location);
    until = from;
  }
}

}  // namespace dmrp::planners
