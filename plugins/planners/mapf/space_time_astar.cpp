// SPDX-License-Identifier: MIT
#include "space_time_astar.hpp"

#include <algorithm>

namespace dmrp::planners {

bool SpaceTimeAStar::is_worse(const OpenEntry& a, const OpenEntry& b) {
  if (b.key < a.key) return true;
  if (a.key < b.key) return false;
  return a.state < b.state;
}

SpaceTimeAStar::Result SpaceTimeAStar::search(const Agent& agent, const TourTable& table,
                                              const ConstraintTable& constraints, const ConflictTable& others,
                                              StopSignal& stop, std::vector<Location>& path) {
  const Task task{agent,
                  table,
                  constraints,
                  others,
                  std::max(constraints.free_from(), others.rest_from() + 1),
                  constraints.rest_from(agent.last_goal())};
  begin();
  generate(task, agent.start, 0, GridGraph::no_direction, 0, 0, 0, -1);
  while (!open_.empty()) {
    if (stop.poll()) return Result::stopped;
    std::pop_heap(open_.begin(), open_.end(), is_worse);
    const std::int32_t best = open_.back().state;
    open_.pop_back();
    const State& state = states_[static_cast<std::size_t>(best)];
    if (state.superseded) continue;
    if (is_end(task, state)) {
      path.resize(static_cast<std::size_t>(state.key.t) + 1);
      for (std::int32_t i = best; i >= 0; i = states_[static_cast<std::size_t>(i)].parent)
        path[static_cast<std::size_t>(states_[static_cast<std::size_t>(i)].key.t)] =
            states_[static_cast<std::size_t>(i)].location;
      return Result::found;
    }
    ++expanded_;
    generate_successors(task, best);
  }
  return Result::none;
}

bool SpaceTimeAStar::is_end(const Task& task, const State& state) const {
  return state.location == task.agent.last_goal() && state.leg == task.agent.last_leg() &&
         state.key.t >= task.rest_from;
}

void SpaceTimeAStar::generate_successors(const Task& task, std::int32_t parent) {
  const State state = states_[static_cast<std::size_t>(parent)];
  const std::int32_t leg = task.agent.leg_after(state.leg, state.location);
  const std::int32_t t = state.key.t + 1;
  const auto arrive = [&](Location to, Direction heading, std::int32_t turns) {
    if (!task.constraints.allows(state.location, to, t)) return;
    const std::int32_t conflicts = state.key.conflicts + task.others.count_at(state.location, to, t);
    generate(task, to, leg, heading, turns, conflicts, t, parent);
  };
  arrive(state.location, state.heading, state.turns);
  for (Direction d = 0; d < GridGraph::direction_count; ++d) {
    const Location to = graph_.neighbor(state.location, d);
    const bool turn = state.heading != GridGraph::no_direction && state.heading != d;
    if (to != nowhere) arrive(to, d, state.turns + (turn ? 1 : 0));
  }
}

void SpaceTimeAStar::generate(const Task& task, Location location, std::int32_t leg, Direction heading,
                              std::int32_t turns, std::int32_t conflicts, std::int32_t t, std::int32_t parent) {
  const std::int32_t distance = task.table.distance(leg, location);
  if (distance >= TourTable::unreachable) return;
  // With time to spare a longer way may have fewer turns than the shortest: then nothing is known of them.
  const bool in_haste = t + distance >= task.rest_from;
  const std::int32_t turns_left = in_haste ? task.table.turns(leg, location, heading) : 0;
  State state{{std::max(t + distance, task.rest_from), conflicts, turns + turns_left, t},
              location,
              parent,
              leg,
              turns,
              static_cast<std::int8_t>(heading),
              false};
  if (is_end(task, state)) state.key.conflicts += task.others.count_after(location, t);

  Slot& slot = find_slot(identity_of(task, state));
  if (slot.epoch == epoch_) {
    State& known = states_[static_cast<std::size_t>(slot.state)];
    if (!(state.key < known.key)) return;
    known.superseded = true;
  } else {
    slot.epoch = epoch_;
    slot.identity = identity_of(task, state);
  }
  slot.state = static_cast<std::int32_t>(states_.size());
  states_.push_back(state);
  open_.push_back({state.key, slot.state});
  std::push_heap(open_.begin(), open_.end(), is_worse);
  if (states_.size() * 2 > slots_.size()) grow_slots();
}

std::uint64_t SpaceTimeAStar::identity_of(const Task& task, const State& state) const {
  const auto time = static_cast<std::uint64_t>(std::min(state.key.t, task.static_from));
  const auto place = static_cast<std::uint64_t>(state.leg) * static_cast<std::uint64_t>(graph_.location_count()) +
                     static_cast<std::uint64_t>(state.location);
  const auto times = static_cast<std::uint64_t>(task.static_from) + 1;
  return (place * times + time) * (GridGraph::direction_count + 1) + static_cast<std::uint64_t>(state.heading);
}

SpaceTimeAStar::Slot& SpaceTimeAStar::find_slot(std::uint64_t identity) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t i = static_cast<std::size_t>((identity * 0x9E3779B97F4A7C15u) >> 32) & mask;
  while (slots_[i].epoch == epoch_ && slots_[i].identity != identity) i = (i + 1) & mask;
  return slots_[i];
}

void SpaceTimeAStar::grow_slots() {
  std::vector<Slot> old(slots_.size() * 2, Slot{0, 0, -1});
  old.swap(slots_);
  for (const Slot& slot : old)
    if (slot.epoch == epoch_) find_slot(slot.identity) = slot;
}

void SpaceTimeAStar::begin() {
  if (slots_.empty()) slots_.assign(1 << 12, Slot{0, 0, -1});
  ++epoch_;
  states_.clear();
  open_.clear();
}

}  // namespace dmrp::planners
