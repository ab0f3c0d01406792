// SPDX-License-Identifier: MIT
#include "planners/mapf/straighten.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

#include "planners/mapf/fewest_turns.hpp"

namespace dmrp::planners {

namespace {

// The number of states for one robot before the next one takes its turn.
constexpr std::int64_t first_work_a_robot = 100;

// Finds a path with the fewest turns that ends at a given time and avoids the others. It searches by number of turns
// over states (location, safe interval, leg, heading) and keeps the earliest arrival in each. An earlier arrival
// dominates a later one, because waiting is not a turn.
class StraightestPath {
 public:
  StraightestPath(const GridGraph& graph, const SafeIntervals& others)
      : graph_(graph), others_(others), places_(static_cast<std::size_t>(graph.location_count())) {}

  enum class Result { straighter, no_straighter, given_up };

  // Replaces the path, which has `turns` turns and is not among the others, if another one has fewer. Decrements
  // `work_left`; gives up when it is used up or when `stop` was raised.
  Result improve(const Agent& agent, const TourTable& table, std::int32_t turns, std::int64_t& work_left,
                 StopSignal& stop, std::vector<Location>& path) {
    begin(agent, table, turns, path);
    for (std::int32_t level = 0; level < turns; ++level) {
      auto& labels = levels_[static_cast<std::size_t>(level)];
      while (!labels.empty()) {
        if (--work_left < 0 || stop.poll()) return Result::given_up;
        const std::int32_t index = labels.back();
        labels.pop_back();
        const Label& label = labels_[static_cast<std::size_t>(index)];
        if (label.is_end) {
          trace_back(index, path);
          return Result::straighter;
        }
        if (close(label)) expand(index);
      }
    }
    return Result::no_straighter;
  }

 private:
  struct Label {
    Location location;
    std::uint32_t gap;
    std::int32_t leg;
    std::int32_t t;  // of arrival
    std::int32_t turns;
    std::int32_t parent;
    Direction heading;
    bool is_end;
  };
  // Earliest arrivals in a gap on a leg: by heading with up to `turns` turns, and with fewer turns.
  struct State {
    std::int32_t turns = 0;
    std::int32_t with_fewer = forever;
    std::array<std::int32_t, GridGraph::direction_count + 1> by_heading;
    State() { by_heading.fill(forever); }

    std::int32_t earliest() const {
      return std::min(with_fewer, *std::min_element(by_heading.begin(), by_heading.end()));
    }
  };
  // The first state of a location. Set at the first visit of a search.
  struct Place {
    std::uint32_t epoch = 0;
    std::uint32_t first = 0;
  };

  void begin(const Agent& agent, const TourTable& table, std::int32_t turns, PathView path) {
    agent_ = &agent;
    table_ = &table;
    turn_limit_ = turns;
    cost_ = cost_of(path);
    end_leg_ = agent.last_leg();
    while (end_leg_ > 0 && agent.goal(end_leg_ - 1) == agent.last_goal()) --end_leg_;
    ++epoch_;
    states_.clear();
    labels_.clear();
    if (levels_.size() < static_cast<std::size_t>(turns) + 1) levels_.resize(static_cast<std::size_t>(turns) + 1);
    for (auto& level : levels_) level.clear();
    push({agent.start, 0, 0, 0, 0, -1, GridGraph::no_direction, false});
  }

  State& state_of(const Label& label) {
    Place& place = places_[static_cast<std::size_t>(label.location)];
    const std::size_t gaps = others_.occupations(label.location).size() + 1;
    if (place.epoch != epoch_) {
      place.epoch = epoch_;
      place.first = static_cast<std::uint32_t>(states_.size());
      states_.resize(states_.size() + gaps * agent_->goals.size());
    }
    return states_[place.first + static_cast<std::size_t>(label.leg) * gaps + label.gap];
  }

