// SPDX-License-Identifier: MIT
// Two agents with constraints on a small grid, and exhaustive methods to check symmetry reasoning.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <dmrp/plugin.hpp>
#include <optional>
#include <vector>

#include "planners/conflict_search/low_level/mdd.hpp"
#include "planners/conflict_search/symmetry/symmetry_split.hpp"
#include "tests/unit/planners/mapf/problem_case.hpp"
#include "tests/unit/planners/random.hpp"

namespace dmrp::test {

class TwoAgents {
 public:
  using Location = planners::Location;
  using Constraint = planners::Constraint;
  using Path = std::vector<Location>;

  // The horizon of all exhaustive methods.
  static constexpr int horizon = 26;

  planners::Problem problem;
  std::array<std::vector<Constraint>, 2> constraints;

  explicit TwoAgents(const PlanningCase& c) : problem(problem_of(c)) {
    for (Location from = 0; from < problem.graph.location_count(); ++from) {
      reach_.push_back({from});
      for (int d = 0; d < 4; ++d)
        if (problem.graph.neighbor(from, d) != planners::nowhere)
          reach_.back().push_back(problem.graph.neighbor(from, d));
    }
  }

  const planners::Agent& agent(int who) const { return problem.agents[static_cast<std::size_t>(who)]; }
  const std::vector<Constraint>& of(int who) const { return constraints[static_cast<std::size_t>(who)]; }

  // The locations within one step.
  const Path& reach(Location from) const { return reach_[static_cast<std::size_t>(from)]; }

  // Whether a step (or being at the start) satisfies all constraints of the list.
  static bool may_arrive(const std::vector<Constraint>& list, Location from, Location to, int t) {
    for (const Constraint& c : list) {
      const bool in_time = c.t <= t && t < c.until;
      if (c.kind == Constraint::Kind::avoid_vertex && in_time && c.location == to) return false;
      if (c.kind == Constraint::Kind::avoid_move && in_time && c.location == to && c.from == from) return false;
      if (c.kind == Constraint::Kind::pass_vertex && c.t == t && c.location != to) return false;
    }
    return true;
  }

  // Whether the list requires the agent to come to rest later, or earlier.
  static bool ends_too_early(const std::vector<Constraint>& list, int t) {
    return std::any_of(list.begin(), list.end(),
                       [&](const Constraint& c) { return c.kind == Constraint::Kind::finish_after && t <= c.t; });
  }
  static bool ends_too_late(const std::vector<Constraint>& list, int t) {
    return std::any_of(list.begin(), list.end(),
                       [&](const Constraint& c) { return c.kind == Constraint::Kind::finish_by && t > c.t; });
  }

  // By time: whether the agent may come to rest at its goal.
  std::vector<bool> times_to_rest(int who, const std::vector<Constraint>& list) const {
    std::vector<bool> may_rest(static_cast<std::size_t>(horizon) + 1);
    const Location goal = agent(who).last_goal();
    bool may_stay = true;
    for (int t = horizon; t >= 0; --t) {
      may_rest[static_cast<std::size_t>(t)] = may_stay && !ends_too_early(list, t) && !ends_too_late(list, t);
      may_stay = may_stay && may_arrive(list, goal, goal, t);
    }
    return may_rest;
  }

  // Calls visit(t, where) for the times up to the horizon until it returns true. `where` says for each location whether
  // the agent can be there, without the move from `not_from` to `not_to`.
  template <class Visit>
  void spread(int who, const std::vector<Constraint>& list, Location not_from, Location not_to, Visit visit) const {
    const Location start = agent(who).start;
    std::vector<char> now(static_cast<std::size_t>(problem.graph.location_count()), false);
    std::vector<char> next(now.size());
    now[static_cast<std::size_t>(start)] = may_arrive(list, start, start, 0);
    for (int t = 0; t <= horizon && !visit(t, now); ++t) {
      std::fill(next.begin(), next.end(), false);
      for (Location from = 0; from < problem.graph.location_count(); ++from)
        if (now[static_cast<std::size_t>(from)])
          for (const Location to : reach(from))
            if (may_arrive(list, from, to, t + 1) && !(from == not_from && to == not_to))
              next[static_cast<std::size_t>(to)] = true;
      now.swap(next);
    }
  }
  std::optional<int> earliest_arrival(int who, Location to, Location not_from, int latest) const {
    std::optional<int> earliest;
    spread(who, of(who), not_from, to, [&](int t, const std::vector<char>& where) {
      if (t <= latest && where[static_cast<std::size_t>(to)]) earliest = t;
      return earliest || t >= latest;
    });
    return earliest;
  }

  // The least cost of a path, from `at_least` on. A path ends with a move to its goal, or where it begins.
  std::optional<int> next_cost(int who, const std::vector<Constraint>& list, int at_least) const {
    std::optional<int> cost;
    const std::vector<bool> may_rest = times_to_rest(who, list);
    const Location goal = agent(who).last_goal();
    std::vector<char> before;
    spread(who, list, planners::nowhere, planners::nowhere, [&](int t, const std::vector<char>& where) {
      bool arrives = t == 0 && where[static_cast<std::size_t>(goal)];
      for (std::size_t from = 0; from < before.size(); ++from) {
        const auto place = static_cast<Location>(from);
        const Path& there = reach(place);
        arrives = arrives || (before[from] && place != goal && may_arrive(list, place, goal, t) &&
                              std::find(there.begin(), there.end(), goal) != there.end());
      }
      if (t >= at_least && arrives && may_rest[static_cast<std::size_t>(t)]) cost = t;
      before = where;
      return cost.has_value();
    });
    return cost;
  }
  bool has_path(int who, const std::vector<Constraint>& list, int cost) const {
    return next_cost(who, list, cost) == cost;
  }
  std::optional<int> least_cost(int who) const { return next_cost(who, of(who), 0); }

