// SPDX-License-Identifier: MIT
// One agent with constraints of all kinds among others that walk at random, and exhaustive methods to check the low
// level and its tables.
#pragma once

#include <algorithm>
#include <dmrp/plugin.hpp>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "planners/conflict_search/low_level/conflict_table.hpp"
#include "planners/conflict_search/low_level/constraint.hpp"
#include "planners/mapf/tour_table.hpp"
#include "tests/unit/planners/mapf/problem_case.hpp"
#include "tests/unit/planners/random.hpp"

namespace dmrp::test {

// How a low level counts conflicts.
enum class Counting {
  by_step,      // each other agent once for each step
  by_interval,  // the same, but a stay where an agent rests counts once, as long as nothing else changes
};

class LowLevelCase {
 public:
  using Location = planners::Location;
  using Constraint = planners::Constraint;

  // The horizon of all exhaustive methods.
  static constexpr int horizon = 45;

  planners::Problem problem;
  std::vector<std::vector<Location>> others;  // of agents 0, 1, ..., which end at different places
  std::vector<Constraint> constraints;        // on agent 0

  explicit LowLevelCase(uint64_t seed) : LowLevelCase(Random(seed)) {}

  const planners::Agent& agent() const { return problem.agents[0]; }

  // The locations within one step.
  std::vector<Location> reach(Location from) const {
    std::vector<Location> out = {from};
    for (int d = 0; d < 4; ++d)
      if (problem.graph.neighbor(from, d) != planners::nowhere) out.push_back(problem.graph.neighbor(from, d));
    return out;
  }

  // Whether no constraint forbids to be at `at` at time t.
  bool may_be(Location at, int t) const {
    return std::none_of(constraints.begin(), constraints.end(), [&](const Constraint& c) {
      if (c.kind == Constraint::Kind::avoid_vertex) return c.location == at && c.t <= t && t < c.until;
      return c.kind == Constraint::Kind::pass_vertex && c.t == t && c.location != at;
    });
  }
  bool may_arrive(Location from, Location to, int t) const {
    return may_be(to, t) && std::none_of(constraints.begin(), constraints.end(), [&](const Constraint& c) {
             return c.kind == Constraint::Kind::avoid_move && c.location == to && c.from == from && c.t == t;
           });
  }
  // Whether a path that is at the last goal may have this cost.
  bool may_rest(int t) const {
    for (int later = t; later < horizon; ++later)
      if (!may_be(agent().last_goal(), later)) return false;
    return std::none_of(constraints.begin(), constraints.end(), [&](const Constraint& c) {
      return (c.kind == Constraint::Kind::finish_after && t <= c.t) ||
             (c.kind == Constraint::Kind::finish_by && t > c.t);
    });
  }
  // The earliest end that the constraints allow. Times before it are distinguished from those after it.
  int rest_from() const {
    int from = horizon;
    for (int t = horizon; t-- > 0;) {
      bool is_late = false;
      for (const Constraint& c : constraints) {
        is_late = is_late || (c.kind == Constraint::Kind::finish_after && t <= c.t);
        is_late =
            is_late || (c.kind == Constraint::Kind::avoid_vertex && c.location == agent().last_goal() && t < c.until);
        is_late = is_late || (c.kind == Constraint::Kind::pass_vertex && c.location != agent().last_goal() && t <= c.t);
      }
      if (is_late) break;
      from = t;
    }
    return from;
  }

  static Location place(planners::PathView path, int t) {
    return path[std::min(static_cast<std::size_t>(t), path.size() - 1)];
  }
  // The number of others at a place at time t, moving or resting.
  int others_at(Location at, int t) const {
    return static_cast<int>(
        std::count_if(others.begin(), others.end(), [&](const auto& path) { return place(path, t) == at; }));
  }
  int others_swapping(Location from, Location to, int t) const {
    if (from == to || t == 0) return 0;
    return static_cast<int>(std::count_if(others.begin(), others.end(), [&](const auto& path) {
      return place(path, t) == from && place(path, t - 1) == to;
    }));
  }
  bool is_passed(Location at, int t) const {
    return std::any_of(others.begin(), others.end(), [&](const auto& path) {
      return t < static_cast<int>(path.size()) && path[static_cast<std::size_t>(t)] == at;
    });
  }

