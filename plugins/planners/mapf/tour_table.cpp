// SPDX-License-Identifier: MIT
#include "planners/mapf/tour_table.hpp"

#include <algorithm>

namespace dmrp::planners {

TourTable::TourTable(const GridGraph& graph, const Agent& agent)
    : graph_(&graph),
      tiles_a_leg_(static_cast<std::size_t>(graph.location_count()) / tile_size + 1),
      tiles_(agent.goals.size() * tiles_a_leg_, &no_labels) {
  Location from = agent.start;
  for (const Location goal : agent.goals) {
    searches_.push_back({from == nowhere ? goal : from, {}, {}, {}});
    from = goal;
  }
  for (std::int32_t leg = agent.last_leg(); leg >= 0; --leg) {
    const Location goal = agent.goal(leg);
    const std::int32_t rest = goal == nowhere ? unreachable : rest_of_tour(agent, leg);
    if (rest >= unreachable) continue;
    set(leg, goal, {rest, false});
    searches_[static_cast<std::size_t>(leg)].open.push_back(goal);
  }
}

// Counts the steps from the goal of a leg to the end of the tour.
std::int32_t TourTable::rest_of_tour(const Agent& agent, std::int32_t leg) const {
  if (leg == agent.last_leg()) return 0;
  const Location goal = agent.goal(leg);
  std::int32_t least = distance(leg + 1, goal);
  for (Direction d = 0; d < GridGraph::direction_count; ++d)
    if (const Location to = graph_->neighbor(goal, d); to != nowhere) least = std::min(least, distance(leg + 1, to));
  return std::min(least + 1, unreachable);
}

// A location without a label counts as unreachable so far.
TourTable::Label TourTable::label(std::int32_t leg, Location location) const {
  const Tile& tile = *tile_of(leg, location);
  const std::int32_t packed = tile.packed[place(location)];
  if (packed == 0) return {unreachable, false};
  const bool is_expanded = packed % 2 != 0;
  if (packed < 2 * far) return {tile.base + packed / 2, is_expanded};
  return {searches_[static_cast<std::size_t>(leg)].far.find(location)->second, is_expanded};
}

void TourTable::set(std::int32_t leg, Location location, Label label) const {
  Tile*& tile = tile_of(leg, location);
  if (tile == &no_labels) tile = &own_tiles_.emplace_back(Tile{label.steps - far / 2, {}});
  const std::int32_t beyond = label.steps - tile->base;
  const bool fits = beyond > 0 && beyond < far;
  if (!fits) searches_[static_cast<std::size_t>(leg)].far[location] = label.steps;
  tile->packed[place(location)] = static_cast<std::uint16_t>(2 * (fits ? beyond : far) + (label.is_expanded ? 1 : 0));
}

std::int32_t TourTable::search_on(std::int32_t leg, Location location) const {
  Search& search = searches_[static_cast<std::size_t>(leg)];
  if (const Label known = label(leg, location); known.is_expanded) return known.steps;  // they are in Search::far
  for (;;) {
    if (search.open.empty()) search.open.swap(search.beyond);
    if (search.open.empty()) return unreachable;
    const Location to = search.open.back();
    search.open.pop_back();
    const auto [steps, is_expanded] = label(leg, to);
    if (is_expanded) continue;  // it was found on a shorter way since
    set(leg, to, {steps, true});
    const std::int32_t east = graph_->column(search.toward) - graph_->column(to);
    const std::int32_t north = graph_->row(search.toward) - graph_->row(to);
    // Tells of each direction whether a move in it begins nearer than it ends.
    const std::array<bool, 4> begins_nearer = {(east < 0), (north < 0), (east > 0), (north > 0)};
    for (Direction d = 0; d < GridGraph::direction_count; ++d) {
      const Location from = graph_->predecessor(to, d);
      if (from == nowhere || label(leg, from).steps <= steps + 1) continue;
      set(leg, from, {steps + 1, false});
      (begins_nearer[static_cast<std::size_t>(d)] ? search.open : search.beyond).push_back(from);
    }
    if (to == location) return steps;
  }
}

std::optional<std::vector<TourTable>> make_tour_tables(const Problem& problem, StopSignal& stop) {
  std::vector<TourTable> tables;
  tables.reserve(problem.agents.size());
  for (const Agent& agent : problem.agents) {
    tables.emplace_back(problem.graph, agent);
    if (agent.start != nowhere) tables.back().distance(0, agent.start);  // most of the work, so that a stop is seen
    if (stop.poll_now()) return std::nullopt;
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
