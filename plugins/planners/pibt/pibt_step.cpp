// SPDX-License-Identifier: MIT
#include "planners/pibt/pibt_step.hpp"

#include <algorithm>
#include <numeric>

namespace dmrp::planners {

Configuration start_configuration(const Problem& problem) {
  Configuration start;
  for (const Agent& agent : problem.agents) start.locations.push_back(agent.start);
  start.legs.assign(problem.agents.size(), 0);
  return start;
}

PibtStep::PibtStep(const Problem& problem, const std::vector<TourTable>& tables)
    : problem_(problem),
      tables_(tables),
      degrees_(static_cast<std::size_t>(problem.graph.location_count()), 0),
      legs_(problem.agents.size(), 0),
      here_(degrees_.size(), nobody),
      taken_(degrees_.size(), nobody),
      next_(problem.agents.size(), nowhere) {
  for (Location location = 0; location < problem.graph.location_count(); ++location)
    for (Direction d = 0; d < GridGraph::direction_count; ++d)
      if (problem.graph.neighbor(location, d) != nowhere) ++degrees_[static_cast<std::size_t>(location)];
}

bool PibtStep::step(const Configuration& from, std::span<const std::int32_t> order, std::span<const Fixed> fixed,
                    toolkit::Stream& random, Configuration& to) {
  from_ = &from;
  for (std::size_t i = 0; i < next_.size(); ++i) {
    legs_[i] = problem_.agents[i].leg_after(from.legs[i], from.locations[i]);
    next_[i] = nowhere;
    here_[static_cast<std::size_t>(from.locations[i])] = static_cast<std::int32_t>(i);
  }
  bool succeeded = set_fixed(fixed);
  for (std::size_t i = 0; succeeded && i < order.size(); ++i)
    succeeded = next_of(order[i]) != nowhere || choose(order[i], random);
  clear(from);
  if (!succeeded) return false;
  to.locations = next_;
  to.legs = legs_;
  return true;
}

void PibtStep::clear(const Configuration& from) {
  for (std::size_t i = 0; i < next_.size(); ++i) {
    here_[static_cast<std::size_t>(from.locations[i])] = nobody;
    taken_by(from.locations[i]) = nobody;
    if (next_[i] != nowhere) taken_by(next_[i]) = nobody;
  }
}

bool PibtStep::set_fixed(std::span<const Fixed> fixed) {
  for (const Fixed& move : fixed) {
    const std::int32_t there = robot_at(move.to);
    const bool swaps = there != nobody && there != move.agent && next_of(there) == where(move.agent);
    if (taken_by(move.to) != nobody || swaps) return false;
    reserve(move.agent, move.to);
  }
  return true;
}

void PibtStep::reserve(std::int32_t agent, Location to) {
  next_of(agent) = to;
  taken_by(to) = agent;
}

// The robot chooses its move; robots that it pushes choose theirs before. False if it has to stay, or cannot even stay.
bool PibtStep::choose(std::int32_t agent, toolkit::Stream& random) {
  stack_.clear();
  stack_.push_back(begin_choice(agent, random));
  bool pushed_has_moved = false;
  for (;;) {
    Choice& choice = stack_.back();
    bool succeeded = pushed_has_moved;
    std::int32_t pushes = nobody;
    while (!succeeded && pushes == nobody && choice.next < choice.count) {
      const Location to = choice.to[choice.next++];
      const std::int32_t there = robot_at(to);
      if (taken_by(to) != nobody || (there != nobody && next_of(there) == where(choice.agent))) continue;
      reserve(choice.agent, to);
      if (there == nobody || there == choice.agent || next_of(there) != nowhere)
        succeeded = true;
      else
        pushes = there;
    }
    if (pushes != nobody) {
      stack_.push_back(begin_choice(pushes, random));
      continue;
    }
    if (succeeded)
      pull(choice);
    else
      reserve(choice.agent, where(choice.agent));
    pushed_has_moved = succeeded;
    stack_.pop_back();
    if (stack_.empty()) return succeeded;
  }
}

// Sorts the moves by the distance left. A swap reverses their order.
PibtStep::Choice PibtStep::begin_choice(std::int32_t agent, toolkit::Stream& random) {
  Choice choice{agent, nobody, {}, 0, 0};
  const Location here = where(agent);
  std::uint64_t ties = random.next_u64();
  std::array<std::uint64_t, choices> ranks{};
  for (Direction d = 0; d <= GridGraph::direction_count; ++d, ties >>= 12) {
    const Location to = d == GridGraph::direction_count ? here : problem_.graph.neighbor(here, d);
    if (to == nowhere) continue;
    const std::int32_t left = steps_left(agent, to);
    if (left >= TourTable::unreachable) continue;
    const std::uint64_t rank = static_cast<std::uint64_t>(left) << 12 | (ties & 0xfff);
    std::size_t at = choice.count++;
    for (; at > 0 && ranks[at - 1] > rank; --at) {
      ranks[at] = ranks[at - 1];
      choice.to[at] = choice.to[at - 1];
    }
    ranks[at] = rank;
    choice.to[at] = to;
  }
  if (choice.count == 0) return choice;
  choice.pulled = find_swap(agent, choice.to[0]);
  if (choice.pulled != nobody) std::reverse(choice.to.begin(), choice.to.begin() + choice.count);
  return choice;
}

// After a swap's first choice, the other robot takes the place that this one leaves.
void PibtStep::pull(const Choice& choice) {
  const std::int32_t other = choice.pulled;
  const Location left = where(choice.agent);
  if (other == nobody || choice.next != 1 || next_of(other) != nowhere || taken_by(left) != nobody) return;
  if (can_move(where(other), left)) reserve(other, left);
}

bool PibtStep::can_move(Location from, Location to) const {
  for (Direction d = 0; d < GridGraph::direction_count; ++d)
    if (problem_.graph.neighbor(from, d) == to) return true;
  return false;
}

// The robot with which this one has to exchange its place, and can; or nobody.
std::int32_t PibtStep::find_swap(std::int32_t agent, Location first_choice) const {
  const Line line{where(agent), first_choice};
  if (line.front == line.rear) return nobody;
  const std::int32_t opponent = find_opponent(agent, line);
  return opponent != nobody && reaches_branch({line.front, line.rear}) ? opponent : nobody;
}

// The robot stands at the rear of the line and wants to the front. Its opponent comes from there, or is another
// neighbor that wants to follow it: that one passes first, and then the robot need not come back to let it out.
std::int32_t PibtStep::find_opponent(std::int32_t agent, Line line) const {
  const std::int32_t ahead = robot_at(line.front);
  if (ahead != nobody && next_of(ahead) == nowhere && block_each_other(agent, ahead, line)) return ahead;
  for (Direction d = 0; d < GridGraph::direction_count; ++d) {
    const Location beside = problem_.graph.neighbor(line.rear, d);
    const std::int32_t follower = beside == nowhere || beside == line.front ? nobody : robot_at(beside);
    if (follower != nobody && block_each_other(follower, agent, line)) return follower;
  }
  return nobody;
}

// Moves a line of two robots by one cell, where its front has one way on. A dead end in which a robot has its goal is
// no way.
PibtStep::WayOn PibtStep::advance(Line& line) const {
  Location way = nowhere;
  for (Direction d = 0; d < GridGraph::direction_count; ++d) {
    const Location to = problem_.graph.neighbor(line.front, d);
    if (to == nowhere || to == line.rear || is_parking_place(to)) continue;
    if (way != nowhere) return WayOn::branch;
    way = to;
  }
  if (way == nowhere) return WayOn::dead_end;
  line = {line.front, way};
  return WayOn::corridor;
}

bool PibtStep::is_parking_place(Location location) const {
  const std::int32_t robot = robot_at(location);
  return robot != nobody && degrees_[static_cast<std::size_t>(location)] == 1 && steps_left(robot, location) == 0;
}

// Pushes the line on as long as the robot at its rear comes nearer to its goal. Whether that ends, before any branch,
// with each robot where the other one has to go; the one at the rear may also have arrived.
bool PibtStep::block_each_other(std::int32_t rear, std::int32_t front, Line line) const {
  const auto wants_on = [&] { return steps_left(rear, line.front) < steps_left(rear, line.rear); };
  for (WayOn way = WayOn::corridor; way == WayOn::corridor && wants_on();) {
    way = advance(line);
    if (way == WayOn::branch) return false;
  }
  const bool wants_back = steps_left(front, line.rear) < steps_left(front, line.front);
  return wants_back && (wants_on() || steps_left(rear, line.rear) == 0);
}

// Whether a corridor leads the line to a branch, at which its robots can change their order.
bool PibtStep::reaches_branch(Line line) const {
  const Location begin = line.rear;
  WayOn way = WayOn::corridor;
  for (Location steps = problem_.graph.location_count(); steps > 0 && way == WayOn::corridor; --steps)
    way = line.front == begin ? WayOn::dead_end : advance(line);
  return way == WayOn::branch;
}

Priorities::Priorities(const Problem& problem, const std::vector<TourTable>& tables)
    : by_distance_(problem.agents.size()) {
  std::iota(by_distance_.begin(), by_distance_.end(), 0);
  const auto distance = [&](std::int32_t agent) {
    const auto i = static_cast<std::size_t>(agent);
    return tables[i].distance(0, problem.agents[i].start);
  };
  std::stable_sort(by_distance_.begin(), by_distance_.end(),
                   [&](std::int32_t a, std::int32_t b) { return distance(a) > distance(b); });
}

void Priorities::sort(std::span<const std::int32_t> steps_underway, std::vector<std::int32_t>& order) const {
  order = by_distance_;
  std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return steps_underway[static_cast<std::size_t>(a)] > steps_underway[static_cast<std::size_t>(b)];
  });
}

std::vector<std::vector<Location>> paths_of(const std::vector<const Configuration*>& configurations,
                                            const std::vector<TourTable>& tables) {
  std::vector<std::vector<Location>> paths(tables.size());
  for (std::size_t i = 0; i < paths.size(); ++i) {
    std::size_t end = configurations.size();
    const auto rests = [&](std::size_t t) {
      return tables[i].distance(configurations[t]->legs[i], configurations[t]->locations[i]) == 0;
    };
    while (end > 1 && rests(end - 1) && rests(end - 2)) --end;
    paths[i].reserve(end);
    for (std::size_t t = 0; t < end; ++t) paths[i].push_back(configurations[t]->locations[i]);
  }
  return paths;
}

}  // namespace dmrp::planners
