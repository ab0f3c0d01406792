// SPDX-License-Identifier: MIT
// The least sum of costs with diagonals by A* over the joint positions of all robots: slow, and obviously right. Shares
// the rule of conflicts with plan_check_8.hpp and nothing with the planners.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tests/unit/planners/plan_check_8.hpp"

namespace dmrp::test {

class JointSearch8 {
 public:
  explicit JointSearch8(const PlanningCase& c) : case_(c) {
    for (const CaseRobot& robot : c.robots) {
      if (robot.state == DMRP_ROBOT_ACTIVE)
        robots_.push_back(&robot);
      else
        resting_.push_back(robot.start);
    }
    for (const CaseRobot* robot : robots_) distances_.push_back(distances_to_the_end(*robot));
  }

  // Nothing if there is no plan.
  std::optional<double> optimum() {
    State start;
    for (const CaseRobot* robot : robots_) start.push_back({robot->start, 0, false});
    for (std::size_t a = 0; a < start.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (start[a].cell == start[b].cell) return std::nullopt;
    offer_with_rests(start, 0, 0.0);
    while (!open_.empty()) {
      const auto [f, code] = open_.top();
      open_.pop();
      const double cost = best_.at(code);
      const State state = decode(code);
      if (cost + estimate(state) < f - tolerance) continue;
      if (std::all_of(state.begin(), state.end(), [](const Place& place) { return place.rests; })) return cost;
      State next = state;
      move(state, next, 0, cost);
    }
    return std::nullopt;
  }

 private:
  struct Place {
    CellXY cell;
    int leg;     // goals ticked off before this step
    bool rests;  // for good
  };
  using State = std::vector<Place>;
  static constexpr double tolerance = 1e-9;
  static constexpr double unreachable = 1e9;

  static double step_cost(CellXY from, CellXY to) { return from.x != to.x && from.y != to.y ? std::sqrt(2.0) : 1.0; }
  bool is_open(CellXY from, CellXY to) const {
    if (!case_.is_free(to) || (!(from == to) && !case_.is_open(from, to))) return false;
    for (const CellXY& cell : resting_)
      if (steps_conflict(from, to, cell, cell)) return false;
    return true;
  }
  static std::vector<CellXY> reach(CellXY c) {
    std::vector<CellXY> cells;
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy) cells.push_back({c.x + dx, c.y + dy});
    return cells;
  }
  int leg_after(const CaseRobot& robot, const Place& place) const {
    const auto leg = static_cast<std::size_t>(place.leg);
    return leg + 1 < robot.goals.size() && place.cell == robot.goals[leg] ? place.leg + 1 : place.leg;
  }

  // By relaxation until nothing changes.
  std::vector<double> distances_to_the_end(const CaseRobot& robot) const {
    const std::size_t cells = case_.free.size();
    std::vector<double> distance(cells * robot.goals.size(), unreachable);
    for (bool changed = true; changed;) {
      changed = false;
      for (int leg = 0; leg < static_cast<int>(robot.goals.size()); ++leg)
        for (int y = 0; y < case_.height; ++y)
          for (int x = 0; x < case_.width; ++x) {
            const Place place{{x, y}, leg, false};
            if (!case_.is_free(place.cell)) continue;
            double& here = distance[static_cast<std::size_t>(leg) * cells + case_.index(place.cell)];
            double best = here;
            if (leg + 1 == static_cast<int>(robot.goals.size()) && place.cell == robot.goals.back()) best = 0;
            const auto next_leg = static_cast<std::size_t>(leg_after(robot, place));
            for (const CellXY to : reach(place.cell))
              if (is_open(place.cell, to))
                best = std::min(best, step_cost(place.cell, to) + distance[next_leg * cells + case_.index(to)]);
            changed = changed || best < here - tolerance;
            here = best;
          }
    }
    return distance;
  }
  double estimate(const State& state) const {
    double sum = 0;
    for (std::size_t i = 0; i < state.size(); ++i)
      if (!state[i].rests)
        sum += distances_[i][static_cast<std::size_t>(state[i].leg) * case_.free.size() + case_.index(state[i].cell)];
    return sum;
  }

  void move(const State& from, State& to, std::size_t robot, double cost) {
    if (robot == from.size()) return offer_with_rests(to, 0, cost);
    if (from[robot].rests) {
      to[robot] = from[robot];
      if (!meets(from, to, robot)) move(from, to, robot + 1, cost);
      return;
    }
    const int leg = leg_after(*robots_[robot], from[robot]);
    for (const CellXY cell : reach(from[robot].cell)) {
      if (!is_open(from[robot].cell, cell)) continue;
      to[robot] = {cell, leg, false};
      if (!meets(from, to, robot)) move(from, to, robot + 1, cost + step_cost(from[robot].cell, cell));
    }
  }
  static bool meets(const State& from, const State& to, std::size_t robot) {
    for (std::size_t other = 0; other < robot; ++other)
      if (steps_conflict(from[robot].cell, to[robot].cell, from[other].cell, to[other].cell)) return true;
    return false;
  }

  // Every robot that is at its end may decide to rest there, or not.
  void offer_with_rests(State& state, std::size_t robot, double cost) {
    if (robot == state.size()) return offer(state, cost);
    offer_with_rests(state, robot + 1, cost);
    if (state[robot].rests || state[robot].leg + 1 != static_cast<int>(robots_[robot]->goals.size()) ||
        !(state[robot].cell == robots_[robot]->goals.back()))
      return;
    state[robot].rests = true;
    offer_with_rests(state, robot + 1, cost);
    state[robot].rests = false;
  }
  void offer(const State& state, double cost) {
    const double rest = estimate(state);
    if (rest >= unreachable) return;
    const auto [at, is_new] = best_.emplace(encode(state), cost);
    if (!is_new && at->second <= cost + tolerance) return;
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

  using Open = std::pair<double, uint64_t>;
  const PlanningCase& case_;
  std::vector<const CaseRobot*> robots_;
  std::vector<CellXY> resting_;
  std::vector<std::vector<double>> distances_;
  std::unordered_map<uint64_t, double> best_;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open_;
};

}  // namespace dmrp::test
