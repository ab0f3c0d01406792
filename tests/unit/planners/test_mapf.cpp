// SPDX-License-Identifier: MIT
// The shared parts of the planners: what the low level and the MDDs promise, against exhaustive methods.
#include <algorithm>
#include <catch2/catch.hpp>
#include <dmrp/plugin.hpp>
#include <map>
#include <set>
#include <tuple>

#include "mapf/mdd.hpp"
#include "mapf/solvability.hpp"
#include "mapf/space_time_astar.hpp"
#include "planning_case.hpp"
#include "random.hpp"

using namespace dmrp::test;
using namespace dmrp::planners;

namespace {

StopSignal& never() {
  static StopSignal stop([] { return false; });
  return stop;
}

Problem problem_of(const PlanningCase& c) {
  const CProblem host(c);
  return make_problem(dmrp::PlanningProblem(host.problem()), true);
}

// One agent (number 2) with random constraints, among two others whose paths are random walks.
struct LowLevelCase {
  Problem problem;
  std::vector<std::vector<Location>> others;
  std::vector<Constraint> constraints;

  static PlanningCase grid(Random& random) {
    PlanningCase c({"....", ".#..", "...."});
    const CellXY start{random.below(4), 0};
    std::vector<CellXY> goals;
    for (int n = random.one_in(3) ? 2 : 1; n > 0; --n) goals.push_back({random.below(4), 2});
    return c.robot(start, goals);
  }

  explicit LowLevelCase(uint64_t seed) : LowLevelCase(Random(seed)) {}
  explicit LowLevelCase(Random random) : problem(problem_of(grid(random))) {
    const Location goal = problem.agents[0].last_goal();
    while (others.size() < 2) {
      std::vector<Location> walk = {8 + random.below(4)};
      for (int steps = random.below(7); steps > 0; --steps) {
        const Location to = problem.graph.neighbor(walk.back(), random.below(4));
        walk.push_back(to == nowhere ? walk.back() : to);
      }
      if (walk.back() != goal && (others.empty() || others[0].back() != walk.back())) others.push_back(walk);
    }
    for (int n = random.below(7); n > 0; --n) {
      const Location location = random.below(12);
      if (location == 5) continue;
      const Location from = random.one_in(2) ? problem.graph.neighbor(location, random.below(4)) : nowhere;
      constraints.push_back({2, location, from, 1 + random.below(7)});
    }
    if (random.one_in(2)) constraints.push_back({2, goal, nowhere, 1 + random.below(8)});
  }

  bool allows(Location from, Location to, int t) const {
    for (const Constraint& c : constraints)
      if (c.t == t && c.location == to && (c.from == nowhere || c.from == from)) return false;
    return true;
  }
  Location where(const std::vector<Location>& path, int t) const {
    return path[std::min(static_cast<std::size_t>(t), path.size() - 1)];
  }
  int conflicts(Location from, Location to, int t) const {
    int count = 0;
    for (const auto& path : others) {
      if (where(path, t) == to)
        ++count;
      else if (from != to && where(path, t) == from && where(path, t - 1) == to)
        ++count;
    }
    return count;
  }
  int rest_from() const {
    int from = 0;
    for (const Constraint& c : constraints)
      if (c.location == problem.agents[0].last_goal() && c.from == nowhere) from = std::max(from, c.t + 1);
    return from;
  }
};

using Quality = std::tuple<int, int, int>;  // steps, conflicts, turns

// By dynamic programming over time: the best of each (location, heading, leg).
std::optional<Quality> best_quality(const LowLevelCase& c) {
  const Agent& agent = c.problem.agents[0];
  std::map<std::tuple<Location, int, int>, std::pair<int, int>> reached;
  reached[{agent.start, 4, 0}] = {0, 0};
  std::optional<Quality> best;
  for (int t = 0; t < 40 && !best; ++t) {
    for (const auto& [state, quality] : reached) {
      const auto [location, heading, leg] = state;
      if (location != agent.last_goal() || leg != agent.last_leg() || t < c.rest_from()) continue;
      int after = 0;
      for (int later = t + 1; later < 10; ++later) after += c.conflicts(location, location, later);
      const Quality whole{t, quality.first + after, quality.second};
      best = best ? std::min(*best, whole) : whole;
    }
    std::map<std::tuple<Location, int, int>, std::pair<int, int>> next;
    for (const auto& [state, quality] : reached) {
      const auto [location, heading, leg] = state;
      for (int d = 0; d <= 4; ++d) {
        const Location to = d == 4 ? location : c.problem.graph.neighbor(location, d);
        if (to == nowhere || !c.allows(location, to, t + 1)) continue;
        const int turn = d != 4 && heading != 4 && heading != d ? 1 : 0;
        const std::pair<int, int> arrived{quality.first + c.conflicts(location, to, t + 1), quality.second + turn};
        const std::tuple<Location, int, int> key{to, d == 4 ? heading : d, agent.leg_after(leg, location)};
        const auto [at, is_new] = next.emplace(key, arrived);
        if (!is_new) at->second = std::min(at->second, arrived);
      }
    }
    reached = std::move(next);
  }
  return best;
}

Quality quality_of(const LowLevelCase& c, PathView path) {
  int conflicts = 0;
  for (int t = 1; t < static_cast<int>(path.size()) + 10; ++t) {
    const auto at = [&](int s) { return path[std::min(static_cast<std::size_t>(s), path.size() - 1)]; };
    conflicts += c.conflicts(at(t - 1), at(t), t);
  }
  return {cost_of(path), conflicts, count_turns(c.problem.graph, path)};
}

struct Searched {
  SpaceTimeAStar::Result result;
  std::vector<Location> path;
  std::vector<Conflict> conflicts;
};

Searched search(const LowLevelCase& c, const TourTable& table) {
  ConflictTable others(c.problem.graph, 3);
  others.set(0, c.others[1]);
  others.set(0, {});  // leaves no trace
  for (int i = 0; i < 2; ++i) others.set(i, c.others[static_cast<std::size_t>(i)]);
  ConstraintTable constraints(c.problem.graph);
  constraints.fill({{2, 0, nowhere, 30}});  // forgotten by the next
  constraints.fill(c.constraints);
  SpaceTimeAStar astar(c.problem.graph);
  Searched out{SpaceTimeAStar::Result::none, {}, {}};
  out.result = astar.search(c.problem.agents[0], table, constraints, others, never(), out.path);
  if (out.result == SpaceTimeAStar::Result::found) others.list(2, out.path, out.conflicts);
  return out;
}

}  // namespace

