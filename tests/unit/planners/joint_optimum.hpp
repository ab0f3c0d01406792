// SPDX-License-Identifier: MIT
// The least sum of costs by A* over the joint positions of all robots: slow, and simple enough to be trusted.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tests/unit/planners/planning_case.hpp"

namespace dmrp::test {

// Whether the steps of two robots, given by their numbers among the active ones, conflict: for robots that differ.
using PairConflict = std::function<bool(std::size_t a, CellXY a0, CellXY a1, std::size_t b, CellXY b0, CellXY b1)>;

// Moves in four directions; each step costs 1.
struct FourDirections {
  using Cost = int;
  static constexpr Cost unreachable = 1'000'000;
  static constexpr Cost tolerance = 0;

  static std::vector<CellXY> reach(CellXY c) {
    return {c, {c.x + 1, c.y}, {c.x - 1, c.y}, {c.x, c.y + 1}, {c.x, c.y - 1}};
  }
  static Cost step_cost(CellXY, CellXY) { return 1; }
  static bool conflict(CellXY a0, CellXY a1, CellXY b0, CellXY b1) { return a1 == b1 || (a1 == b0 && b1 == a0); }
};

template <class Moves>
class BasicJointSearch {
 public:
  using Cost = typename Moves::Cost;

  // Gives up after visiting `most_states` joint positions.
  explicit BasicJointSearch(const PlanningCase& c, std::size_t most_states = std::numeric_limits<std::size_t>::max(),
                            PairConflict pair_conflict = nullptr)
      : case_(c), most_states_(most_states), pair_conflict_(std::move(pair_conflict)) {
    for (const CaseRobot& robot : c.robots) {
      if (robot.state == DMRP_ROBOT_ACTIVE)
        robots_.push_back(&robot);
      else
        resting_.push_back(robot.start);
    }
    for (const CaseRobot* robot : robots_) distances_.push_back(distances_to_the_end(*robot));
  }

