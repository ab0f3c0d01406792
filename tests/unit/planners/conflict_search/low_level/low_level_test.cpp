// SPDX-License-Identifier: MIT
// The two low levels of conflict-based search, against dynamic programming over time.
#include <catch2/catch.hpp>

#include "planners/conflict_search/low_level/safe_interval_search.hpp"
#include "planners/conflict_search/low_level/space_time_search.hpp"
#include "tests/unit/planners/conflict_search/low_level/low_level_case.hpp"

namespace low_level_test {

using namespace dmrp::test;
using namespace dmrp::planners;

template <class Search>
constexpr Counting counting_of = Counting::by_step;
template <>
constexpr Counting counting_of<SafeIntervalSearch> = Counting::by_interval;

// Each case has a graph and a search of its own, which plans twice.
template <class Search>
class Planning {
 public:
  explicit Planning(const LowLevelCase& c)
      : case_(c),
        tables_(make_tour_tables(c.problem, never())),
        constraints_(c.problem.graph),
        others_(c.problem.graph, c.others.size() + 1),
        search_(c.problem.graph) {
    constraints_.fill(c.agent(),
                      std::vector<Constraint>{avoid_vertex(0, 0, 30), finish_by(0, 0, 0)});  // must leave no trace
    constraints_.fill(c.agent(), c.constraints);
    for (std::size_t i = 0; i < c.others.size(); ++i) others_.set(static_cast<std::int32_t>(i), c.others[i]);
  }

  LowLevelResult run(double suboptimality, std::int32_t conflict_steps, std::int32_t lower_bound,
                     StopSignal& stop = never()) {
    LowLevelRequest request{case_.agent(), tables_->at(0), constraints_, others_};
    request.suboptimality = suboptimality;
    request.conflict_steps = conflict_steps;
    request.lower_bound = lower_bound;
    return search_.search(request, stop, path);
  }
  std::int64_t expanded() const { return search_.expanded(); }

  LowLevelPath path;