TEST_CASE("space-time A* finds the fewest steps, then conflicts, then turns") {
  for (uint64_t seed = 0; seed < 3000; ++seed) {
    CAPTURE(seed);
    const LowLevelCase c(seed);
    const TourTable table(c.problem.graph, c.problem.agents[0], never());
    const Searched searched = search(c, table);
    const std::optional<Quality> best = best_quality(c);
    REQUIRE(best);
    REQUIRE(searched.result == SpaceTimeAStar::Result::found);
    for (std::size_t t = 1; t < searched.path.size(); ++t)
      REQUIRE(c.allows(searched.path[t - 1], searched.path[t], static_cast<int>(t)));
    REQUIRE(cost_of(searched.path) >= c.rest_from());
    REQUIRE(quality_of(c, searched.path) == *best);
  }
}

TEST_CASE("space-time A* ends where constraints leave no path, or when stopped") {
  PlanningCase c({"..."});
  c.robot({0, 0}, {{2, 0}});
  const Problem problem = problem_of(c);
  const TourTable table(problem.graph, problem.agents[0], never());
  const ConflictTable nobody(problem.graph, 1);
  ConstraintTable constraints(problem.graph);
  SpaceTimeAStar astar(problem.graph);
  std::vector<Location> path;
  constraints.fill({{0, 0, nowhere, 3}, {0, 1, 0, 1}, {0, 1, 0, 2}, {0, 1, nowhere, 3}});
  CHECK(astar.search(problem.agents[0], table, constraints, nobody, never(), path) == SpaceTimeAStar::Result::none);

  // Kept off its goal at 5: it may be there before, but ends there at 6 at the earliest.
  constraints.fill({{0, 2, nowhere, 5}});
  REQUIRE(astar.search(problem.agents[0], table, constraints, nobody, never(), path) == SpaceTimeAStar::Result::found);
  CHECK(cost_of(path) == 6);
  CHECK(path[5] == 1);

  StopSignal stop([] { return true; });
  stop.poll_now();
  CHECK(astar.search(problem.agents[0], table, constraints, nobody, stop, path) == SpaceTimeAStar::Result::stopped);
}

TEST_CASE("the conflict table lists every conflict once, in the order of time") {
  for (uint64_t seed = 0; seed < 500; ++seed) {
    CAPTURE(seed);
    const LowLevelCase c(seed);
    const TourTable table(c.problem.graph, c.problem.agents[0], never());
    const Searched searched = search(c, table);
    if (searched.result != SpaceTimeAStar::Result::found) continue;
    // Until everybody rests: a path's end that stands on another's way counts step by step.
    std::multiset<std::tuple<int, int, Location>> expected;
    std::size_t steps = searched.path.size();
    for (const auto& path : c.others) steps = std::max(steps, path.size());
    for (int t = 0; t < static_cast<int>(steps); ++t)
      for (int other = 0; other < 2; ++other) {
        const auto& path = c.others[static_cast<std::size_t>(other)];
        const Location to = c.where(searched.path, t);
        const Location from = c.where(searched.path, std::max(0, t - 1));
        if (c.where(path, t) == to)
          expected.insert({t, other, to});
        else if (t > 0 && from != to && c.where(path, t) == from && c.where(path, t - 1) == to)
          expected.insert({t, other, from});  // seen from the other agent, whose number is smaller
      }
    std::multiset<std::tuple<int, int, Location>> listed;
    for (const Conflict& conflict : searched.conflicts) {
      REQUIRE(conflict.b == 2);
      listed.insert({conflict.t, conflict.a, conflict.location});
    }
    REQUIRE(listed == expected);
  }
}

