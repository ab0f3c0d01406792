// SPDX-License-Identifier: MIT
// Pairwise symmetry reasoning, against exhaustive search over pairs of paths.
#include <algorithm>
#include <catch2/catch.hpp>

#include "planners/conflict_search/symmetry/corridor.hpp"
#include "planners/conflict_search/symmetry/rectangle.hpp"
#include "tests/unit/planners/conflict_search/symmetry/two_agents.hpp"

namespace symmetry_test {

using namespace dmrp::test;
using namespace dmrp::planners;

// The tasks of a pair of robots.
enum class Traffic {
  any,
  crossing,  // both from near one corner to near the opposite one
  head_on,   // one from west to east, one from east to west
};

// The ends are the two starts and the two goals.
CellXY draw_end(Random& random, Traffic traffic, std::size_t end, int width, int height) {
  if (traffic == Traffic::any) return {random.below(width), random.below(height)};
  if (traffic == Traffic::head_on) {
    const int x = random.below(std::max(width / 3, 1));
    return {end == 0 || end == 3 ? x : width - 1 - x, random.below(height)};
  }
  const CellXY near_corner{random.below((width + 1) / 2), random.below((height + 1) / 2)};
  return end >= 2 ? CellXY{width - 1 - near_corner.x, height - 1 - near_corner.y} : near_corner;
}

// A grid with some obstacles and thin walls and two robots.
PlanningCase draw_grid(Random& random, Traffic traffic, int obstacles_one_in) {
  const int width = 3 + random.below(4);
  const int height = 3 + random.below(3);
  const bool mirrored = random.one_in(2);
  std::vector<std::string> rows(static_cast<std::size_t>(height), std::string(static_cast<std::size_t>(width), '.'));
  for (std::string& row : rows)
    for (char& cell : row)
      if (random.one_in(obstacles_one_in)) cell = '#';
  std::vector<CellXY> ends;
  while (ends.size() < 4) {
    CellXY c = draw_end(random, traffic, ends.size(), width, height);
    if (mirrored) c.x = width - 1 - c.x;
    if (ends.size() % 2 == 1 && c == ends.back()) continue;
    rows[static_cast<std::size_t>(c.y)][static_cast<std::size_t>(c.x)] = '.';
    ends.push_back(c);
  }
  PlanningCase c(rows);
  for (int walls = random.below(4); walls > 0; --walls) {
    const CellXY a{random.below(width), random.below(height)};
    const CellXY b = random.one_in(2) ? CellXY{a.x + 1, a.y} : CellXY{a.x, a.y + 1};
    if (c.is_free(a) && c.is_free(b)) c.thin_wall(a, b);
  }
  return c.robot(ends[0], {ends[2]}).robot(ends[1], {ends[3]});
}

// Up to four constraints under which the agent still has a path.
void draw_constraints(Random& random, TwoAgents& pair, int who) {
  std::vector<Constraint>& list = pair.constraints[static_cast<std::size_t>(who)];
  for (int n = random.below(5); n > 0; --n) {
    const Location location = random.below(pair.problem.graph.location_count());
    const Location from = pair.problem.graph.predecessor(location, random.below(4));
    const int t = 1 + random.below(8);
    const int kind = random.below(8);
    if (kind < 3) list.push_back(avoid_vertex(who, location, t));
    if (kind == 3 || kind == 4) list.push_back(avoid_vertex_range(who, location, t, t + 1 + random.below(4)));
    if (kind == 5 && from != nowhere) list.push_back(avoid_move(who, from, location, t));
    if (kind == 6) list.push_back(pass_vertex(who, location, t));
    if (kind == 7) list.push_back(finish_after(who, pair.agent(who).last_goal(), t));
    if (!list.empty() && !pair.least_cost(who)) list.pop_back();
  }
}

// Two agents on their paths, one of the conflicts between them, and the MDDs of their least costs.
struct ConflictCase {
  TwoAgents pair;
  std::array<int, 2> least{};
  std::array<TwoAgents::Path, 2> paths;
  std::optional<Conflict> conflict;

