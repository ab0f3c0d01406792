// SPDX-License-Identifier: MIT
#include "planners/mapf/tour_table.hpp"

#include <algorithm>

namespace dmrp::planners {

namespace {

// The distance from the goal of a leg to the end of the tour. The later legs must be filled.
std::int32_t rest_of_tour(const TourTable& table, const GridGraph& graph, const Agent& agent, std::int32_t leg) {
  if (leg == agent.last_leg()) return 0;
  const Location goal = agent.goal(leg);
  std::int32_t least = table.distance(leg + 1, goal);
  for (Direction d = 0; d < GridGraph::direction_count; ++d)
    if (const Location to = graph.neighbor(goal, d); to != nowhere)
      least = std::min(least, table.distance(leg + 1, to));
  return std::min(least + 1, TourTable::unreachable);
}

}  // namespace

TourTable::TourTable(const GridGraph& graph, const Agent& agent, std::vector<Location>& queue, StopSignal& stop)
    : location_count_(static_cast<std::size_t>(graph.location_count())),
      distance_(agent.goals.size() * location_count_, unreachable) {
  for (std::int32_t leg = agent.last_leg(); leg >= 0 && !stop.raised(); --leg) fill_leg(graph, agent, leg, queue, stop);
}

// Breadth-first search from the goal.
void TourTable::fill_leg(const GridGraph& graph, const Agent& agent, std::int32_t leg, std::vector<Location>& queue,
                         StopSignal& stop) {
  const Location goal = agent.goal(leg);
  if (goal == nowhere) return;
  const std::int32_t rest = rest_of_tour(*this, graph, agent, leg);
  if (rest >= unreachable) return;
  std::int32_t* const distance = distance_.data() + static_cast<std::size_t>(leg) * location_count_;
  queue.assign(1, goal);
  distance[goal] = rest;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    if (stop.poll()) return;
    const Location location = queue[next];
    for (Direction d = 0; d < GridGraph::direction_count; ++d) {
      const Location from = graph.predecessor(location, d);
      if (from == nowhere || distance[from] < unreachable) continue;
      distance[from] = distance[location] + 1;
      queue.push_back(from);
    }
  }
}

std::optional<std::vector<TourTable>> make_tour_tables(const Problem& problem, StopSignal& stop) {
  std::vector<TourTable> tables;
  tables.reserve(problem.agents.size());
  std::vector<Location> queue;
  for (const Agent& agent : problem.agents) {
    tables.emplace_back(problem.graph, agent, queue, stop);
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
