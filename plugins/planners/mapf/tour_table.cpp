// SPDX-License-Identifier: MIT
#include "tour_table.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace dmrp::planners {

TourTable::TourTable(const GridGraph& graph, const Agent& agent, StopSignal& stop)
    : graph_(&graph),
      agent_(&agent),
      distance_(agent.goals.size() * static_cast<std::size_t>(graph.location_count()), unreachable),
      turns_(distance_.size() * heading_count, 0) {
  queue_.reserve(static_cast<std::size_t>(graph.location_count()));
  for (std::int32_t leg = agent.last_leg(); leg >= 0 && !stop.raised(); --leg) fill_leg(leg, stop);
}

// Breadth-first from the goal. Turns are filled in the order of distance, so that every successor has its own.
void TourTable::fill_leg(std::int32_t leg, StopSignal& stop) {
  const Location goal = agent_->goal(leg);
  if (goal == nowhere) return;
  const std::int32_t rest = distance_at_goal(leg);
  if (rest >= unreachable) return;
  queue_.assign(1, goal);
  distance_[index(leg, goal)] = rest;
  for (std::size_t next = 0; next < queue_.size(); ++next) {
    if (stop.poll()) return;
    const Location location = queue_[next];
    fill_turns(leg, location);
    for (Direction d = 0; d < GridGraph::direction_count; ++d) {
      const Location from = graph_->predecessor(location, d);
      if (from == nowhere || distance(leg, from) < unreachable) continue;
      distance_[index(leg, from)] = distance(leg, location) + 1;
      queue_.push_back(from);
    }
  }
}

std::int32_t TourTable::distance_at_goal(std::int32_t leg) const {
  if (leg == agent_->last_leg()) return 0;
  const Location goal = agent_->goal(leg);
  std::int32_t least = distance(leg + 1, goal);
  for (Direction d = 0; d < GridGraph::direction_count; ++d)
    if (const Location to = graph_->neighbor(goal, d); to != nowhere) least = std::min(least, distance(leg + 1, to));
  return std::min(least + 1, unreachable);
}

void TourTable::fill_turns(std::int32_t leg, Location location) {
  if (is_end(leg, location)) return;  // zero
  const std::int32_t next_leg = agent_->leg_after(leg, location);
  const std::int32_t next_distance = distance(leg, location) - 1;
  std::uint16_t* turns_here = &turns_[index(leg, location) * heading_count];
  // straight[d]: fewest turns for a robot that goes on in direction d, if that is a shortest way
  constexpr std::int32_t no_way = INT16_MAX;
  std::array<std::int32_t, GridGraph::direction_count> straight;
  std::int32_t fewest = no_way;
  for (Direction d = 0; d < GridGraph::direction_count; ++d) {
    const Location to = graph_->neighbor(location, d);
    const bool is_shortest = to != nowhere && distance(next_leg, to) == next_distance;
    straight[static_cast<std::size_t>(d)] = is_shortest ? turns(next_leg, to, d) : no_way;
    fewest = std::min(fewest, straight[static_cast<std::size_t>(d)]);
  }
  for (Direction heading = 0; heading < GridGraph::direction_count; ++heading)
    turns_here[heading] = static_cast<std::uint16_t>(std::min(straight[static_cast<std::size_t>(heading)], fewest + 1));
  turns_here[GridGraph::no_direction] = static_cast<std::uint16_t>(fewest);
  if (distance(next_leg, location) != next_distance) return;
  // a wait, between equal goals
  for (Direction heading = 0; heading <= GridGraph::no_direction; ++heading)
    turns_here[heading] = std::min(turns_here[heading], static_cast<std::uint16_t>(turns(next_leg, location, heading)));
}

std::vector<Location> TourTable::shortest_path() const {
  std::vector<Location> path;
  Location location = agent_->start;
  std::int32_t leg = 0;
  Direction heading = GridGraph::no_direction;
  if (location == nowhere || distance(leg, location) >= unreachable) return path;
  path.push_back(location);
  while (!is_end(leg, location)) {
    const std::int32_t next_leg = agent_->leg_after(leg, location);
    const std::int32_t next_distance = distance(leg, location) - 1;
    const std::int32_t turns_left = turns(leg, location, heading);
    Location next = location;  // a wait, between equal goals
    for (Direction d = 0; d < GridGraph::direction_count; ++d) {
      const Location to = graph_->neighbor(location, d);
      if (to == nowhere || distance(next_leg, to) != next_distance) continue;
      const bool turn = heading != GridGraph::no_direction && d != heading;
      if (turns(next_leg, to, d) + (turn ? 1 : 0) != turns_left) continue;
      next = to;
      heading = d;
      break;
    }
    location = next;
    leg = next_leg;
    path.push_back(location);
  }
  return path;
}

std::optional<std::vector<TourTable>> make_tour_tables(const Problem& problem, StopSignal& stop) {
  std::vector<TourTable> tables;
  tables.reserve(problem.agents.size());
  for (const Agent& agent : problem.agents) {
    tables.emplace_back(problem.graph, agent, stop);
    if (stop.raised()) return std::nullopt;
  }
  return tables;
}

std::optional<std::uint32_t> find_cut_off_robot(const Problem& problem, const std::vector<TourTable>& tables) {
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const Agent& agent = problem.agents[i];
    if (agent.start == nowhere || tables[i].distance(0, agent.start) >= TourTable::unreachable) return agent.robot;
  }
  return std::nullopt;
}

}  // namespace dmrp::planners