  // The conflicts of a step that ends at time t, with `leg` before it. A stay is divided where the path may end, and
  // where one of its steps reaches the same goal again.
  int conflicts_of_step(Counting counting, Location from, Location to, int leg, int t) const {
    const int last = agent().last_leg();
    const bool is_end = to == agent().last_goal() && leg == last;
    const bool is_goal_twice = leg + 1 == last && to == agent().goal(leg) && to == agent().last_goal();
    const bool tells_apart = counting == Counting::by_step || from != to || is_passed(to, t) || is_passed(to, t - 1) ||
                             (is_end && t == rest_from()) || (is_goal_twice && t <= rest_from());
    return tells_apart ? others_at(to, t) + others_swapping(from, to, t) : 0;
  }
  // The conflicts of resting at the last goal from time t on: with the agents that pass later.
  int conflicts_of_rest(int t) const {
    int count = 0;
    for (const auto& path : others)
      for (int later = t + 1; later < static_cast<int>(path.size()); ++later)
        if (path[static_cast<std::size_t>(later)] == agent().last_goal()) ++count;
    return count;
  }
  // The conflicts of a whole path, except those at its start.
  int conflicts_of(Counting counting, planners::PathView path) const {
    int count = 0;
    int leg = 0;
    for (int t = 1; t < static_cast<int>(path.size()); ++t) {
      count += conflicts_of_step(counting, place(path, t - 1), place(path, t), leg, t);
      leg = agent().leg_after(leg, place(path, t - 1));
    }
    return count + conflicts_of_rest(planners::cost_of(path));
  }

  // By cost: the fewest conflicts of a path of that cost, if there is one; by dynamic programming over time. A path
  // does not wait at its end.
  std::map<int, int> fewest_conflicts_by_cost(Counting counting) const {
    std::map<int, int> out;
    using State = std::tuple<Location, int, bool>;  // place, leg, whether the last step waited at the end
    std::map<State, int> reached;
    if (may_be(agent().start, 0)) reached[{agent().start, 0, false}] = 0;
    for (int t = 0; t < horizon; ++t) {
      std::map<State, int> next;
      for (const auto& [state, conflicts] : reached) {
        const auto& [from, leg, has_waited] = state;
        const bool is_at_end = from == agent().last_goal() && leg == agent().last_leg();
        if (is_at_end && !has_waited && may_rest(t)) keep_least(out, t, conflicts + conflicts_of_rest(t));
        for (const Location to : reach(from))
          if (may_arrive(from, to, t + 1))
            keep_least(next, State(to, agent().leg_after(leg, from), is_at_end && to == from),
                       conflicts + conflicts_of_step(counting, from, to, leg, t + 1));
      }
      reached = std::move(next);
    }
    return out;
  }

 private:
  explicit LowLevelCase(Random random) : problem(problem_of(draw_grid(random))) {
    for (int walks = random.below(5); walks > 0; --walks) draw_walk(random);
    for (int n = random.below(7); n > 0; --n) draw_constraint(random);
  }

  static PlanningCase draw_grid(Random& random) {
    PlanningCase c({"....", ".#..", "...."});
    if (random.one_in(3)) c.thin_wall({2, 1}, {3, 1}).thin_wall({2, 0}, {2, 1});
    std::vector<CellXY> goals = {{random.below(4), 2}};
    if (random.one_in(3)) goals.push_back(random.one_in(3) ? goals.back() : CellXY{random.below(4), 2});
    if (random.one_in(6)) goals.insert(goals.begin(), CellXY{random.below(4), 0});
    return c.robot({random.below(4), 2 * random.below(2)}, goals);
  }
  Location draw_location(Random& random) const {
    for (;;)
      if (const Location at = random.below(problem.graph.location_count()); problem.graph.is_open(at)) return at;
  }
  void draw_walk(Random& random) {
    std::vector<Location> walk = {draw_location(random)};
    for (int steps = random.below(8); steps > 0; --steps) {
      const std::vector<Location> there = reach(walk.back());
      walk.push_back(there[static_cast<std::size_t>(random.below(static_cast<int>(there.size())))]);
    }
    if (std::none_of(others.begin(), others.end(), [&](const auto& path) { return path.back() == walk.back(); }))
      others.push_back(walk);
  }
  void draw_constraint(Random& random) {
    const Location at = random.one_in(4) ? agent().last_goal() : draw_location(random);
    const Location goal = agent().last_goal();
    const int t = random.below(9);
    switch (random.below(12)) {
      case 0:
      case 1:
      case 2:
        return constraints.push_back(planners::avoid_vertex(0, at, t));
      case 3:
      case 4:
        return constraints.push_back(planners::avoid_vertex_range(0, at, t, t + 1 + random.below(5)));
      case 5:
        return constraints.push_back(planners::avoid_vertex_range(0, draw_location(random), t, planners::forever));
      case 6:
      case 7:
      case 8:
        if (const Location from = problem.graph.predecessor(at, random.below(4)); from != planners::nowhere)
          constraints.push_back(planners::avoid_move(0, from, at, t + 1));
        return;
      case 9:
        return constraints.push_back(planners::pass_vertex(0, at, t));
      case 10:
        return constraints.push_back(planners::finish_after(0, goal, t));
      default:
        return constraints.push_back(planners::finish_by(0, goal, t + 4));
    }
  }

  template <class Key>
  static void keep_least(std::map<Key, int>& values, const Key& key, int value) {
    const auto [at, is_new] = values.emplace(key, value);
    if (!is_new) at->second = std::min(at->second, value);
  }
};

}  // namespace dmrp::test
