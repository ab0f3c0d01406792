// SPDX-License-Identifier: MIT
#include "planners/ecbs8/focal_search.hpp"

#include <algorithm>

namespace dmrp::planners::ecbs8 {

namespace {

// The penalty of a conflict, as a cost. A high penalty makes paths expensive, which uses up the limit of the whole
// plan, and searches long; a low one leaves more conflicts to the high level.
constexpr Cost conflict_cost = 4 * straight_cost;

}  // namespace

FocalSearch::Result FocalSearch::search(const Agent& agent, const TourDistances& distances,
                                        const ConstraintTable& constraints, const Occupancy& others, Cost lower_bound,
                                        Suboptimality suboptimality, StopSignal& stop, BoundedPath& out) {
  const Task task{agent,
                  distances,
                  constraints,
                  others,
                  suboptimality,
                  std::max(constraints.static_from(), others.rest_from() + 1),
                  constraints.rest_from(agent.last_goal())};
  begin(task);
  begin_detours(task, stop);
  lower_bound_ = std::max(lower_bound, distances.distance(0, agent.start));
  bound_ = suboptimality.limit(lower_bound_);
  if (constraints.allows(agent.start, agent.start, Graph::no_direction, 0))
    generate(task, {0, agent.start, -1, 0, 0, 0, -1, 0, Graph::no_direction, false, Status::open}, true);

  // an expansion is more than one unit of work
  while (!stop.poll() && !stop.poll()) {
    while (!open_.empty() && states_[static_cast<std::size_t>(open_.front().state)].status != Status::open) {
      std::pop_heap(open_.begin(), open_.end(), IsWorse{});
      open_.pop_back();
    }
    if (open_.empty()) return Result::none;
    if (open_.front().f > lower_bound_) raise_bound(task, open_.front().f);
    const std::int32_t best = pop_focal();
    if (best < 0) continue;
    State& state = states_[static_cast<std::size_t>(best)];
    state.status = Status::expanded;
    ++expanded_;
    if (state.rests) {
      trace_back(best, out);
      return Result::found;
    }
    expand(task, best);
  }
  return Result::stopped;
}

void FocalSearch::begin(const Task& task) {
  ++epoch_;
  slots_used_ = 0;
  states_.clear();
  open_.clear();
  focal_.clear();
  waiting_.clear();
  conflicts_at_rest_.assign(static_cast<std::size_t>(task.others.rest_from()) + 1, 0);
  const Location goal = task.agent.last_goal();
  for (std::int32_t t = task.others.rest_from(); t > 0; --t)
    conflicts_at_rest_[static_cast<std::size_t>(t) - 1] =
        conflicts_at_rest_[static_cast<std::size_t>(t)] + task.others.count(goal, goal, Graph::no_direction, t);
  quiet_from_ = task.others.rest_from();
  while (quiet_from_ > 0 && conflicts_after(quiet_from_ - 1) == 0) --quiet_from_;
}

void FocalSearch::begin_detours(const Task& task, StopSignal& stop) {
  detours_.reset();
  closings_.clear();
  if (task.constraints.closed_for_good().empty()) return;
  graph_without_closed_ = graph_;
  for (const Constraint& closed : task.constraints.closed_for_good()) {
    Closing closing{0, closed.from};
    const auto widen = [&](Location location) {
      if (location == nowhere) return;
      for (std::int32_t leg = 0; leg <= task.agent.last_leg(); ++leg)
        if (const Cost distance = task.distances.distance(leg, location); distance < unreachable)
          closing.farthest = std::max(closing.farthest, distance);
    };
    const std::int32_t column = graph_.column(closed.location);
    const std::int32_t row = graph_.row(closed.location);
    widen(closed.location);
    for (const std::int32_t step : {1, -1}) {
      widen(graph_.at(column + step, row));
      widen(graph_.at(column, row + step));
    }
    closings_.push_back(closing);
    graph_without_closed_->block(closed.location);
  }
  detours_.emplace(*graph_without_closed_, task.agent, stop);
}

// A robot that is too late for every place that closes must take a path without them.
//
// To touch a place the robot must be there or beside it in time, and each step reduces the distance by at most a
// diagonal.
Cost FocalSearch::distance_to_go(const Task& task, const State& state) const {
  const Cost distance = task.distances.distance(state.leg, state.location);
  if (!detours_) return distance;
  for (const Closing& closing : closings_)
    if (distance - closing.farthest <= diagonal_cost * (closing.from - 1 - state.t)) return distance;
  return detours_->distance(state.leg, state.location);
}

std::int32_t FocalSearch::conflicts_after(std::int32_t t) const {
  return static_cast<std::size_t>(t) < conflicts_at_rest_.size() ? conflicts_at_rest_[static_cast<std::size_t>(t)] : 0;
}

void FocalSearch::raise_bound(const Task& task, Cost lower_bound) {
  lower_bound_ = lower_bound;
  bound_ = task.suboptimality.limit(lower_bound_);
  while (!waiting_.empty() && waiting_.front().f <= bound_) {
    focal_.push_back(waiting_.front().focal);
    std::push_heap(focal_.begin(), focal_.end(), IsWorse{});
    std::pop_heap(waiting_.begin(), waiting_.end(), IsWorse{});
    waiting_.pop_back();
  }
}

// Removes the top of FOCAL; -1 if it is no longer open.
std::int32_t FocalSearch::pop_focal() {
  const std::int32_t best = focal_.front().state();
  std::pop_heap(focal_.begin(), focal_.end(), IsWorse{});
  focal_.pop_back();
  return states_[static_cast<std::size_t>(best)].status == Status::open ? best : -1;
}

void FocalSearch::expand(const Task& task, std::int32_t parent) {
  const State from = states_[static_cast<std::size_t>(parent)];
  const std::int32_t t = from.t + 1;
  const std::int32_t leg = task.agent.leg_after(from.leg, from.location);
  for (Direction d = 0; d <= Graph::no_direction; ++d) {
    const bool moves = d != Graph::no_direction;
    const Location to = moves ? graph_.neighbor(from.location, d) : from.location;
    if (to == nowhere || task.distances.distance(leg, to) >= unreachable) continue;
    if (!task.constraints.allows(from.location, to, d, t)) continue;
    const Cost g = from.g + (moves ? step_cost(d) : wait_cost);
    if (is_beaten(task, leg, to, t, g, from.conflicts)) continue;
    State state;
    state.g = g;
    state.location = to;
    state.parent = parent;
    state.t = t;
    state.conflicts = from.conflicts + task.others.count(from.location, to, d, t);
    state.turns = from.turns + (moves && from.heading != Graph::no_direction && d != from.heading ? 1 : 0);
    state.same_place = -1;
    state.leg = static_cast<std::int16_t>(leg);
    state.heading = moves ? static_cast<std::int8_t>(d) : from.heading;
    state.rests = false;
    state.status = Status::open;
    generate(task, state, moves || leg != from.leg);
  }
}

// A path ends with an arrival: a wait before the rest would be part of the rest.
void FocalSearch::generate(const Task& task, const State& state, bool is_arrival) {
  if (is_arrival && state.leg == task.agent.last_leg() && state.location == task.agent.last_goal() &&
      state.t >= task.rest_from) {
    State end = state;
    end.rests = true;
    end.conflicts += conflicts_after(state.t);
    push(task, end);
  }
  push(task, state);
}

void FocalSearch::push(const Task& task, const State& state) {
  const Cost distance = state.rests ? 0 : distance_to_go(task, state);
  if (distance >= unreachable) return;
  const std::int32_t turns_in_all =
      state.turns + (state.rests ? 0 : task.distances.turns(state.leg, state.location, state.heading));
  if (!state.rests && !enter(task, state, turns_in_all)) return;
  if (state.rests) states_.push_back(state);
  const auto index = static_cast<std::int32_t>(states_.size()) - 1;

  // Until the robot rests, no step costs less than a straight one.
  const Cost f = state.g + (state.rests ? 0 : std::max(distance, straight_cost * (task.rest_from - state.t)));
  open_.push_back({f, index});
  std::push_heap(open_.begin(), open_.end(), IsWorse{});

  const FocalEntry entry{f_with_conflicts(state, f), tie_of(turns_in_all, state.t, index)};
  if (f <= bound_) {
    focal_.push_back(entry);
    std::push_heap(focal_.begin(), focal_.end(), IsWorse{});
  } else {
    waiting_.push_back({f, entry});
    std::push_heap(waiting_.begin(), waiting_.end(), IsWorse{});
  }
}

std::uint64_t FocalSearch::tie_of(std::int32_t turns, std::int32_t t, std::int32_t state) {
  constexpr std::int32_t most = UINT16_MAX;
  return static_cast<std::uint64_t>(std::min(turns, most)) << 48 |
         static_cast<std::uint64_t>(most - std::min(t, most)) << 32 | (UINT32_MAX - static_cast<std::uint32_t>(state));
}

// To end without further conflicts the robot must not come to rest before all others have passed its goal. If the bound
// does not allow to wait that long, it conflicts with those that come after its latest end.
Cost FocalSearch::f_with_conflicts(const State& state, Cost f) const {
  if (state.rests) return f + conflict_cost * state.conflicts;
  const Cost quiet_f = std::max(f, state.g + straight_cost * (quiet_from_ - state.t));
  if (quiet_f <= bound_) return quiet_f + conflict_cost * state.conflicts;
  const Cost steps_left = std::max<Cost>(0, bound_ - state.g) / straight_cost;
  return f + conflict_cost * (state.conflicts + conflicts_after(state.t + static_cast<std::int32_t>(steps_left)));
}

// Whether `known` dominates a new state of the same place and time. A state that was expanded is not replaced to save
// turns.
bool FocalSearch::is_as_good(const Task& task, const State& known, const State& state, std::int32_t turns_in_all) {
  if (known.status == Status::useless || known.g > state.g || known.conflicts > state.conflicts) return false;
  return known.g < state.g || known.conflicts < state.conflicts || known.status == Status::expanded ||
         known.turns + task.distances.turns(known.leg, known.location, known.heading) <= turns_in_all;
}

// Stores the state unless another one of its place and time is as good. Closes those that it dominates.
bool FocalSearch::enter(const Task& task, const State& state, std::int32_t turns_in_all) {
  if (2 * slots_used_ >= slots_.size()) grow_slots();
  const std::uint64_t identity = identity_of(task, state.leg, state.location, state.t);
  Slot& slot = find_slot(identity);
  const auto index = static_cast<std::int32_t>(states_.size());
  State entered = state;
  if (slot.epoch != epoch_) {
    slot = {identity, epoch_, index};
    ++slots_used_;
  } else {
    for (std::int32_t i = slot.first; i >= 0; i = states_[static_cast<std::size_t>(i)].same_place)
      if (is_as_good(task, states_[static_cast<std::size_t>(i)], state, turns_in_all)) return false;
    for (std::int32_t i = slot.first; i >= 0; i = states_[static_cast<std::size_t>(i)].same_place) {
      State& other = states_[static_cast<std::size_t>(i)];
      if (state.g <= other.g && state.conflicts <= other.conflicts) other.status = Status::useless;
    }
    entered.same_place = slot.first;
    slot.first = index;
  }
  states_.push_back(entered);
  return true;
}

// Whether a step can be skipped: a state of its place and time is better even if the step has no conflict. Never skips
// ends of paths, because a path must not end with a wait.
bool FocalSearch::is_beaten(const Task& task, std::int32_t leg, Location location, std::int32_t t, Cost g,
                            std::int32_t conflicts) {
  if (slots_.empty() || (leg == task.agent.last_leg() && location == task.agent.last_goal())) return false;
  const Slot& slot = find_slot(identity_of(task, leg, location, t));
  if (slot.epoch != epoch_) return false;
  for (std::int32_t i = slot.first; i >= 0; i = states_[static_cast<std::size_t>(i)].same_place) {
    const State& other = states_[static_cast<std::size_t>(i)];
    if (other.status != Status::useless && other.g <= g && other.conflicts <= conflicts &&
        (other.g < g || other.conflicts < conflicts || other.status == Status::expanded))
      return true;
  }
  return false;
}

std::uint64_t FocalSearch::identity_of(const Task& task, std::int32_t leg, Location location, std::int32_t t) const {
  const auto time = static_cast<std::uint64_t>(std::min(t, task.static_from));
  const auto place = static_cast<std::uint64_t>(leg) * static_cast<std::uint64_t>(graph_.location_count()) +
                     static_cast<std::uint64_t>(location);
  return place * (static_cast<std::uint64_t>(task.static_from) + 1) + time;
}

FocalSearch::Slot& FocalSearch::find_slot(std::uint64_t identity) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t i = static_cast<std::size_t>((identity * 0x9E3779B97F4A7C15u) >> 32) & mask;
  while (slots_[i].epoch == epoch_ && slots_[i].identity != identity) i = (i + 1) & mask;
  return slots_[i];
}

void FocalSearch::grow_slots() {
  std::vector<Slot> old(std::max<std::size_t>(slots_.size() * 2, 1 << 10), Slot{0, 0, -1});
  old.swap(slots_);
  for (const Slot& slot : old)
    if (slot.epoch == epoch_) find_slot(slot.identity) = slot;
}

void FocalSearch::trace_back(std::int32_t last, BoundedPath& out) const {
  out.cost = states_[static_cast<std::size_t>(last)].g;
  out.lower_bound = lower_bound_;
  out.locations.resize(static_cast<std::size_t>(states_[static_cast<std::size_t>(last)].t) + 1);
  for (std::int32_t i = last; i >= 0; i = states_[static_cast<std::size_t>(i)].parent) {
    const State& state = states_[static_cast<std::size_t>(i)];
    out.locations[static_cast<std::size_t>(state.t)] = state.location;
  }
}

}  // namespace dmrp::planners::ecbs8