  // Nothing if there is no plan, or if the search gave up.
  std::optional<Cost> optimum() {
    State start;
    for (const CaseRobot* robot : robots_) start.push_back({robot->start, 0, false});
    for (std::size_t a = 0; a < start.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (conflict(a, start[a].cell, start[a].cell, b, start[b].cell, start[b].cell)) return std::nullopt;
    offer_with_rests(start, 0, 0);
    while (!open_.empty()) {
      if (best_.size() > most_states_) return std::nullopt;
      const auto [f, code] = open_.top();
      open_.pop();
      const Cost cost = best_.at(code);
      const State state = decode(code);
      if (cost + estimate(state) < f - Moves::tolerance) continue;
      if (all_rest(state)) return cost;
      State next = state;
      move(state, next, 0, cost);
    }
    return std::nullopt;
  }

  bool gave_up() const { return best_.size() > most_states_; }

  // The cost of active robot `index` without the other active ones; nothing if it is cut off.
  std::optional<Cost> alone(std::size_t index) const {
    const Cost d = distance(index, {robots_[index]->start, 0, false});
    return d >= Moves::unreachable ? std::nullopt : std::optional(d);
  }

 private:
  struct Place {
    CellXY cell;
    int leg;     // goals reached before this step
    bool rests;  // has come to rest
  };
  using State = std::vector<Place>;

  bool is_open(const CaseRobot& robot, CellXY from, CellXY to) const {
    if (std::find(robot.closed.begin(), robot.closed.end(), to) != robot.closed.end()) return false;
    if (!case_.is_free(to) || (!(from == to) && !case_.is_open(from, to))) return false;
    return std::none_of(resting_.begin(), resting_.end(),
                        [&](CellXY cell) { return Moves::conflict(from, to, cell, cell); });
  }
  bool may_rest(std::size_t robot, const Place& place) const {
    return place.leg + 1 == static_cast<int>(robots_[robot]->goals.size()) &&
           place.cell == robots_[robot]->goals.back();
  }
  int leg_after(const CaseRobot& robot, const Place& place) const {
    const auto leg = static_cast<std::size_t>(place.leg);
    return leg + 1 < robot.goals.size() && place.cell == robot.goals[leg] ? place.leg + 1 : place.leg;
  }

  // By relaxation until nothing changes.
  std::vector<Cost> distances_to_the_end(const CaseRobot& robot) const {
    const std::size_t cells = case_.free.size();
    std::vector<Cost> distance(cells * robot.goals.size(), Moves::unreachable);
    for (bool changed = true; changed;) {
      changed = false;
      for (int leg = 0; leg < static_cast<int>(robot.goals.size()); ++leg)
        for (int y = 0; y < case_.height; ++y)
          for (int x = 0; x < case_.width; ++x) {
            const Place place{{x, y}, leg, false};
            if (!case_.is_free(place.cell)) continue;
            Cost& here = distance[static_cast<std::size_t>(leg) * cells + case_.index(place.cell)];
            Cost best = here;
            if (leg + 1 == static_cast<int>(robot.goals.size()) && place.cell == robot.goals.back()) best = 0;
            const auto next_leg = static_cast<std::size_t>(leg_after(robot, place));
            for (const CellXY to : Moves::reach(place.cell))
              if (is_open(robot, place.cell, to))
                best = std::min(best, Moves::step_cost(place.cell, to) + distance[next_leg * cells + case_.index(to)]);
            changed = changed || best < here - Moves::tolerance;
            here = best;
          }
    }
    return distance;
  }
  Cost distance(std::size_t robot, const Place& place) const {
    return place.rests
               ? Cost{0}
               : distances_[robot][static_cast<std::size_t>(place.leg) * case_.free.size() + case_.index(place.cell)];
  }
  Cost estimate(const State& state) const {
    Cost sum = 0;
    for (std::size_t i = 0; i < state.size(); ++i) sum += distance(i, state[i]);
    return sum;
  }
  static bool all_rest(const State& state) {
    for (const Place& place : state)
      if (!place.rests) return false;
    return true;
  }

  void move(const State& from, State& to, std::size_t robot, Cost cost) {
    if (robot == from.size()) return offer_with_rests(to, 0, cost);
    if (from[robot].rests) {
      to[robot] = from[robot];
      if (!meets(from, to, robot)) move(from, to, robot + 1, cost);
      return;
    }
    const int leg = leg_after(*robots_[robot], from[robot]);
    for (const CellXY cell : Moves::reach(from[robot].cell)) {
      if (!is_open(*robots_[robot], from[robot].cell, cell)) continue;
      to[robot] = {cell, leg, false};
      if (!meets(from, to, robot)) move(from, to, robot + 1, cost + Moves::step_cost(from[robot].cell, cell));
    }
  }
  bool meets(const State& from, const State& to, std::size_t robot) const {
    for (std::size_t other = 0; other < robot; ++other)
      if (conflict(robot, from[robot].cell, to[robot].cell, other, from[other].cell, to[other].cell)) return true;
    return false;
  }
  bool conflict(std::size_t a, CellXY a0, CellXY a1, std::size_t b, CellXY b0, CellXY b1) const {
    return Moves::conflict(a0, a1, b0, b1) || (pair_conflict_ && pair_conflict_(a, a0, a1, b, b0, b1));
  }

  // Every robot at the end of its tour may come to rest there, or not.
  void offer_with_rests(State& state, std::size_t robot, Cost cost) {
    if (robot == state.size()) return offer(state, cost);
    offer_with_rests(state, robot + 1, cost);
    if (state[robot].rests || !may_rest(robot, state[robot])) return;
    state[robot].rests = true;
    offer_with_rests(state, robot + 1, cost);
    state[robot].rests = false;
  }
  void offer(const State& state, Cost cost) {
    const Cost rest = estimate(state);
    if (rest >= Moves::unreachable) return;
    const auto [at, is_new] = best_.emplace(encode(state), cost);
    if (!is_new && at->second <= cost + Moves::tolerance) return;
    at->second = cost;
    open_.push({cost + rest, at->first});
  }

  uint64_t encode(const State& state) const {
    uint64_t code = 0;
    for (const Place& place : state)
      code = ((code * case_.free.size() + case_.index(place.cell)) * 4 + static_cast<uint64_t>(place.leg)) * 2 +
             place.rests;
    return code;
  }
  State decode(uint64_t code) const {
    State state(robots_.size());
    for (std::size_t i = state.size(); i-- > 0;) {
      state[i].rests = code % 2;
      state[i].leg = static_cast<int>(code / 2 % 4);
      const auto cell = static_cast<int>(code / 8 % case_.free.size());
      state[i].cell = {cell % case_.width, cell / case_.width};
      code = code / 8 / case_.free.size();
    }
    return state;
  }

  using Open = std::pair<Cost, uint64_t>;
  const PlanningCase& case_;
  std::size_t most_states_;
  PairConflict pair_conflict_;
  std::vector<const CaseRobot*> robots_;
  std::vector<CellXY> resting_;
  std::vector<std::vector<Cost>> distances_;
  std::unordered_map<uint64_t, Cost> best_;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open_;
};

using JointSearch = BasicJointSearch<FourDirections>;

}  // namespace dmrp::test