 private:
  const LowLevelCase& case_;
  std::optional<std::vector<TourTable>> tables_;
  ConstraintTable constraints_;
  ConflictTable others_;
  Search search_;
};

// Checks that the path obeys the constraints, makes the tour and has the reported conflicts.
void check_path(const LowLevelCase& c, Counting counting, const LowLevelPath& path) {
  const PathView locations = path.locations;
  REQUIRE(locations.front() == c.agent().start);
  REQUIRE(c.may_be(locations.front(), 0));
  int leg = 0;
  for (int t = 1; t < static_cast<int>(locations.size()); ++t) {
    const Location from = LowLevelCase::place(locations, t - 1);
    const std::vector<Location> reach = c.reach(from);
    REQUIRE(std::count(reach.begin(), reach.end(), LowLevelCase::place(locations, t)) == 1);
    REQUIRE(c.may_arrive(from, LowLevelCase::place(locations, t), t));
    leg = c.agent().leg_after(leg, from);
  }
  REQUIRE(leg == c.agent().last_leg());
  REQUIRE(locations.back() == c.agent().last_goal());
  REQUIRE(c.may_rest(cost_of(locations)));
  for (const Constraint& constraint : c.constraints) REQUIRE(satisfies(locations, constraint));
  REQUIRE(path.conflicts == c.conflicts_of(counting, locations));
}

// The fewest conflicts over all costs within the bound.
int least_weighed(const std::map<int, int>& conflicts_by_cost, int most, int conflict_steps) {
  int best = 1'000'000;
  for (const auto& [cost, conflicts] : conflicts_by_cost)
    if (cost <= most) best = std::min(best, conflict_steps > 0 ? conflicts * conflict_steps + cost : conflicts);
  return best;
}

TEMPLATE_TEST_CASE("a low level finds a path of least cost, and of these one with fewest conflicts", "",
                   SafeIntervalSearch, SpaceTimeSearch) {
  const Counting counting = counting_of<TestType>;
  int with_path = 0;
  int with_conflicts = 0;
  int late = 0;
  for (uint64_t seed = 0; seed < 6000; ++seed) {
    CAPTURE(seed);
    const LowLevelCase c(seed);
    const std::map<int, int> conflicts_by_cost = c.fewest_conflicts_by_cost(counting);
    Planning<TestType> planning(c);
    const LowLevelResult result = planning.run(1, 0, 0);
    REQUIRE(result == (conflicts_by_cost.empty() ? LowLevelResult::none : LowLevelResult::found));
    if (conflicts_by_cost.empty()) continue;
    const auto [cost, conflicts] = *conflicts_by_cost.begin();
    for (const int known : {0, cost}) {  // a known bound, or none
      REQUIRE(planning.run(1, 0, known) == LowLevelResult::found);
      check_path(c, counting, planning.path);
      REQUIRE(cost_of(planning.path.locations) == cost);
      REQUIRE(planning.path.lower_bound == cost);
      REQUIRE(planning.path.conflicts == conflicts);
    }
    ++with_path;
    with_conflicts += conflicts > 0 ? 1 : 0;
    late += cost > 6 ? 1 : 0;
  }
  // The random cases must contain enough of each kind.
  CHECK(with_path > 3000);
  CHECK(with_path < 5900);
  CHECK(with_conflicts > 500);
  CHECK(late > 500);
}

TEMPLATE_TEST_CASE("a low level stays within its bound, and there has the fewest conflicts", "", SafeIntervalSearch,
                   SpaceTimeSearch) {
  const Counting counting = counting_of<TestType>;
  int longer = 0;
  int weighed = 0;
  for (uint64_t seed = 0; seed < 3000; ++seed) {
    CAPTURE(seed);
    const LowLevelCase c(seed);
    const std::map<int, int> conflicts_by_cost = c.fewest_conflicts_by_cost(counting);
    if (conflicts_by_cost.empty()) continue;
    const int least = conflicts_by_cost.begin()->first;
    Planning<TestType> planning(c);
    for (const double suboptimality : {1.0, 1.3, 2.0, 3.0})
      for (const int conflict_steps : {0, 1, 3}) {
        const int known = static_cast<int>(seed % 2) * least;  // a known bound
        CAPTURE(suboptimality, conflict_steps, known);
        REQUIRE(planning.run(suboptimality, conflict_steps, known) == LowLevelResult::found);
        const LowLevelPath& path = planning.path;
        const int cost = cost_of(path.locations);
        check_path(c, counting, path);
        REQUIRE(path.lower_bound >= known);
        REQUIRE(path.lower_bound <= least);
        REQUIRE(cost <= suboptimality * path.lower_bound + 1e-9);
        const int most = static_cast<int>(suboptimality * path.lower_bound + 1e-9);
        const int has = conflict_steps > 0 ? path.conflicts * conflict_steps + cost : path.conflicts;
        // Over single steps, times are not distinguished once all others rest: the search keeps the earlier arrival.
        if (suboptimality > 1 && counting == Counting::by_step)
          REQUIRE(has >= least_weighed(conflicts_by_cost, most, conflict_steps));
        else
          REQUIRE(has == least_weighed(conflicts_by_cost, most, conflict_steps));
        longer += cost > least ? 1 : 0;
        weighed += has < least_weighed(conflicts_by_cost, least, conflict_steps) ? 1 : 0;
      }
  }
  CHECK(longer > 1000);
  CHECK(weighed > 1000);
}

TEMPLATE_TEST_CASE("a low level ends when it is stopped", "", SafeIntervalSearch, SpaceTimeSearch) {
  const LowLevelCase c(1);
  Planning<TestType> planning(c);
  StopSignal stop([] { return true; });
  stop.poll_now();
  CHECK(planning.run(1, 0, 0, stop) == LowLevelResult::stopped);
}

TEST_CASE("over safe intervals a long wait costs nothing to find") {
  // The corridor beside the robot's start is closed for a long time.
  PlanningCase grid({"....."});
  grid.robot({0, 0}, {{4, 0}});
  const Problem problem = problem_of(grid);
  const auto tables = make_tour_tables(problem, never());
  ConstraintTable constraints(problem.graph);
  constraints.fill(problem.agents[0], std::vector<Constraint>{avoid_vertex_range(0, 2, 0, 5000)});
  const ConflictTable nobody(problem.graph, 1);
  SafeIntervalSearch search(problem.graph);
  LowLevelPath path;
  REQUIRE(search.search({problem.agents[0], tables->at(0), constraints, nobody}, never(), path) ==
          LowLevelResult::found);
  CHECK(cost_of(path.locations) == 5002);
  CHECK(path.locations[4999] == 1);
  CHECK(path.locations[5000] == 2);
  CHECK(search.expanded() < 20);
}

}  // namespace low_level_test
