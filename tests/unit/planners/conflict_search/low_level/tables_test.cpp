// SPDX-License-Identifier: MIT
// Constraints, conflict tables and MDDs, against exhaustive methods.
#include <catch2/catch.hpp>
#include <numeric>
#include <set>

#include "planners/conflict_search/low_level/mdd.hpp"
#include "tests/unit/planners/conflict_search/low_level/low_level_case.hpp"

namespace tables_test {

using namespace dmrp::test;
using namespace dmrp::planners;

// A walk on the case's grid. Some are long, so that tables have to grow.
std::vector<Location> draw_walk(Random& random, const LowLevelCase& c) {
  std::vector<Location> walk = {random.one_in(2) ? 0 : c.problem.graph.location_count() - 1};
  for (int steps = random.one_in(10) ? 60 + random.below(100) : random.below(10); steps > 0; --steps) {
    const std::vector<Location> reach = c.reach(walk.back());
    walk.push_back(reach[static_cast<std::size_t>(random.below(static_cast<int>(reach.size())))]);
  }
  return walk;
}

// Whether a path that rests at its end satisfies a constraint, by looking at all times.
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

// By time: the places on paths of the cost, forward from the start, then back from the end.
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

TEST_CASE("a constraint that binds others keeps them away") {
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

TEST_CASE("a constraint table knows what is allowed, and for how long") {
  for (uint64_t seed = 0; seed < 1000; ++seed) {
    CAPTURE(seed);
    const LowLevelCase c(seed);
    ConstraintTable table(c.problem.graph);
    table.fill(c.agent(), std::vector<Constraint>{avoid_vertex(0, 3, 4), pass_vertex(0, 3, 2), finish_after(0, 3, 9)});
    table.fill(c.agent(), c.constraints);  // replaces all earlier ones
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

TEST_CASE("a conflict table knows all positions after paths are added and removed") {
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

TEST_CASE("a conflict table lists every conflict once, by ascending time") {
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

}  // namespace tables_test