  // Records the label. False if it is dominated.
  bool close(const Label& label) {
    State& state = state_of(label);
    if (state.turns < label.turns) {
      state.with_fewer = state.earliest();
      state.turns = label.turns;
    }
    std::int32_t& known = state.by_heading[static_cast<std::size_t>(label.heading)];
    if (label.t >= known || label.t >= state.with_fewer) return false;
    known = label.t;
    return true;
  }

  void expand(std::int32_t index) {
    const Label from = labels_[static_cast<std::size_t>(index)];
    const auto here = others_.occupations(from.location);
    std::int32_t last_t = from.gap < here.size() ? here[from.gap].from - 1 : forever;
    std::int32_t follower = from.gap < here.size() ? here[from.gap].agent : -1;
    const std::int32_t leg = agent_->leg_after(from.leg, from.location);
    if (leg != from.leg && from.location == agent_->goal(leg) && from.t < last_t) {
      // between equal goals a wait continues the tour
      generate({from.location, from.gap, leg, from.t + 1, from.turns, index, from.heading, false});
      last_t = from.t;
      follower = -1;
    }
    for (Direction d = 0; d < GridGraph::direction_count; ++d) {
      const Location to = graph_.neighbor(from.location, d);
      if (to == nowhere) continue;
      const bool turn = from.heading != GridGraph::no_direction && from.heading != d;
      move({to, 0, leg, from.t + 1, from.turns + (turn ? 1 : 0), index, d, false}, last_t + 1, follower);
    }
  }

  // `label` is the earliest arrival; `follower` enters the location right after the latest departure.
  void move(Label label, std::int32_t latest, std::int32_t follower) {
    const std::int32_t to_go = table_->distance(label.leg, label.location);
    if (label.t + to_go > cost_ || !is_promising(label)) return;
    const std::int32_t earliest = label.t;
    const auto there = others_.occupations(label.location);
    for (std::size_t i = SafeIntervals::index_at(there, earliest);; ++i) {
      const std::int32_t left = i > 0 ? there[i - 1].to + 1 : 0;
      if (left > latest || left + to_go > cost_) return;
      const std::int32_t gap_end = i < there.size() ? there[i].from - 1 : forever;
      const bool swap = left == latest && i > 0 && there[i - 1].agent == follower;
      label.gap = static_cast<std::uint32_t>(i);
      label.t = std::max(earliest, left);
      if (label.t <= gap_end && !swap) {
        generate(label);
        if (gap_end == forever) generate_end(label, latest);
      }
      if (i >= there.size()) return;
    }
  }

  void generate(const Label& label) {
    const State& state = state_of(label);
    if (label.t >= state.with_fewer || label.t >= state.by_heading[static_cast<std::size_t>(label.heading)]) return;
    if (label.turns > state.turns && label.t >= state.earliest()) return;
    push(label);
  }

  // Whether the tour could end with fewer turns than the limit, ignoring walls and other robots.
  bool is_promising(const Label& label) const {
    const std::int32_t spare = turn_limit_ - 1 - label.turns;
    return spare >= 2 ||
           (spare >= 0 && fewest_turns(graph_, label.location, agent_->goal(label.leg), label.heading) <= spare);
  }

  // The robot comes to rest. Equal goals at the end of the tour take only waits.
  void generate_end(Label label, std::int32_t latest) {
    if (label.leg < end_leg_ || label.location != agent_->last_goal()) return;
    const std::int32_t end_t = cost_ - (agent_->last_leg() - label.leg);
    if (end_t < label.t || end_t > latest) return;
    label.t = end_t;
    label.is_end = true;
    push(label);
  }

  void push(const Label& label) {
    levels_[static_cast<std::size_t>(label.turns)].push_back(static_cast<std::int32_t>(labels_.size()));
    labels_.push_back(label);
  }

  // A robot waits before it leaves, and at the end for equal goals.
  void trace_back(std::int32_t last, std::vector<Location>& path) const {
    std::size_t end = path.size();
    for (std::int32_t i = last; i >= 0; i = labels_[static_cast<std::size_t>(i)].parent) {
      const Label& label = labels_[static_cast<std::size_t>(i)];
      for (auto t = static_cast<std::size_t>(label.t); t < end; ++t) path[t] = label.location;
      end = std::min(end, static_cast<std::size_t>(label.t));
    }
  }