TEST_CASE("an MDD holds exactly the places of all best paths") {
  for (uint64_t seed = 0; seed < 1000; ++seed) {
    CAPTURE(seed);
    const LowLevelCase c(seed);
    const Agent& agent = c.problem.agents[0];
    std::vector<TourTable> tables;
    tables.emplace_back(c.problem.graph, agent, never());
    const Searched searched = search(c, tables[0]);
    if (searched.result != SpaceTimeAStar::Result::found) continue;
    const int cost = cost_of(searched.path);

    // Places reached from the start, and of these the ones from which the end can be reached, step by step.
    using Place = std::pair<Location, int>;
    std::vector<std::set<Place>> levels(static_cast<std::size_t>(cost) + 1);
    const auto successors = [&](Place from, int t) {
      std::vector<Place> out;
      for (int d = 0; d <= 4; ++d) {
        const Location to = d == 4 ? from.first : c.problem.graph.neighbor(from.first, d);
        if (to != nowhere && c.allows(from.first, to, t + 1))
          out.push_back({to, agent.leg_after(from.second, from.first)});
      }
      return out;
    };
    levels[0].insert({agent.start, 0});
    for (int t = 0; t < cost; ++t)
      for (const Place& place : levels[static_cast<std::size_t>(t)])
        for (const Place& next : successors(place, t)) levels[static_cast<std::size_t>(t) + 1].insert(next);
    for (int t = cost; t >= 0; --t) {
      std::set<Place> kept;
      for (const Place& place : levels[static_cast<std::size_t>(t)]) {
        bool ends = t == cost && place == Place{agent.last_goal(), agent.last_leg()};
        if (t < cost)
          for (const Place& next : successors(place, t))
            ends = ends || levels[static_cast<std::size_t>(t) + 1].count(next);
        if (ends) kept.insert(place);
      }
      levels[static_cast<std::size_t>(t)] = kept;
    }

    MddCache cache(c.problem, tables);
    const Mdd& mdd = cache.get(0, c.constraints, cost);
    REQUIRE(mdd.cost() == cost);
    for (int t = 0; t <= cost; ++t) {
      std::multiset<Place> nodes;
      std::set<Location> locations;
      for (const Mdd::Node& node : mdd.level(t)) {
        nodes.insert({node.location, node.leg});
        locations.insert(node.location);
      }
      const auto& expected = levels[static_cast<std::size_t>(t)];
      REQUIRE(nodes == std::multiset<Place>(expected.begin(), expected.end()));
      REQUIRE(mdd.must_be_at(searched.path[static_cast<std::size_t>(t)], t) == (locations.size() == 1));
    }
    auto reordered = c.constraints;
    std::reverse(reordered.begin(), reordered.end());
    REQUIRE(&cache.get(0, reordered, cost) == &mdd);
  }
}

TEST_CASE("a graph follows the edge mask both ways") {
  PlanningCase c({"...", "..."});
  c.close_one_way({0, 0}, {1, 0});
  c.robot({0, 0}, {{2, 1}}).robot({2, 0}, {}, DMRP_ROBOT_FINISHED);
  const Problem problem = problem_of(c);
  const GridGraph& graph = problem.graph;
  CHECK(graph.neighbor(0, 0) == nowhere);
  CHECK(graph.predecessor(1, 0) == nowhere);
  CHECK(graph.neighbor(1, 2) == 0);
  CHECK(graph.predecessor(0, 2) == 1);
  CHECK(graph.neighbor(1, 1) == 4);
  CHECK(graph.neighbor(0, 2) == nowhere);
  CHECK_FALSE(graph.is_open(2));  // where a robot rests
  CHECK(graph.neighbor(1, 0) == nowhere);
  CHECK(graph.neighbor(5, 3) == nowhere);
  CHECK(problem.agents.size() == 1);
}

TEST_CASE("joint positions prove what cannot be, and nothing beyond their limit") {
  // A T: three robots cannot all change places around one branch that is one cell deep.
  PlanningCase c({"...", "#.#"});
  c.robot({0, 0}, {{2, 0}}).robot({2, 0}, {{0, 0}}).robot({1, 1}, {{1, 1}});
  const Problem problem = problem_of(c);
  CHECK_FALSE(find_obvious_obstruction(problem));
  CHECK(find_joint_obstruction(problem, 64, never()));
  CHECK_FALSE(find_joint_obstruction(problem, 63, never()));

  PlanningCase solvable({"...", "#.#"});
  solvable.robot({0, 0}, {{2, 0}}).robot({2, 0}, {{0, 0}});
  CHECK_FALSE(find_joint_obstruction(problem_of(solvable), 1000, never()));
}
