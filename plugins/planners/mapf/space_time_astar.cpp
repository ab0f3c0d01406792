// SPDX-License-Identifier: MIT
#include "space_time_astar.hpp"

#include <algorithm>

namespace dmrp::planners {

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
  generate(task, {agent.start, -1, 0, 0, 0, 0, GridGraph::no_direction, false});
  while (!open_.empty()) {
    if (stop.poll()) return Result::stopped;
    std::pop_heap(open_.begin(), open_.end(), IsWorse());
    const std::int32_t best = open_.back().state;
    open_.pop_back();
    const State& state = states_[static_cast<std::size_t>(best)];
    if (state.superseded) continue;
    if (is_end(task, state)) {
      trace_back(best, path);
      return Result::found;
    }
    ++expanded_;
    generate_successors(task, best);
  }
  return Result::none;
}

bool SpaceTimeAStar::is_end(const Task& task, const State& state) {
  return state.location == task.agent.last_goal() && state.leg == task.agent.last_leg() && state.t >= task.rest_from;
}

void SpaceTimeAStar::generate_successors(const Task& task, std::int32_t parent) {
  const State state = states_[static_cast<std::size_t>(parent)];
  const std::int32_t leg = task.agent.leg_after(state.leg, state.location);
  const std::int32_t t = state.t + 1;
  const auto arrive = [&](Location to, std::int8_t heading, std::int32_t turns) {
    if (!task.constraints.allows(state.location, to, t)) return;
    const std::int32_t conflicts = state.conflicts + task.others.count_at(state.location, to, t);
    generate(task, {to, parent, leg, t, conflicts, turns, heading, false});
  };
  arrive(state.location, state.heading, state.turns);
  for (Direction d = 0; d < GridGraph::direction_count; ++d) {
    const Location to = graph_.neighbor(state.location, d);
    const bool turn = state.heading != GridGraph::no_direction && state.heading != d;
    if (to != nowhere) arrive(to, static_cast<std::int8_t>(d), state.turns + (turn ? 1 : 0));
  }
}

void SpaceTimeAStar::generate(const Task& task, const State& state) {
  const std::int32_t distance = task.table.distance(state.leg, state.location);
  if (distance >= TourTable::unreachable || !enter(task, state)) return;
  const std::int32_t steps = std::max(state.t + distance, task.rest_from);
  // With time to spare a longer way may have fewer turns than the shortest: then nothing is known of them.
  const bool in_haste = state.t + distance == steps;
  const std::int32_t turns_left = in_haste ? task.table.turns(state.leg, state.location, state.heading) : 0;
  const std::int32_t at_rest = is_end(task, state) ? task.others.count_after(state.location, state.t) : 0;

  open_.push_back({Key(steps, state.conflicts + at_rest, state.turns + turns_left, state.t),
                   static_cast<std::int32_t>(states_.size())});
  std::push_heap(open_.begin(), open_.end(), IsWorse());
  states_.push_back(state);
}

// Notes a state that is about to be the next in states_; false if a known one is as good.
bool SpaceTimeAStar::enter(const Task& task, const State& state) {
  if (slots_used_ * 2 >= slots_.size()) grow_slots();
  const std::uint64_t identity = identity_of(task, state);
  Slot& slot = find_slot(identity);
  if (slot.epoch != epoch_) {
    slot.identity = identity;
    slot.epoch = epoch_;
    slot.states.fill(-1);
    ++slots_used_;
  }
  for (std::int32_t& known : slot.states) {
    if (known < 0) continue;
    State& other = states_[static_cast<std::size_t>(known)];
    if (is_as_good(other, state)) return false;
    if (!is_as_good(state, other)) continue;
    other.superseded = true;
    known = -1;
  }
  slot.states[static_cast<std::size_t>(state.heading)] = static_cast<std::int32_t>(states_.size());
  return true;
}

// Whether every way on from `b` is as good from `a`, which is at the same location on the same leg at a time that
// makes no difference. Another heading costs at most one turn more.
bool SpaceTimeAStar::is_as_good(const State& a, const State& b) {
  if (a.t != b.t) return a.t < b.t;
  if (a.conflicts != b.conflicts) return a.conflicts < b.conflicts;
  const bool may_turn_more = a.heading != b.heading && a.heading != GridGraph::no_direction;
  return a.turns + (may_turn_more ? 1 : 0) <= b.turns;
}

std::uint64_t SpaceTimeAStar::identity_of(const Task& task, const State& state) const {
  const auto time = static_cast<std::uint64_t>(std::min(state.t, task.static_from));
  const auto place = static_cast<std::uint64_t>(state.leg) * static_cast<std::uint64_t>(graph_.location_count()) +
                     static_cast<std::uint64_t>(state.location);
  return place * (static_cast<std::uint64_t>(task.static_from) + 1) + time;
}

SpaceTimeAStar::Slot& SpaceTimeAStar::find_slot(std::uint64_t identity) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t i = static_cast<std::size_t>((identity * 0x9E3779B97F4A7C15u) >> 32) & mask;
  while (slots_[i].epoch == epoch_ && slots_[i].identity != identity) i = (i + 1) & mask;
  return slots_[i];
}

void SpaceTimeAStar::grow_slots() {
  std::vector<Slot> old(std::max<std::size_t>(slots_.size() * 2, 1 << 10), Slot{0, 0, {}});
  old.swap(slots_);
  for (const Slot& slot : old)
    if (slot.epoch == epoch_) find_slot(slot.identity) = slot;
}

void SpaceTimeAStar::begin() {
  ++epoch_;
  slots_used_ = 0;
  states_.clear();
  open_.clear();
}

void SpaceTimeAStar::trace_back(std::int32_t last, std::vector<Location>& path) const {
  path.resize(static_cast<std::size_t>(states_[static_cast<std::size_t>(last)].t) + 1);
  for (std::int32_t i = last; i >= 0; i = states_[static_cast<std::size_t>(i)].parent) {
    const State& state = states_[static_cast<std::size_t>(i)];
    path[static_cast<std::size_t>(state.t)] = state.location;
  }
}

}  // namespace dmrp::planners