  const GridGraph& graph_;
  const SafeIntervals& others_;
  const Agent* agent_ = nullptr;
  const TourTable* table_ = nullptr;
  std::int32_t turn_limit_ = 0;  // the path found must have fewer
  std::int32_t cost_ = 0;
  std::int32_t end_leg_ = 0;  // from this leg on all goals are at the last location
  std::vector<Place> places_;
  std::vector<State> states_;
  std::vector<Label> labels_;
  std::vector<std::vector<std::int32_t>> levels_;  // labels to be expanded, by turns
  std::uint32_t epoch_ = 0;
};

}  // namespace

std::int32_t straighten(const Problem& problem, const std::vector<TourTable>& tables,
                        std::vector<std::vector<Location>>& paths, std::int64_t work_limit, StopSignal& stop) {
  SafeIntervals plan(problem.graph);
  for (std::size_t i = 0; i < paths.size() && !stop.poll_now(); ++i) plan.add(static_cast<std::int32_t>(i), paths[i]);
  return straighten(problem, tables, plan, paths, work_limit, stop);
}

std::int32_t straighten(const Problem& problem, const std::vector<TourTable>& tables, SafeIntervals& plan,
                        std::vector<std::vector<Location>>& paths, std::int64_t work_limit, StopSignal& stop) {
  assert(paths.size() == problem.agents.size() && tables.size() == paths.size());
  using Result = StraightestPath::Result;
  std::vector<std::int32_t> turns;
  std::vector<std::size_t> candidates;  // robots whose turns exceed the lower bound
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const Agent& agent = problem.agents[i];
    turns.push_back(count_turns(problem.graph, paths[i]));
    if (turns[i] > fewest_turns(problem.graph, agent.start, agent.goal(0), GridGraph::no_direction))
      candidates.push_back(i);
  }

  StraightestPath search(problem.graph, plan);
  std::vector<std::size_t> left = candidates;
  std::int64_t work_a_robot = first_work_a_robot;
  std::int32_t saved = 0;
  bool changed = false;
  while (!left.empty() && work_limit > 0 && !stop.raised()) {
    // first those that took little work
    std::erase_if(left, [&](std::size_t i) {
      if (work_limit <= 0 || stop.raised()) return false;
      const std::int64_t limit = std::min(work_a_robot, work_limit);
      std::int64_t work_left = limit;
      plan.remove(paths[i]);
      const Result result = search.improve(problem.agents[i], tables[i], turns[i], work_left, stop, paths[i]);
      plan.add(static_cast<std::int32_t>(i), paths[i]);
      work_limit -= limit - std::max<std::int64_t>(work_left, 0);
      if (result == Result::given_up) return false;
      if (result == Result::no_straighter) return true;
      const std::int32_t fewer = count_turns(problem.graph, paths[i]);
      saved += turns[i] - fewer;
      turns[i] = fewer;
      changed = true;
      return true;
    });
    work_a_robot *= 4;
    if (!left.empty() || !changed) continue;
    // try all again among the new paths
    left = candidates;
    work_a_robot = first_work_a_robot;
    changed = false;
  }
  return saved;
}

void straighten_alone(const Problem& problem, const std::vector<TourTable>& tables,
                      std::vector<std::vector<Location>>& paths, StopSignal& stop) {
  assert(paths.size() == problem.agents.size() && tables.size() == paths.size());
  const SafeIntervals nobody(problem.graph);
  StraightestPath search(problem.graph, nobody);
  std::int64_t no_limit = std::numeric_limits<std::int64_t>::max();
  for (std::size_t i = 0; i < paths.size() && !stop.raised(); ++i)
    search.improve(problem.agents[i], tables[i], count_turns(problem.graph, paths[i]), no_limit, stop, paths[i]);
}

}  // namespace dmrp::planners