  // The paths are up to `slack` steps longer than necessary. With `late_ends` constraints delay the agents' rest.
  ConflictCase(Random& random, const PlanningCase& grid, bool constrained, int slack, bool late_ends = false)
      : pair(grid) {
    for (int who = 0; who < 2; ++who) {
      const auto i = static_cast<std::size_t>(who);
      if (!pair.least_cost(who)) return;
      if (constrained) draw_constraints(random, pair, who);
      if (late_ends)
        pair.constraints[i].push_back(finish_after(who, pair.agent(who).last_goal(), *pair.least_cost(who)));
      if (!pair.least_cost(who)) return;
      least[i] = *pair.least_cost(who);
      int cost = least[i] + random.below(slack + 1);
      while (!pair.has_path(who, pair.of(who), cost)) --cost;
      paths[i] = pair.draw_path(random, who, cost);
    }
    for (const TwoAgents::Path& path : paths)
      if (path.size() > 1 && path.back() == path[path.size() - 2]) return;  // its cost would be less
    const std::vector<Conflict> conflicts = TwoAgents::conflicts(paths[0], paths[1]);
    if (!conflicts.empty())
      conflict =
          conflicts[random.one_in(2) ? 0 : static_cast<std::size_t>(random.below(static_cast<int>(conflicts.size())))];
  }

  ConflictCase(TwoAgents agents, std::array<TwoAgents::Path, 2> both, const Conflict& of_them)
      : pair(std::move(agents)), paths(std::move(both)), conflict(of_them) {
    for (int who = 0; who < 2; ++who) least[static_cast<std::size_t>(who)] = *pair.least_cost(who);
  }