  // A path of that cost under the agent's constraints. There must be one.
  Path draw_path(Random& random, int who, int cost) const {
    // By time: the locations from which the path can be completed.
    std::vector<std::vector<bool>> ways(static_cast<std::size_t>(cost) + 1);
    for (int t = cost; t >= 0; --t) {
      std::vector<bool>& here = ways[static_cast<std::size_t>(t)];
      here.assign(static_cast<std::size_t>(problem.graph.location_count()), false);
      for (std::size_t from = 0; from < here.size(); ++from) {
        if (t == cost) here[from] = static_cast<Location>(from) == agent(who).last_goal();
        if (t < cost)
          for (const Location to : reach(static_cast<Location>(from)))
            if ((t + 1 < cost || to != static_cast<Location>(from)) &&
                ways[static_cast<std::size_t>(t) + 1][static_cast<std::size_t>(to)] &&
                may_arrive(of(who), static_cast<Location>(from), to, t + 1))
              here[from] = true;
      }
    }
    Path path = {agent(who).start};
    for (int t = 1; t <= cost; ++t) {
      Path next;
      for (const Location to : reach(path.back()))
        if (ways[static_cast<std::size_t>(t)][static_cast<std::size_t>(to)] &&
            may_arrive(of(who), path.back(), to, t) && (t < cost || to != path.back()))
          next.push_back(to);
      path.push_back(next[static_cast<std::size_t>(random.below(static_cast<int>(next.size())))]);
    }
    return path;
  }

  static Location place(const Path& path, int t) {
    return path[std::min(static_cast<std::size_t>(t), path.size() - 1)];
  }

  // By ascending time.
  static std::vector<planners::Conflict> conflicts(const Path& a, const Path& b) {
    std::vector<planners::Conflict> all;
    for (int t = 0; t < static_cast<int>(std::max(a.size(), b.size())); ++t) {
      if (place(a, t) == place(b, t))
        all.push_back({0, 1, place(a, t), planners::nowhere, t});
      else if (t > 0 && place(a, t) == place(b, t - 1) && place(a, t - 1) == place(b, t))
        all.push_back({0, 1, place(a, t), place(a, t - 1), t});
    }
    return all;
  }

  // Whether there are two paths without a conflict that satisfy their agents' constraints, come to rest before the
  // horizon, and both violate their set.
  bool some_pair_breaks_both(const std::array<std::vector<Constraint>, 2>& sets) const {
    const Location count = problem.graph.location_count();
    const auto at = [&](Location a, Location b) { return static_cast<std::size_t>(a * count + b); };
    const std::array may_rest = {times_to_rest(0, of(0)), times_to_rest(1, of(1))};
    std::vector<States> now(at(count, 0), 0);
    std::vector<States> next(now.size(), 0);
    for (int t = 0; t <= horizon; ++t) {
      const std::array steps = {steps_at(0, sets[0], t), steps_at(1, sets[1], t)};
      std::fill(next.begin(), next.end(), States{0});
      for (const Step& a : steps[0])
        for (const Step& b : steps[1]) {
          if (a.to == b.to || (a.to == b.from && b.to == a.from)) continue;
          States states = t == 0 ? States{1} : now[at(a.from, b.from)];
          if (states == 0) continue;
          for (const auto& [bit, step] : {std::pair{0, &a}, std::pair{1, &b}}) {
            if (step->to != step->from) states &= static_cast<States>(~states_with(bit));  // a resting agent stays
            if (step->breaks_set) states = switch_on(2 + bit, states);
            const auto who = static_cast<std::size_t>(bit);
            const bool arrives = step->to == agent(bit).last_goal() && (t == 0 || step->from != step->to);
            if (arrives && may_rest[who][static_cast<std::size_t>(t)])
              states |= come_to_rest(bit, ends_too_early(sets[who], t), states);
          }
          next[at(a.to, b.to)] |= states;
        }
      now.swap(next);
    }
    return std::any_of(now.begin(), now.end(), [&](States states) { return (states >> 15) != 0; });
  }

 private:
  // The possible histories of two agents at a pair of locations: bit i stands for state i, whose own bits say whether a
  // rests, b rests, a violated its set, b violated its set.
  using States = std::uint16_t;

  static States states_with(int bit) {
    constexpr std::array<States, 4> with = {0xAAAA, 0xCCCC, 0xF0F0, 0xFF00};
    return with[static_cast<std::size_t>(bit)];
  }
  static States switch_on(int bit, States states) {
    const States without = states & static_cast<States>(~states_with(bit));
    return static_cast<States>((states & states_with(bit)) | (without << (1 << bit)));
  }
  static States come_to_rest(int who, bool breaks_set, States states) {
    const States resting = switch_on(who, states & static_cast<States>(~states_with(who)));
    return breaks_set ? switch_on(2 + who, resting) : resting;
  }

  struct Step {
    Location from;
    Location to;
    bool breaks_set;
  };
  // The steps that end at time t under the agent's constraints; at time 0 a step to its start.
  std::vector<Step> steps_at(int who, const std::vector<Constraint>& set, int t) const {
    std::vector<Step> steps;
    for (Location from = 0; from < problem.graph.location_count(); ++from) {
      if (!problem.graph.is_open(from) || (t == 0 && from != agent(who).start)) continue;
      for (const Location to : reach(from))
        if ((t > 0 || to == from) && may_arrive(of(who), from, to, t))
          steps.push_back({from, to, !may_arrive(set, from, to, t)});
    }
    return steps;
  }

  std::vector<Path> reach_;
};

}  // namespace dmrp::test
