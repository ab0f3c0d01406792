// SPDX-License-Identifier: MIT
// The shared parts of the planners, against exhaustive methods.
#include <catch2/catch.hpp>
#include <numeric>
#include <set>

#include "planners/conflict_search/high_level/vertex_cover.hpp"
#include "planners/conflict_search/low_level/mdd.hpp"
#include "planners/mapf/solvability.hpp"
#include "tests/unit/planners/conflict_search/low_level_case.hpp"

using namespace dmrp::test;
using namespace dmrp::planners;

namespace {

// A walk on the case's grid; some are long, for tables that have to grow.
std::vector<Location> draw_walk(Random& random, const LowLevelCase& c) {
  std::vector<Location> walk = {random.one_in(2) ? 0 : 11};
  for (int steps = random.one_in(10) ? 60 + random.below(100) : random.below(10); steps > 0; --steps) {
    const std::vector<Location> reach = c.reach(walk.back());
    walk.push_back(reach[static_cast<std::size_t>(random.below(static_cast<int>(reach.size())))]);
  }
  return walk;
}

// What a constraint asks of a path that rests at its end, by looking at all times there are.
bool satisfies_by_definition(PathView path, const Constraint& c) {
  const int cost = cost_of(path);
  for (int t = 0; t < 200; ++t) {
    const Location at = LowLevelCase::place(path, t);
    if (c.kind == Constraint::Kind::avoid_vertex && c.t <= t && t < c.until && at == c.location) return false;
    if (c.kind == Constraint::Kind::avoid_move && t == c.t && t <= cost && at == c.location &&
        LowLevelCase::place(path, t - 1) == c.from)
      return false;
    if (c.kind == Constraint::Kind::pass_vertex && t == c.t && at != c.location) return false;
  }
  if (c.kind == Constraint::Kind::finish_after) return cost > c.t;
  return c.kind != Constraint::Kind::finish_by || cost <= c.t;
}

using ListedConflict = std::tuple<int, int, int, Location, Location>;

std::multiset<ListedConflict> conflicts_by_definition(int agent, PathView path, int other, PathView others) {
  std::multiset<ListedConflict> out;
  const auto at = LowLevelCase::place;
  const int a = std::min(agent, other);
  const int b = std::max(agent, other);
  const PathView first = agent < other ? path : others;
  for (int t = 0; t < static_cast<int>(std::max(path.size(), others.size())); ++t) {
    if (at(path, t) == at(others, t))
      out.insert({t, a, b, at(path, t), nowhere});
    else if (t > 0 && at(path, t) == at(others, t - 1) && at(path, t - 1) == at(others, t))
      out.insert({t, a, b, at(first, t), at(first, t - 1)});
  }
  return out;
}

// Levels of places on some path of the cost: forward from the start, then back from the end.
using Places = std::set<std::pair<Location, int>>;
std::vector<Places> places_by_definition(const LowLevelCase& c, int cost) {
  std::vector<Places> levels(static_cast<std::size_t>(cost) + 1);
  const auto successors = [&](const std::pair<Location, int>& from, int t) {
    Places out;
    const int leg = c.agent().leg_after(from.second, from.first);
    const bool is_at_end = from.first == c.agent().last_goal() && from.second == c.agent().last_leg();
    for (const Location to : c.reach(from.first))
      if (c.may_arrive(from.first, to, t + 1) && !(is_at_end && to == from.first && t + 1 == cost))
        out.insert({to, leg});
    return out;
  };
  levels[0].insert({c.agent().start, 0});
  for (int t = 0; t < cost; ++t)
    for (const auto& place : levels[static_cast<std::size_t>(t)])
      levels[static_cast<std::size_t>(t) + 1].merge(successors(place, t));
  for (int t = cost; t >= 0; --t) {
    Places kept;
    for (const auto& place : levels[static_cast<std::size_t>(t)]) {
      bool ends = t == cost && place == std::pair(c.agent().last_goal(), c.agent().last_leg());
      if (t < cost)
        for (const auto& next : successors(place, t))
          ends = ends || levels[static_cast<std::size_t>(t) + 1].count(next);
      if (ends) kept.insert(place);
    }
    levels[static_cast<std::size_t>(t)] = kept;
  }
  return levels;
}

// By trying all values up to the greatest weight.
int least_cover_by_trying(const std::vector<DependentPair>& pairs, int agents, int most) {
  std::vector<int> value(static_cast<std::size_t>(agents), 0);
  int best = agents * most;
  for (std::size_t i = 0; i < value.size();) {
    const bool covers = std::all_of(pairs.begin(), pairs.end(), [&](const DependentPair& pair) {
      return value[static_cast<std::size_t>(pair.a)] + value[static_cast<std::size_t>(pair.b)] >= pair.weight;
    });
    if (covers) best = std::min(best, std::accumulate(value.begin(), value.end(), 0));
    for (i = 0; i < value.size() && ++value[i] > most; ++i) value[i] = 0;
  }
  return best;
}

}  // namespace

