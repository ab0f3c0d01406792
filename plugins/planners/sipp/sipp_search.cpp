// SPDX-License-Identifier: MIT
#include "planners/sipp/sipp_search.hpp"

#include <algorithm>
#include <utility>

#include "planners/mapf/fewest_turns.hpp"

namespace dmrp::planners {

SippSearch::Result SippSearch::search(const Agent& agent, const TourTable& table, std::span<const std::int32_t> prices,
                                      std::int32_t delay, StopSignal& stop, std::vector<Location>& path,
                                      std::int32_t latest) {
  const auto at_goal = others_.occupations(agent.last_goal());
  const Task task{agent, table, prices, stop, at_goal.empty() ? 0 : at_goal.back().to + 1, latest};
  begin(task, delay);
  for (;;) {
    if (is_open_empty()) {
      if (may_displace_ || prices.empty()) return Result::none;
      start_displacing(task);
      if (is_open_empty()) return stop.raised() ? Result::stopped : Result::none;
    }
    if (stop.poll()) return Result::stopped;
    const std::int32_t index = pop_open();
    const Label& label = labels_[static_cast<std::size_t>(index)];
    if (label.is_end) {
      trace_back(index, path);
      return label.price > 0 ? Result::displacing : Result::free;
    }
    State& state = state_of(task, label);
    if (state.expanded_t <= label.t) continue;
    state.expanded_t = label.t;
    ++expanded_;
    if (!may_displace_) expanded_labels_.push_back(index);
    expand(task, index);
  }
}

// There is no free path: continues through the other robots, from all labels expanded so far.
void SippSearch::start_displacing(const Task& task) {
  may_displace_ = true;
  for (std::size_t i = 0; i < expanded_labels_.size() && !task.stop.poll(); ++i) expand(task, expanded_labels_[i]);
}

void SippSearch::begin(const Task& task, std::int32_t delay) {
  ++epoch_;
  states_.resize(block_size);
  blocks_.clear();
  labels_.clear();
  open_.clear();
  latest_.label = none;
  expanded_labels_.clear();
  may_displace_ = false;
  const auto there = others_.occupations(task.agent.start);
  std::int32_t t = task.agent.start == task.agent.last_goal() ? 0 : delay;
  if (!there.empty()) t = std::min(t, there[0].from - 1);
  generate(task, {task.agent.start, 0, 0, t, 0, -1, 0, -1, GridGraph::no_direction, false});
}

void SippSearch::expand(const Task& task, std::int32_t index) {
  const Label label = labels_[static_cast<std::size_t>(index)];
  const auto here = others_.occupations(label.location);
  const auto occupation =
      static_cast<std::size_t>(label.interval / 2);  // the current occupation, or the one after the gap
  const bool is_gap = label.interval % 2 == 0;
  Departure departure{index, task.agent.leg_after(label.leg, label.location), forever, -1};
  if (!is_gap)
    departure.last_t = here[occupation].to;
  else if (occupation < here.size())
    departure.last_t = here[occupation].from - 1;
  const std::size_t next = is_gap ? occupation : occupation + 1;
  if (next < here.size() && here[next].from == departure.last_t + 1) departure.follower = here[next].agent;

  if (may_displace_ && is_at_last_goal(task, label)) generate_end(task, label);
  wait(task, departure);
  // Between equal goals a wait continues the tour, so any other move must leave at once.
  if (departure.leg != label.leg && label.location == task.agent.goal(departure.leg) && label.t < departure.last_t) {
    departure.last_t = label.t;
    departure.follower = -1;
  }
  for (Direction d = 0; d < GridGraph::direction_count; ++d)
    if (const Location to = graph_.neighbor(label.location, d); to != nowhere) move(task, departure, d, to);
}

// Waits until the location's next interval or, between equal goals, one step within this one.
void SippSearch::wait(const Task& task, const Departure& departure) {
  Label label = labels_[static_cast<std::size_t>(departure.label)];
  const bool gets_on = departure.leg != label.leg && label.location == task.agent.goal(departure.leg);
  label.parent = departure.label;
  label.leg = departure.leg;
  if (gets_on && label.t < departure.last_t) {
    ++label.t;
    return generate(task, label);
  }
  if (departure.last_t >= forever || !may_displace_) return;
  label.t = departure.last_t + 1;
  label.displaced = departure.follower;
  if (departure.follower < 0) {
    ++label.interval;
  } else {
    label.interval += label.interval % 2 == 0 ? 1 : 2;
    label.price += price_of(task, departure.follower);
  }
  generate(task, label);
}

void SippSearch::move(const Task& task, const Departure& departure, Direction d, Location to) {
  const Label from = labels_[static_cast<std::size_t>(departure.label)];
  const std::int32_t earliest = from.t + 1;
  const std::int32_t latest = departure.last_t + 1;
  const std::int32_t in_time = std::min(latest, task.latest - task.table.distance(departure.leg, to));
  const bool turn = from.heading != GridGraph::no_direction && from.heading != d;
  const auto there = others_.occupations(to);
  Label label{
      to, 0, departure.leg, 0, 0, departure.label, from.turns + (turn ? 1 : 0), -1, static_cast<std::int8_t>(d), false};
  for (std::size_t i = SafeIntervals::index_at(there, earliest);; ++i) {
    // gap i, then occupation i
    const std::int32_t left = i > 0 ? there[i - 1].to + 1 : 0;
    const std::int32_t gap_end = i < there.size() ? there[i].from - 1 : forever;
    if (left > in_time) return;
    // the robot that comes the other way if this one leaves at the last moment
    const std::int32_t swapper =
        departure.follower >= 0 && i > 0 && left == latest && there[i - 1].agent == departure.follower
            ? departure.follower
            : -1;
    label.t = std::max(earliest, left);
    if (label.t <= gap_end && (swapper < 0 || may_displace_)) {
      label.interval = static_cast<std::int32_t>(2 * i);
      label.displaced = -1;
      label.price = from.price;
      if (swapper >= 0 && swapper != from.displaced) label.price += price_of(task, swapper);
      generate(task, label);
    }
    if (i >= there.size() || task.stop.poll()) return;
    label.t = std::max(earliest, there[i].from);
    if (label.t > latest) return;
    if (!may_displace_) continue;
    label.interval = static_cast<std::int32_t>(2 * i + 1);
    label.displaced = there[i].agent;
    label.price = from.price;
    if (label.displaced != from.displaced) label.price += price_of(task, label.displaced);
    if (label.t == left && swapper >= 0 && swapper != from.displaced) label.price += price_of(task, swapper);
    generate(task, label);
  }
}

void SippSearch::generate(const Task& task, const Label& label) {
  if (task.table.distance(label.leg, label.location) >= TourTable::unreachable) return;
  State& state = state_of(task, label);
  if (state.expanded_t <= label.t) return;
  if (state.generated_t <= label.t && state.generated_price <= label.price) return;
  if (label.price <= state.generated_price) {
    state.generated_t = label.t;
    state.generated_price = label.price;
  }
  push(task, label);
}

// The robot rests at its last goal from here on, through all later occupations.
void SippSearch::generate_end(const Task& task, const Label& label) {
  Label end = label;
  end.is_end = true;
  const auto there = others_.occupations(label.location);
  for (auto i = static_cast<std::size_t>((label.interval + 1) / 2); i < there.size(); ++i)
    end.price += price_of(task, there[i].agent);
  push(task, end);
}

void SippSearch::push(const Task& task, Label label) {
  const auto pack = [](std::int32_t high, std::int32_t low) {
    return static_cast<std::uint64_t>(high) << 32 | static_cast<std::uint32_t>(low);
  };
  const std::int32_t to_go = task.table.distance(label.leg, label.location);
  // a free path cannot end before the last of the others has crossed the goal
  const std::int32_t steps = label.price > 0 ? label.t + to_go : std::max(label.t + to_go, task.rest_from);
  if (steps > task.latest) return;
  const std::int32_t turns =
      label.turns + fewest_turns(graph_, label.location, task.agent.goal(label.leg), label.heading);
  // a robot with time to spare should first make progress
  const bool is_near_first = preference_ == Preference::near || steps == task.rest_from;
  push_open({pack(label.price, steps), is_near_first ? pack(to_go, turns) : pack(turns, to_go),
             static_cast<std::int32_t>(labels_.size())});
  label.is_end = label.is_end || (to_go == 0 && label.t >= task.rest_from);
  labels_.push_back(label);
}

void SippSearch::push_open(const OpenEntry& entry) {
  if (latest_.label == none) {
    latest_ = entry;
    return;
  }
  open_.push_back(entry);
  if (IsWorse()(latest_, entry)) std::swap(latest_, open_.back());
  std::push_heap(open_.begin(), open_.end(), IsWorse());
}

// Removes the best entry and returns its label.
std::int32_t SippSearch::pop_open() {
  if (latest_.label != none && (open_.empty() || IsWorse()(open_.front(), latest_)))
    return std::exchange(latest_.label, none);
  if (latest_.label != none) {
    open_.push_back(latest_);
    std::push_heap(open_.begin(), open_.end(), IsWorse());
    latest_.label = none;
  }
  std::pop_heap(open_.begin(), open_.end(), IsWorse());
  const std::int32_t label = open_.back().label;
  open_.pop_back();
  return label;
}

SippSearch::State& SippSearch::state_of(const Task& task, const Label& label) {
  LocationStates& at = intervals_[static_cast<std::size_t>(label.location)];
  const std::size_t intervals = 2 * others_.occupations(label.location).size() + 1;
  const std::size_t count = intervals * task.agent.goals.size();
  const bool is_in_a_row = count <= block_size;
  if (at.epoch != epoch_) {
    at.epoch = epoch_;
    at.first = static_cast<std::uint32_t>(is_in_a_row ? states_.size() : blocks_.size());
    if (is_in_a_row)
      states_.resize(states_.size() + count);
    else
      blocks_.resize(blocks_.size() + (count + block_size - 1) / block_size);
  }
  const std::size_t index = static_cast<std::size_t>(label.leg) * intervals + static_cast<std::size_t>(label.interval);
  if (is_in_a_row) return states_[at.first + index];
  std::uint32_t& block = blocks_[at.first + index / block_size];
  if (block == 0) {
    block = static_cast<std::uint32_t>(states_.size());
    states_.resize(states_.size() + block_size);
  }
  return states_[block + index % block_size];
}

// Fills in the waits: a robot leaves one step before it arrives elsewhere.
void SippSearch::trace_back(std::int32_t last, std::vector<Location>& path) const {
  path.resize(static_cast<std::size_t>(labels_[static_cast<std::size_t>(last)].t) + 1);
  std::size_t end = path.size();
  for (std::int32_t i = last; i >= 0;) {
    const Label& label = labels_[static_cast<std::size_t>(i)];
    i = label.parent;
    const std::size_t begin = i < 0 ? 0 : static_cast<std::size_t>(label.t);
    std::fill(path.begin() + static_cast<std::ptrdiff_t>(begin), path.begin() + static_cast<std::ptrdiff_t>(end),
              label.location);
    end = begin;
  }
}

}  // namespace dmrp::planners