  ConstraintTable constraint_table(int who) const {
    ConstraintTable constraints(pair.problem.graph);
    constraints.fill(pair.agent(who), pair.of(who));
    return constraints;
  }
  TourTable tour_table(int who) const { return TourTable(pair.problem.graph, pair.agent(who)); }
  Mdd mdd(int who) const {
    return Mdd(pair.problem.graph, pair.agent(who), tour_table(who), constraint_table(who),
               least[static_cast<std::size_t>(who)]);
  }
};

struct Tally {
  int splits = 0;
  std::array<int, 3> raising{};  // by the number of agents whose cost rises
  int beyond_the_conflict = 0;   // more than two constraints in all
};

// Whether no path of the least cost satisfies the agent's set.
bool rules_out_the_least_cost(const ConflictCase& c, const SymmetrySplit& split, int who) {
  const auto i = static_cast<std::size_t>(who);
  std::vector<Constraint> all = c.pair.of(who);
  all.insert(all.end(), split.constraints[i].begin(), split.constraints[i].end());
  return !c.pair.has_path(who, all, c.least[i]);
}

bool is_satisfied(const SymmetrySplit& split, int who, PathView path) {
  const auto& set = split.constraints[static_cast<std::size_t>(who)];
  return std::all_of(set.begin(), set.end(), [&](const Constraint& c) { return c.agent == who && satisfies(path, c); });
}

void check_split(const ConflictCase& c, const SymmetrySplit& split, Tally& tally) {
  int raising = 0;
  for (int who = 0; who < 2; ++who) {
    const auto i = static_cast<std::size_t>(who);
    REQUIRE_FALSE(is_satisfied(split, who, c.paths[i]));
    const bool raises = rules_out_the_least_cost(c, split, who);
    if (split.raises_cost[i]) REQUIRE(raises);
    // An MDD may contain slightly more than the paths that satisfy all constraints.
    if (c.pair.of(who).empty()) REQUIRE(split.raises_cost[i] == raises);
    raising += split.raises_cost[i];
  }
  REQUIRE_FALSE(c.pair.some_pair_breaks_both(split.constraints));
  ++tally.splits;
  ++tally.raising[static_cast<std::size_t>(raising)];
  tally.beyond_the_conflict += split.constraints[0].size() + split.constraints[1].size() > 2;
}

std::optional<SymmetrySplit> rectangle_of(const ConflictCase& c) {
  return find_rectangle(c.pair.problem.graph, *c.conflict, c.mdd(0), c.mdd(1), c.paths[0], c.paths[1]);
}

Tally draw_rectangles(uint64_t seed, int draws, bool constrained, int slack, bool late_ends = false) {
  Random random(seed);
  Tally tally;
  for (int i = 0; i < draws; ++i) {
    const ConflictCase c(random,
                         draw_grid(random, random.one_in(5) ? Traffic::any : Traffic::crossing, 4 + random.below(40)),
                         constrained, slack, late_ends);
    if (!c.conflict) continue;
    CAPTURE(seed, i);
    if (const auto split = rectangle_of(c)) check_split(c, *split, tally);
  }
  return tally;
}

std::optional<SymmetrySplit> corridor_of(const ConflictCase& c) {
  const Corridors corridors(c.pair.problem.graph);
  const auto passage = find_passage(corridors, *c.conflict, c.paths[0], c.paths[1]);
  if (!passage) return std::nullopt;
  const std::array tables = {c.tour_table(0), c.tour_table(1)};
  const std::array constraints = {c.constraint_table(0), c.constraint_table(1)};
  const std::array mdds = {c.mdd(0), c.mdd(1)};
  EarliestArrival earliest_arrival(c.pair.problem.graph);
  return find_corridor(c.pair.problem.graph, *passage, *c.conflict,
                       {c.pair.agent(0), tables[0], constraints[0], mdds[0], c.paths[0]},
                       {c.pair.agent(1), tables[1], constraints[1], mdds[1], c.paths[1]}, earliest_arrival);
}

struct CorridorTally {
  Tally edges;
  Tally chains;
  Tally ends_inside;
};

Tally& tally_of(CorridorTally& tally, const Passage& passage) {
  if (passage.ways[0].ends_inside() || passage.ways[1].ends_inside()) return tally.ends_inside;
  return passage.ways[0].length == 1 ? tally.edges : tally.chains;
}

CorridorTally draw_corridors(uint64_t seed, int draws, bool constrained, int slack) {
  Random random(seed);
  CorridorTally tally;
  for (int i = 0; i < draws; ++i) {
    const ConflictCase c(random,
                         draw_grid(random, random.one_in(5) ? Traffic::any : Traffic::head_on, 2 + random.below(6)),
                         constrained, slack);
    if (!c.conflict) continue;
    CAPTURE(seed, i);
    const Corridors corridors(c.pair.problem.graph);
    const auto passage = find_passage(corridors, *c.conflict, c.paths[0], c.paths[1]);
    if (!passage) continue;
    if (const auto split = corridor_of(c)) check_split(c, *split, tally_of(tally, *passage));
  }
  return tally;
}

TEST_CASE("the exhaustive search over pairs of paths finds a pair that violates both sets") {
  TwoAgents pair(PlanningCase({"...", "..."}).robot({0, 0}, {{2, 0}}).robot({2, 1}, {{0, 1}}));
  CHECK(pair.some_pair_breaks_both({{{avoid_vertex(0, 1, 1)}, {avoid_vertex(1, 4, 1)}}}));
  CHECK_FALSE(pair.some_pair_breaks_both({{{avoid_vertex(0, 1, 1)}, {avoid_vertex(1, 1, 1)}}}));
}

TEST_CASE("a rectangle split loses no pair of paths without conflict and reports raised costs") {
  const Tally plain = draw_rectangles(1, 3000, false, 0);
  const Tally constrained = draw_rectangles(2, 6000, true, 0);
  const Tally longer = draw_rectangles(3, 20000, true, 3);
  CHECK(draw_rectangles(4, 20000, true, 3, true).splits > 30);
  for (const Tally& tally : {plain, constrained, longer}) {
    CHECK(tally.splits > 100);
    CHECK(tally.raising[0] > 5);
    CHECK(tally.raising[1] > 20);
    CHECK(tally.raising[2] > 10);
  }
}

TEST_CASE("two agents that cross an open square are split by its far sides") {
  // a goes from the west side to the east side, b from south to north. Both may go north and east on the way.
  TwoAgents pair(
      PlanningCase({".....", ".....", ".....", ".....", "....."}).robot({0, 1}, {{4, 3}}).robot({1, 0}, {{3, 4}}));
  const TwoAgents::Path a = {5, 6, 7, 12, 17, 18, 19};
  const TwoAgents::Path b = {1, 6, 11, 12, 17, 22, 23};
  const ConflictCase c(pair, {a, b}, {0, 1, 6, nowhere, 1});
  const auto split = rectangle_of(c);
  REQUIRE(split);
  // The column x = 3 from y = 1 to 3, and the row y = 3 from x = 1 to 3.
  CHECK(split->constraints[0] ==
        std::vector<Constraint>{avoid_vertex(0, 8, 3), avoid_vertex(0, 13, 4), avoid_vertex(0, 18, 5)});
  CHECK(split->constraints[1] ==
        std::vector<Constraint>{avoid_vertex(1, 16, 3), avoid_vertex(1, 17, 4), avoid_vertex(1, 18, 5)});
  CHECK(split->raises_cost == std::array{true, true});
  Tally tally;
  check_split(c, *split, tally);
}

TEST_CASE("no rectangle where an agent waits, where both go the same way, or where one has two goals") {
  const PlanningCase open({"....", "....", "....", "...."});
  const auto split_of = [](const PlanningCase& grid, const TwoAgents::Path& a, const TwoAgents::Path& b, Conflict c) {
    return rectangle_of(ConflictCase(TwoAgents(grid), {a, b}, c));
  };
  const PlanningCase crossing = PlanningCase(open).robot({0, 1}, {{3, 2}}).robot({1, 0}, {{2, 3}});
  CHECK(split_of(crossing, {4, 5, 6, 7, 11}, {1, 5, 9, 13, 14}, {0, 1, 5, nowhere, 1}));
  CHECK_FALSE(split_of(crossing, {4, 5, 5, 6, 7, 11}, {1, 1, 5, 9, 13, 14}, {0, 1, 5, nowhere, 2}));
  const PlanningCase tour = PlanningCase(open).robot({0, 1}, {{1, 1}, {3, 2}}).robot({1, 0}, {{2, 3}});
  CHECK_FALSE(split_of(tour, {4, 5, 6, 7, 11}, {1, 5, 9, 13, 14}, {0, 1, 5, nowhere, 1}));
  const PlanningCase opposite = PlanningCase(open).robot({0, 1}, {{2, 1}}).robot({3, 1}, {{1, 1}});
  CHECK_FALSE(split_of(opposite, {4, 5, 6}, {7, 6, 5}, {0, 1, 6, 5, 2}));
}

TEST_CASE("a corridor split loses no pair of paths without conflict and reports raised costs") {
  const CorridorTally plain = draw_corridors(11, 2500, false, 0);
  const CorridorTally constrained = draw_corridors(12, 2500, true, 0);
  const CorridorTally longer = draw_corridors(13, 4000, true, 4);
  for (const CorridorTally& tally : {plain, constrained, longer}) {
    CHECK(tally.edges.splits > 20);
    CHECK(tally.chains.splits > 80);
    CHECK(tally.chains.raising[1] > 5);
    CHECK(tally.chains.raising[2] > 60);
    CHECK(tally.ends_inside.splits > 80);
  }
}

// A corridor of five steps from (1, 1) to (6, 1), which is 5 to 10.
PlanningCase narrow_grid() {
  return PlanningCase({"..####..", "........", "..####.."});
}

ConflictCase conflict_case(const PlanningCase& grid, const TwoAgents::Path& a, const TwoAgents::Path& b) {
  return ConflictCase(TwoAgents(grid), {a, b}, TwoAgents::conflicts(a, b).at(0));
}

void check_corridor(const ConflictCase& c, const Constraint& of_a, const Constraint& of_b,
                    std::array<bool, 2> raises_cost) {
  const auto split = corridor_of(c);
  REQUIRE(split);
  CHECK(split->constraints[0] == std::vector<Constraint>{of_a});
  CHECK(split->constraints[1] == std::vector<Constraint>{of_b});
  CHECK(split->raises_cost == raises_cost);
}

TEST_CASE("two agents that meet in a corridor are split by the times at which each can leave it") {
  const TwoAgents::Path east = {4, 5, 6, 7, 8, 9, 10, 11};
  const TwoAgents::Path west = {11, 10, 9, 8, 7, 6, 5, 4};
  const ConflictCase c = conflict_case(narrow_grid().robot({0, 1}, {{7, 1}}).robot({7, 1}, {{0, 1}}), east, west);
  // Each can be at its exit at 6. Then the other one enters at 7 and leaves at 12.
  check_corridor(c, avoid_vertex_range(0, 10, 0, 12), avoid_vertex_range(1, 5, 0, 12), {true, true});
}

TEST_CASE("two agents that meet in a corridor are split by the times of the other way") {
  // The corridor is the row y = 2. The other way, row y = 0, is four steps longer.
  PlanningCase grid({"........", "..####..", "........", "..####.."});
  grid.robot({0, 2}, {{7, 2}}).robot({7, 2}, {{0, 2}});
  const ConflictCase c = conflict_case(grid, {12, 13, 14, 15, 16, 17, 18, 19}, {19, 18, 17, 16, 15, 14, 13, 12});
  check_corridor(c, avoid_vertex_range(0, 18, 0, 10), avoid_vertex_range(1, 13, 0, 10), {true, true});
}

TEST_CASE("an agent whose goal is in a corridor comes after the other or leaves for it") {
  const ConflictCase c = conflict_case(narrow_grid().robot({0, 1}, {{7, 1}}).robot({7, 1}, {{2, 1}}),
                                       {4, 5, 6, 7, 8, 9, 10, 11}, {11, 10, 9, 8, 7, 6});
  // b can leave at 6, give way for two steps and return in one. There is no other way for a.
  check_corridor(c, avoid_vertex_range(0, 10, 0, 6 + 64), finish_after(1, 6, 8), {true, true});
}

TEST_CASE("an agent that waits inside a corridor meets the other in the part that it passes") {
  // b must not be at its exit 5 before 12, and waits at 7.
  const TwoAgents::Path west = {11, 10, 9, 8, 7, 7, 7, 7, 7, 7, 7, 6, 5, 4};
  ConflictCase c =
      conflict_case(narrow_grid().robot({0, 1}, {{7, 1}}).robot({7, 1}, {{0, 1}}), {4, 5, 6, 7, 8, 9, 10, 11}, west);
  c.pair.constraints[1] = {avoid_vertex_range(1, 5, 0, 12)};
  c.least[1] = 13;
  // The three steps from 7 to 10: a can leave at 6, b at 4. b can also be at 7 at 10.
  check_corridor(c, avoid_vertex_range(0, 10, 0, 8), avoid_vertex_range(1, 7, 0, 10), {true, false});
}

TEST_CASE("two agents that swap on open ground are split as in a corridor of one step") {
  const PlanningCase grid = PlanningCase({"....", "...."}).robot({0, 0}, {{3, 0}}).robot({3, 0}, {{0, 0}});
  const ConflictCase c = conflict_case(grid, {0, 1, 2, 3}, {3, 2, 1, 0});
  // The other row takes two more steps, and so does the way behind the other agent.
  check_corridor(c, avoid_vertex_range(0, 2, 0, 4), avoid_vertex_range(1, 1, 0, 4), {true, true});
}

TEST_CASE("no corridor split for agents that have passed each other, go the same way, or move on one-way edges") {
  const auto passage = [](const PlanningCase& grid, const TwoAgents::Path& a, const TwoAgents::Path& b) {
    const ConflictCase c = conflict_case(grid, a, b);
    return find_passage(Corridors(c.pair.problem.graph), *c.conflict, a, b);
  };
  const PlanningCase meeting = narrow_grid().robot({2, 1}, {{7, 1}}).robot({3, 1}, {{0, 1}});
  CHECK(passage(meeting, {6, 7, 8, 9, 10, 11}, {7, 6, 5, 4})->ways[0].length == 5);
  // They have passed each other in the corridor and swap twice on one edge.
  const PlanningCase passed = narrow_grid().robot({3, 1}, {{7, 1}}).robot({2, 1}, {{0, 1}});
  const auto edge = passage(passed, {7, 6, 7, 8, 9, 10, 11}, {6, 7, 6, 5, 4});
  REQUIRE(edge);
  CHECK(edge->ways[0].length == 1);
  CHECK(edge->ways[0].exit == 6);
  const PlanningCase following = narrow_grid().robot({1, 1}, {{7, 1}}).robot({0, 1}, {{6, 1}});
  CHECK_FALSE(passage(following, {5, 6, 6, 7, 8, 9, 10, 11}, {4, 5, 6, 7, 8, 9, 10}));
  const PlanningCase one_way = PlanningCase(meeting).close_one_way({1, 0}, {0, 0});
  CHECK_FALSE(passage(one_way, {6, 7, 8, 9, 10, 11}, {7, 6, 5, 4}));
}

TEST_CASE("the earliest arrival is that of exhaustive search") {
  Random random(21);
  int late = 0;
  for (int i = 0; i < 1500; ++i) {
    ConflictCase c(random, draw_grid(random, Traffic::any, 2 + random.below(8)), true, 0);
    const GridGraph& graph = c.pair.problem.graph;
    if (!c.pair.least_cost(0)) continue;
    const Location to = random.below(graph.location_count());
    if (!graph.is_open(to)) continue;
    const Location not_from = random.one_in(2) ? graph.neighbor(to, random.below(4)) : nowhere;
    const int latest = random.below(16);
    const std::optional<int> expected = c.pair.earliest_arrival(0, to, not_from, latest);
    const TourTable table = c.tour_table(0);
    const ConstraintTable constraints = c.constraint_table(0);
    if (table.distance(0, to) == TourTable::unreachable) continue;
    EarliestArrival search(graph);
    const auto found = search.search({c.pair.agent(0), table, constraints, to, not_from, latest});
    CAPTURE(i);
    REQUIRE(found);
    // A landmark that cannot be reached without the move counts as reached.
    if (not_from == nowhere || constraints.landmarks().empty()) REQUIRE(*found == expected.value_or(latest + 1));
    REQUIRE(*found <= expected.value_or(latest + 1));
    late += expected && *expected > *c.pair.earliest_arrival(0, to, nowhere, latest);
  }
  CHECK(late > 20);
}

}  // namespace symmetry_test
