// SPDX-License-Identifier: MIT
#include "planners/lns/neighborhoods.hpp"

#include <algorithm>

namespace dmrp::planners {

namespace {

constexpr int walks_a_robot = 10;        // random ways of one robot
constexpr std::size_t ways_a_robot = 4;  // shortest ways looked at for each robot of a set

}  // namespace

Neighborhoods::Neighborhoods(const Problem& problem, const std::vector<TourTable>& tables, const ImprovingPlan& plan,
                             toolkit::Stream& random)
    : problem_(problem),
      tables_(tables),
      plan_(plan),
      random_(random),
      is_tabu_(problem.agents.size(), false),
      is_in_(problem.agents.size(), false),
      is_seen_(static_cast<std::size_t>(problem.graph.location_count()), false),
      resting_(static_cast<std::size_t>(problem.graph.location_count()), -1) {
  for (std::size_t i = 0; i < problem.agents.size(); ++i)
    resting_[static_cast<std::size_t>(problem.agents[i].last_goal())] = static_cast<std::int32_t>(i);
  for (Location location = 0; location < problem.graph.location_count(); ++location) {
    int neighbors = 0;
    for (Direction d = 0; d < GridGraph::direction_count; ++d)
      if (problem.graph.neighbor(location, d) != nowhere) ++neighbors;
    if (neighbors > 2) junctions_.push_back(location);
  }
  if (junctions_.empty())
    for (const Agent& agent : problem.agents) junctions_.push_back(agent.start);
}

std::int32_t Neighborhoods::lost(std::int32_t agent) const {
  const auto i = static_cast<std::size_t>(agent);
  return cost_of(plan_.paths[i]) - tables_[i].distance(0, problem_.agents[i].start);
}

void Neighborhoods::draw(std::vector<std::int32_t>& agents) {
  agents.clear();
  std::int32_t last = -1;
  const Rule rule = static_cast<Rule>(rule_.draw(random_));
  const std::size_t size =
      std::min(rule == Rule::goal ? robots_around_goal : sizes[size_.draw(random_)], problem_.agents.size());
  switch (rule) {
    case Rule::agent:
      add_around_agent(size, agents);
      break;
    case Rule::map:
      add_around_junction(size, agents);
      break;
    case Rule::random:
      add_any(size, agents);
      break;
    case Rule::delay:
      add_by_delay(size, agents);
      break;
    case Rule::goal:
      last = add_around_goal(size, agents);
      break;
  }
  for (const std::int32_t agent : agents) is_in_[static_cast<std::size_t>(agent)] = false;
  random_.shuffle(agents);
  if (last >= 0) std::iter_swap(std::find(agents.begin(), agents.end(), last), agents.end() - 1);
}

void Neighborhoods::learn(std::int64_t gain, std::int64_t work) {
  rule_.learn(gain, work);
  if (static_cast<Rule>(rule_.drawn()) != Rule::goal) size_.learn(gain, work);
}

void Neighborhoods::add(std::int32_t agent, std::vector<std::int32_t>& agents) {
  if (is_in_[static_cast<std::size_t>(agent)]) return;
  is_in_[static_cast<std::size_t>(agent)] = true;
  agents.push_back(agent);
}

// The robot that loses most among those that were not begun with lately.
std::int32_t Neighborhoods::most_delayed() {
  const auto find = [this] {
    std::int32_t most = -1;
    for (std::int32_t agent = 0; agent < static_cast<std::int32_t>(is_tabu_.size()); ++agent)
      if (!is_tabu_[static_cast<std::size_t>(agent)] && lost(agent) > 0 && (most < 0 || lost(agent) > lost(most)))
        most = agent;
    return most;
  };
  std::int32_t found = find();
  if (found < 0) {
    std::fill(is_tabu_.begin(), is_tabu_.end(), false);
    found = find();
  }
  if (found >= 0) is_tabu_[static_cast<std::size_t>(found)] = true;
  return found;
}

void Neighborhoods::add_around_agent(std::size_t size, std::vector<std::int32_t>& agents) {
  const std::int32_t first = most_delayed();
  if (first < 0) return add_any(size, agents);
  add(first, agents);
  std::int32_t agent = first;
  for (int walks = 0; agents.size() < size && walks < walks_a_robot; ++walks) {
    walk(agent, size, agents);
    agent = agents[random_.below(agents.size())];
  }
}

// Follows a random way from a random step of the robot's path on which it could still arrive earlier than it does, and
// adds the robots in its way.
void Neighborhoods::walk(std::int32_t agent, std::size_t size, std::vector<std::int32_t>& agents) {
  const auto i = static_cast<std::size_t>(agent);
  const std::vector<Location>& path = plan_.paths[i];
  if (path.size() < 2) return;
  const auto begin = static_cast<std::size_t>(random_.below(path.size() - 1));
  std::int32_t leg = 0;
  for (std::size_t t = 0; t < begin; ++t) leg = problem_.agents[i].leg_after(leg, path[t]);
  Location here = path[begin];
  std::array<Location, 2> step{};
  std::vector<std::int32_t> met;
  for (auto t = static_cast<std::int32_t>(begin); t < cost_of(path) && agents.size() < size; ++t) {
    leg = problem_.agents[i].leg_after(leg, here);
    std::array<Location, GridGraph::direction_count + 1> ways{};
    std::size_t count = 0;
    for (Direction d = 0; d <= GridGraph::direction_count; ++d) {
      const Location to = d == GridGraph::direction_count ? here : problem_.graph.neighbor(here, d);
      if (to != nowhere && t + 1 + tables_[i].distance(leg, to) < cost_of(path)) ways[count++] = to;
    }
    if (count == 0) return;
    step = {here, ways[random_.below(count)]};
    plan_.occupied.list_step_conflicts(step[0], step[1], t + 1, met);
    for (const std::int32_t other : met)
      if (other != agent && agents.size() < size) add(other, agents);
    here = step[1];
  }
}

void Neighborhoods::add_around_junction(std::size_t size, std::vector<std::int32_t>& agents) {
  queue_.assign(1, junctions_[random_.below(junctions_.size())]);
  is_seen_[static_cast<std::size_t>(queue_[0])] = true;
  for (std::size_t next = 0; next < queue_.size() && agents.size() < size; ++next) {
    const auto there = plan_.occupied.occupations(queue_[next]);
    const std::size_t from = there.empty() ? 0 : static_cast<std::size_t>(random_.below(there.size()));
    for (std::size_t i = 0; i < there.size() && agents.size() < size; ++i)
      add(there[(from + i) % there.size()].agent, agents);
    for (Direction d = 0; d < GridGraph::direction_count; ++d) {
      const Location to = problem_.graph.neighbor(queue_[next], d);
      if (to == nowhere || is_seen_[static_cast<std::size_t>(to)]) continue;
      is_seen_[static_cast<std::size_t>(to)] = true;
      queue_.push_back(to);
    }
  }
  for (const Location location : queue_) is_seen_[static_cast<std::size_t>(location)] = false;
}

void Neighborhoods::add_any(std::size_t size, std::vector<std::int32_t>& agents) {
  while (agents.size() < size) add(static_cast<std::int32_t>(random_.below(problem_.agents.size())), agents);
}

void Neighborhoods::add_by_delay(std::size_t size, std::vector<std::int32_t>& agents) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < problem_.agents.size(); ++i)
    if (!is_in_[i]) sum += lost(static_cast<std::int32_t>(i));
  while (agents.size() < size && sum > 0) {
    auto at = static_cast<std::int64_t>(random_.below(static_cast<std::uint64_t>(sum)));
    for (std::int32_t agent = 0;; ++agent) {
      if (is_in_[static_cast<std::size_t>(agent)]) continue;
      at -= lost(agent);
      if (at >= 0) continue;
      sum -= lost(agent);
      add(agent, agents);
      break;
    }
  }
  add_any(size, agents);
}