TEST_CASE("a path satisfies a constraint by its definition") {
  int satisfied = 0;
  int broken = 0;
  for (uint64_t seed = 0; seed < 4000; ++seed) {
    CAPTURE(seed);
    const LowLevelCase c(seed);
    Random random(seed);
    const std::vector<Location> path = draw_walk(random, c);
    for (const Constraint& constraint : c.constraints) {
      const bool expected = satisfies_by_definition(path, constraint);
      REQUIRE(satisfies(path, constraint) == expected);
      ++(expected ? satisfied : broken);
    }
  }
  CHECK(satisfied > 1000);
  CHECK(broken > 1000);
}

TEST_CASE("what an agent promises keeps the others away") {
  const Constraint passes = pass_vertex(3, 7, 5);
  REQUIRE(passes.binds_others());
  CHECK(passes.for_another(4) == avoid_vertex(4, 7, 5));
  const Constraint finishes = finish_by(3, 7, 5);
  REQUIRE(finishes.binds_others());
  CHECK(finishes.for_another(4) == avoid_vertex_range(4, 7, 5, forever));
  CHECK_FALSE(finish_after(3, 7, 5).binds_others());
  CHECK_FALSE(avoid_vertex(3, 7, 5).binds_others());
  CHECK_FALSE(avoid_move(3, 6, 7, 5).binds_others());
}

TEST_CASE("a constraint table says what is allowed, and for how long that stays so") {
  for (uint64_t seed = 0; seed < 1000; ++seed) {
    CAPTURE(seed);
    const LowLevelCase c(seed);
    ConstraintTable table(c.problem.graph);
    table.fill(c.agent(), std::vector<Constraint>{avoid_vertex(0, 3, 4), pass_vertex(0, 3, 2), finish_after(0, 3, 9)});
    table.fill(c.agent(), c.constraints);  // and no more of those before
    const bool ends = table.finish_from() < LowLevelCase::horizon;
    for (int t = 0; t < 30 && ends; ++t) {
      const bool is_in_time = table.finish_from() <= t && t <= table.finish_until();
      REQUIRE(is_in_time == (c.may_rest(t) && t >= c.rest_from()));
    }
    for (Location at = 0; at < c.problem.graph.location_count(); ++at)
      for (int t = 0; t < 20; ++t) {
        std::int32_t first = 0;
        std::int32_t end = forever;
        const bool is_allowed = table.narrow(at, t, first, end);
        REQUIRE(is_allowed == c.may_be(at, t));
        REQUIRE(first <= t);
        REQUIRE(end > t);
        if (!is_allowed) {
          for (int later = t; later < std::min(end, 30); ++later) REQUIRE_FALSE(c.may_be(at, later));
          continue;
        }
        for (int other = first; other < std::min(end, 30); ++other) REQUIRE(c.may_be(at, other));
        REQUIRE((first == 0 || !c.may_be(at, first - 1)));
        REQUIRE((end == forever || !c.may_be(at, end)));
        for (const Location from : c.reach(at)) {
          if (t == 0 || !c.may_be(at, t)) continue;
          REQUIRE(table.allows_move(from, at, t) == c.may_arrive(from, at, t));
          REQUIRE(table.allows(from, at, t) == c.may_arrive(from, at, t));
        }
      }
  }
}

TEST_CASE("a conflict table knows who is where, whoever came and went") {
  for (uint64_t seed = 0; seed < 300; ++seed) {
    CAPTURE(seed);
    const LowLevelCase c(seed);
    Random random(seed);
    constexpr int agents = 5;
    ConflictTable table(c.problem.graph, agents);
    std::vector<std::vector<Location>> paths(agents);
    for (int change = 0; change < 12; ++change) {
      const auto agent = static_cast<std::size_t>(random.below(agents));
      table.set(static_cast<std::int32_t>(agent), {});
      paths[agent].clear();
      std::vector<Location> walk = draw_walk(random, c);
      const bool ends_alone = std::none_of(
          paths.begin(), paths.end(), [&](const auto& path) { return !path.empty() && path.back() == walk.back(); });
      if (!ends_alone || random.one_in(4)) continue;
      paths[agent] = std::move(walk);
      table.set(static_cast<std::int32_t>(agent), paths[agent]);
    }
    int longest = 0;
    for (const auto& path : paths) longest = std::max(longest, cost_of(path));
    REQUIRE(table.rest_from() == longest);
    for (Location at = 0; at < c.problem.graph.location_count(); ++at) {
      std::set<int> passed;  // times
      int visits_left = 0;
      for (const auto& path : paths)
        for (int t = 0; t < static_cast<int>(path.size()); ++t)
          if (path[static_cast<std::size_t>(t)] == at) passed.insert(t), ++visits_left;
      const auto resting = std::find_if(paths.begin(), paths.end(),
                                        [&](const auto& path) { return !path.empty() && path.back() == at; });
      REQUIRE(table.resting_from(at) == (resting == paths.end() ? forever : cost_of(*resting)));
      for (int t = 0; t < longest + 3; ++t) {
        const auto next = passed.lower_bound(t);
        const auto after = passed.upper_bound(t);
        REQUIRE(table.is_passed(at, t) == (passed.count(t) == 1));
        REQUIRE(table.next_passed(at, t) == (next == passed.end() ? forever : *next));
        REQUIRE(table.previous_passed(at, t) == (after == passed.begin() ? -1 : *std::prev(after)));
        for (const auto& path : paths)
          if (t < static_cast<int>(path.size()) && path[static_cast<std::size_t>(t)] == at) --visits_left;
        REQUIRE(table.count_after(at, t) == visits_left);
        for (const Location from : c.reach(at)) {
          int count = 0;
          for (const auto& path : paths) {
            if (path.empty()) continue;
            const bool meets = LowLevelCase::place(path, t) == at;
            const bool swaps = t > 0 && LowLevelCase::place(path, t) == from && LowLevelCase::place(path, t - 1) == at;
            count += meets || swaps ? 1 : 0;
          }
          REQUIRE(table.count_at(from, at, t) == count);
        }
      }
    }
  }
}

