// SPDX-License-Identifier: MIT
#include "planners/ecbs8/tour_distances.hpp"

#include <bit>

namespace dmrp::planners::ecbs8 {

TourDistances::TourDistances(const Graph& graph, const Agent& agent, StopSignal& stop)
    : graph_(&graph),
      agent_(&agent),
      distance_(agent.goals.size() * static_cast<std::size_t>(graph.location_count()), unreachable),
      turns_(distance_.size()),
      best_moves_(distance_.size(), 0),
      is_settled_(static_cast<std::size_t>(graph.location_count())) {
  for (std::int32_t leg = agent.last_leg(); leg >= 0 && !stop.raised(); --leg) fill_leg(leg, stop);
}

// Dijkstra's search from the goal. No step costs less than a straight one, so the order within a bucket that is one
// straight step wide does not matter, and three buckets are enough.
void TourDistances::fill_leg(std::int32_t leg, StopSignal& stop) {
  const Location goal = agent_->goal(leg);
  if (goal == nowhere) return;
  begin_at_goal(leg);
  const Cost base = distance(leg, goal);
  if (base >= unreachable) return;
  std::fill(is_settled_.begin(), is_settled_.end(), std::uint8_t{0});
  buckets_[0].push_back(goal);
  for (std::size_t k = 0; !buckets_[k % 3].empty() || !buckets_[(k + 1) % 3].empty(); ++k) {
    std::vector<Location>& bucket = buckets_[k % 3];
    for (const Location location : bucket) {
      if (stop.poll()) return;
      if (is_settled_[static_cast<std::size_t>(location)]) continue;
      is_settled_[static_cast<std::size_t>(location)] = 1;
      fill_turns(leg, location);
      offer_to_predecessors(leg, location, base);
    }
    bucket.clear();
  }
}

void TourDistances::offer_to_predecessors(std::int32_t leg, Location location, Cost base) {
  const Cost here = distance(leg, location);
  Cost* const distances = &distance_[index(leg, 0)];
  std::uint8_t* const best_moves = &best_moves_[index(leg, 0)];
  for (Direction d = 0; d < Graph::direction_count; ++d) {
    const Location from = graph_->predecessor(location, d);
    if (from == nowhere) continue;
    const Cost cost = here + step_cost(d);
    const auto bit = static_cast<std::uint8_t>(1 << d);
    Cost& known = distances[from];
    if (known < cost) continue;
    if (known == cost) {
      best_moves[from] |= bit;
      continue;
    }
    known = cost;
    best_moves[from] = bit;
    buckets_[static_cast<std::size_t>((cost - base) / straight_cost) % 3].push_back(from);
  }
}

// The distance from the goal of a leg to the end of the tour, by way of the next leg.
void TourDistances::begin_at_goal(std::int32_t leg) {
  const Location goal = agent_->goal(leg);
  Cost& least = distance_[index(leg, goal)];
  if (leg == agent_->last_leg()) {
    least = 0;
    return;
  }
  least = std::min(unreachable, distance(leg + 1, goal) + wait_cost);
  for (Direction d = 0; d < Graph::direction_count; ++d) {
    const Location to = graph_->neighbor(goal, d);
    if (to == nowhere) continue;
    const Cost cost = distance(leg + 1, to) + step_cost(d);
    const auto bit = static_cast<std::uint8_t>(1 << d);
    if (cost == least) best_moves_[index(leg, goal)] |= bit;
    if (cost >= least) continue;
    least = cost;
    best_moves_[index(leg, goal)] = bit;
  }
}

// Call it in the order of settling: it reads the turns of the best successors.
void TourDistances::fill_turns(std::int32_t leg, Location location) {
  TurnsByHeading& here = turns_[index(leg, location)];
  if (leg == agent_->last_leg() && location == agent_->last_goal()) return;  // zero
  const std::int32_t next_leg = agent_->leg_after(leg, location);
  constexpr std::uint16_t no_way = INT16_MAX;
  std::uint16_t fewest = no_way;
  TurnsByHeading straight;  // fewest turns if the next move is straight ahead
  straight.fill(no_way);
  for (unsigned moves = best_moves_[index(leg, location)]; moves != 0; moves &= moves - 1) {
    const auto d = static_cast<std::size_t>(std::countr_zero(moves));
    straight[d] = turns_[index(next_leg, graph_->neighbor(location, static_cast<Direction>(d)))][d];
    fewest = std::min(fewest, straight[d]);
  }
  const auto with_turn = static_cast<std::uint16_t>(fewest + 1);
  for (std::size_t heading = 0; heading < here.size(); ++heading)
    here[heading] = std::min(straight[heading], with_turn);
  // a wait, between equal goals
  if (next_leg == leg || distance(next_leg, location) + wait_cost != distance(leg, location)) return;
  const TurnsByHeading& after = turns_[index(next_leg, location)];
  for (std::size_t heading = 0; heading < here.size(); ++heading)
    here[heading] = std::min(here[heading], after[heading]);
}

std::optional<std::vector<TourDistances>> make_tour_distances(const Problem& problem, StopSignal& stop) {
  std::vector<TourDistances> all;
  all.reserve(problem.agents.size());
  for (const Agent& agent : problem.agents) {
    all.emplace_back(problem.graph, agent, stop);
    if (stop.raised()) return std::nullopt;
  }
  return all;
}

std::optional<std::uint32_t> find_cut_off_robot(const Problem& problem, const std::vector<TourDistances>& distances) {
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const Agent& agent = problem.agents[i];
    if (agent.start == nowhere || distances[i].distance(0, agent.start) >= unreachable) return agent.robot;
  }
  return std::nullopt;
}

}  // namespace dmrp::planners::ecbs8