// The robot that rests in the way of the others; -1 if there is none.
std::int32_t Neighborhoods::add_around_goal(std::size_t size, std::vector<std::int32_t>& agents) {
  add_by_delay(1, agents);
  const std::int32_t first = agents[0];
  follow_shortest_way(first);
  std::vector<std::int32_t> resting;
  for (const Location location : way_)
    if (const std::int32_t other = resting_[static_cast<std::size_t>(location)]; other >= 0 && other != first)
      resting.push_back(other);
  if (resting.empty()) {
    add_by_delay(size, agents);
    return -1;
  }
  const std::int32_t last = resting[random_.below(resting.size())];
  const Location goal = problem_.agents[static_cast<std::size_t>(last)].last_goal();
  add(last, agents);
  const std::size_t count = problem_.agents.size();
  const auto from = static_cast<std::size_t>(random_.below(count));
  for (std::size_t i = 0; i < std::min(count, ways_a_robot * size) && agents.size() < size; ++i) {
    const auto agent = static_cast<std::int32_t>((from + i) % count);
    if (lost(agent) == 0) continue;
    follow_shortest_way(agent);
    if (std::find(way_.begin(), way_.end(), goal) != way_.end()) add(agent, agents);
  }
  return last;
}

// One of the robot's shortest ways, alone, at random.
void Neighborhoods::follow_shortest_way(std::int32_t agent) {
  const Agent& robot = problem_.agents[static_cast<std::size_t>(agent)];
  const TourTable& table = tables_[static_cast<std::size_t>(agent)];
  way_.assign(1, robot.start);
  std::int32_t leg = 0;
  for (std::int32_t left = table.distance(0, robot.start); left > 0; --left) {
    const Location here = way_.back();
    leg = robot.leg_after(leg, here);
    Location next = here;  // two equal goals in a row cost a wait
    std::uint64_t found = 0;
    for (Direction d = 0; d < GridGraph::direction_count; ++d) {
      const Location to = problem_.graph.neighbor(here, d);
      if (to != nowhere && table.distance(leg, to) == left - 1 && random_.below(++found) == 0) next = to;
    }
    way_.push_back(next);
  }
}

}  // namespace dmrp::planners