TEST_CASE("a conflict table lists every conflict once, in the order of time") {
  int listed = 0;
  for (uint64_t seed = 0; seed < 1000; ++seed) {
    CAPTURE(seed);
    const LowLevelCase c(seed);
    Random random(seed + 5);
    ConflictTable table(c.problem.graph, 9);
    std::multiset<ListedConflict> expected;
    const std::vector<Location> path = draw_walk(random, c);
    for (std::size_t i = 0; i < c.others.size(); ++i) {
      const auto other = static_cast<std::int32_t>(i < 2 ? i : i + 1);  // some before and some after number 2
      table.set(other, c.others[i]);
      expected.merge(conflicts_by_definition(2, path, other, c.others[i]));
    }
    std::vector<Conflict> conflicts;
    table.list(2, path, conflicts);
    REQUIRE(std::is_sorted(conflicts.begin(), conflicts.end(), [](auto& x, auto& y) { return x.t < y.t; }));
    std::multiset<ListedConflict> found;
    for (const Conflict& conflict : conflicts)
      found.insert({conflict.t, conflict.a, conflict.b, conflict.location, conflict.from});
    REQUIRE(found == expected);
    listed += static_cast<int>(found.size());
  }
  CHECK(listed > 1000);
}

TEST_CASE("an MDD holds exactly the places of all paths of least cost") {
  int with_landmarks = 0;
  for (uint64_t seed = 0; seed < 4000; ++seed) {
    CAPTURE(seed);
    const LowLevelCase c(seed);
    const std::map<int, int> costs = c.fewest_conflicts_by_cost(Counting::by_step);
    if (costs.empty()) continue;
    const int cost = costs.begin()->first;
    const auto tables = make_tour_tables(c.problem, never());
    MddCache cache(c.problem, *tables);
    std::vector<Constraint> constraints = c.constraints;
    const auto mdd = cache.get(0, constraints, std::max(0, cost - static_cast<int>(seed % 4)));
    REQUIRE(mdd->cost() == cost);
    const std::vector<Places> expected = places_by_definition(c, cost);
    for (int t = 0; t <= cost; ++t) {
      Places places;
      std::set<Location> locations;
      for (const Mdd::Node& node : mdd->level(t)) {
        REQUIRE(places.insert({node.location, node.leg}).second);
        locations.insert(node.location);
      }
      REQUIRE(places == expected[static_cast<std::size_t>(t)]);
      for (const Location location : locations) REQUIRE(mdd->must_be_at(location, t) == (locations.size() == 1));
    }
    REQUIRE(mdd->must_be_at(c.agent().last_goal(), cost + 3));
    std::reverse(constraints.begin(), constraints.end());
    if (!constraints.empty()) constraints.push_back(constraints.front());
    REQUIRE(cache.get(0, constraints, 0) == mdd);
    for (const Constraint& constraint : c.constraints)
      with_landmarks += constraint.kind == Constraint::Kind::pass_vertex ? 1 : 0;
  }
  CHECK(with_landmarks > 300);
}

TEST_CASE("a weighted vertex cover is the least there is") {
  for (uint64_t seed = 0; seed < 1500; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const int agents = 2 + random.below(4);
    const int most = 1 + random.below(4);
    std::vector<DependentPair> pairs;
    for (int a = 0; a < agents; ++a)
      for (int b = a + 1; b < agents; ++b)
        if (random.one_in(2)) pairs.push_back({10 * a, 10 * b, 1 + random.below(most)});
    std::vector<DependentPair> numbered = pairs;
    for (DependentPair& pair : numbered) pair.a /= 10, pair.b /= 10;
    REQUIRE(least_edge_weighted_cover(pairs, never()) == least_cover_by_trying(numbered, agents, most));
  }
}

TEST_CASE("where the least weighted vertex cover takes long to find, a lower bound stands for it") {
  std::vector<DependentPair> all;
  for (int a = 0; a < 40; ++a)
    for (int b = a + 1; b < 40; ++b) all.push_back({a, b, 1 + (a * 7 + b * 3) % 4});
  const int cover = least_edge_weighted_cover(all, never());
  CHECK(cover >= 4 * 10);  // of pairs without a common agent
  CHECK(cover <= 40 * 2);  // two each cover all
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
