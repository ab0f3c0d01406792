// SPDX-License-Identifier: MIT
#include "tour_distances.hpp"

namespace dmrp::planners::ecbs8 {

TourDistances::TourDistances(const Graph& graph, const Agent& agent, StopSignal& stop)
    : graph_(&graph),
      agent_(&agent),
      distance_(agent.goals.size() * static_cast<std::size_t>(graph.location_count()), unreachable),
      turns_(distance_.size()),
      is_settled_(static_cast<std::size_t>(graph.location_count())) {
  for (std::int32_t leg = agent.last_leg(); leg >= 0 && !stop.raised(); --leg) fill_leg(leg, stop);
}

// Dijkstra's search from the goal. No step costs less than a straight one, so the order within a bucket that is one
// straight step wide does not matter, and three buckets are enough.
void TourDistances::fill_leg(std::int32_t leg, StopSignal& stop) {
  const Location goal = agent_->goal(leg);
  if (goal == nowhere) return;
  const Cost base = distance_at_goal(leg);
  if (base >= unreachable) return;
  std::fill(is_settled_.begin(), is_settled_.end(), std::uint8_t{0});
  distance_[index(leg, goal)] = base;
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
  for (Direction d = 0; d < Graph::direction_count; ++d) {
    const Location from = graph_->predecessor(location, d);
    if (from == nowhere) continue;
    const Cost cost = here + step_cost(d);
    Cost& known = distance_[index(leg, from)];
    if (known <= cost) continue;
    known = cost;
    buckets_[static_cast<std::size_t>((cost - base) / straight_cost) % 3].push_back(from);
  }
}

Cost TourDistances::distance_at_goal(std::int32_t leg) const {
  if (leg == agent_->last_leg()) return 0;
  const Location goal = agent_->goal(leg);
  Cost least = distance(leg + 1, goal) + wait_cost;
  for (Direction d = 0; d < Graph::direction_count; ++d)
    if (const Location to = graph_->neighbor(goal, d); to != nowhere)
      least = std::min(least, distance(leg + 1, to) + step_cost(d));
  return std::min(least, unreachable);
}

// The best successors have been settled before.
void TourDistances::fill_turns(std::int32_t leg, Location location) {
  TurnsByHeading& here = turns_[index(leg, location)];
  if (leg == agent_->last_leg() && location == agent_->last_goal()) return;  // zero
  const std::int32_t next_leg = agent_->leg_after(leg, location);
  const Cost distance_here = distance(leg, location);
  constexpr std::uint16_t no_way = INT16_MAX;
  here.fill(no_way);
  std::uint16_t fewest = no_way;
  for (Direction d = 0; d < Graph::direction_count; ++d) {
    const Location to = graph_->neighbor(location, d);
    if (to == nowhere || distance(next_leg, to) + step_cost(d) != distance_here) continue;
    const auto heading = static_cast<std::size_t>(d);
    here[heading] = turns_[index(next_leg, to)][heading];
    fewest = std::min(fewest, here[heading]);
  }
  for (std::uint16_t& turns : here) turns = std::min(turns, static_cast<std::uint16_t>(fewest + 1));
  // a wait, between equal goals
  if (distance(next_leg, location) + wait_cost != distance_here) return;
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
