// SPDX-License-Identifier: MIT
// The low level of ECBS-8 against dynamic programming over time.
#include "planners/ecbs8/focal_search.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "tests/unit/planners/mapf/problem_case.hpp"
#include "tests/unit/planners/planning_case.hpp"
#include "tests/unit/planners/random.hpp"

namespace focal_search_test {

using namespace dmrp::test;
using namespace dmrp::planners;
using ecbs8::Constraint;

// One robot under random constraints of all kinds, among two others that walk at random.
struct LowLevelCase {
  PlanningCase grid;
  std::vector<CellXY> goals;
  std::vector<std::vector<Location>> others;
  std::vector<Constraint> constraints;

  explicit LowLevelCase(uint64_t seed) : LowLevelCase(Random(seed)) {}
  explicit LowLevelCase(Random random) : grid(random.one_in(2) ? open_rows() : narrow_rows()) {
    for (int n = random.one_in(3) ? 2 : 1; n > 0; --n) goals.push_back({random.below(4), 2});
    grid.robot({random.below(4), 0}, goals);
    walk_others(random);
    for (int n = random.below(7); n > 0; --n) add_constraint(random);
  }
  static std::vector<std::string> open_rows() { return {"....", "....", "...."}; }
  static std::vector<std::string> narrow_rows() { return {"....", ".##.", "...."}; }

  // Locations are the free cells in row-major order.
  CellXY cell(Location location) const {
    CellXY at{-1, 0};
    for (Location next = 0; next <= location; next += grid.is_free(at) ? 1 : 0)
      at = at.x + 1 < grid.width ? CellXY{at.x + 1, at.y} : CellXY{0, at.y + 1};
    return at;
  }
  Location location(CellXY c) const {
    Location free_before = 0;
    for (std::size_t i = 0; i < grid.index(c); ++i) free_before += grid.free[i];
    return grid.is_free(c) ? free_before : nowhere;
  }
  CellXY draw_free(Random& random) const {
    for (;;)
      if (const CellXY at{random.below(grid.width), random.below(grid.height)}; grid.is_free(at)) return at;
  }

  void walk_others(Random& random) {
    while (others.size() < 2) {
      std::vector<Location> walk = {location(draw_free(random))};
      for (int steps = random.below(9); steps > 0; --steps) {
        const CellXY from = cell(walk.back());
        const CellXY to{from.x + random.below(3) - 1, from.y + random.below(3) - 1};
        walk.push_back(grid.is_open(from, to) ? location(to) : walk.back());
      }
      while (walk.size() > 1 && walk.back() == walk[walk.size() - 2]) walk.pop_back();
      if (walk.back() != location(goals.back()) && (others.empty() || others[0].back() != walk.back()))
        others.push_back(walk);
    }
  }
  void add_constraint(Random& random) {
    const CellXY place = draw_free(random);
    const Location where = location(place);
    const int t = random.below(8);
    const int until = random.one_in(3) ? t + random.below(4) : t;
    switch (random.below(6)) {
      case 0:
        return constraints.push_back({Constraint::Use::at, where, nowhere, t, until});
      case 1:
        return constraints.push_back({Constraint::Use::touch, where, nowhere, t, until});
      case 2:
        return constraints.push_back({Constraint::Use::touch, where, nowhere, t, dmrp::planners::forever});
      case 3: {
        const CellXY beside = random.one_in(2) ? CellXY{place.x + 1, place.y} : CellXY{place.x, place.y + 1};
        const Location other = grid.is_free(beside) ? location(beside) : nowhere;
        return constraints.push_back({Constraint::Use::edge, where, other, t, until});
      }
      case 4:
        return constraints.push_back({Constraint::Use::corner, where, nowhere, t, until});
      default:
        return constraints.push_back({Constraint::Use::end, nowhere, nowhere, 0, t});
    }
  }

  static bool covers(const Constraint& c, int t, int later = 0) { return c.from <= t && t <= c.until + later; }
  bool allows_being(Location at, int t) const {
    for (const Constraint& c : constraints)
      if ((c.use == Constraint::Use::at || c.use == Constraint::Use::touch) && c.location == at && covers(c, t))
        return false;
    return true;
  }
  bool allows(CellXY from, CellXY to, int t) const {
    if (!allows_being(location(to), t)) return false;
    const bool is_diagonal = from.x != to.x && from.y != to.y;
    const Location low = location({std::min(from.x, to.x), std::min(from.y, to.y)});
    const Location high = location({std::max(from.x, to.x), std::max(from.y, to.y)});
    for (const Constraint& c : constraints) {
      const bool is_beside = c.location == location({from.x, to.y}) || c.location == location({to.x, from.y});
      if (is_diagonal && c.use == Constraint::Use::touch && is_beside && covers(c, t, 1)) return false;
      if (is_diagonal && c.use == Constraint::Use::corner && c.location == low && covers(c, t)) return false;
      if (!is_diagonal && !(from == to) && c.use == Constraint::Use::edge && c.location == low && c.other == high &&
          covers(c, t))
        return false;
    }
    return true;
  }
  bool may_rest(int t) const {
    for (const Constraint& c : constraints) {
      if (c.use == Constraint::Use::end && t <= c.until) return false;
      if ((c.use == Constraint::Use::at || c.use == Constraint::Use::touch) && c.location == location(goals.back()) &&
          t <= c.until)
        return false;
    }
    return true;
  }
};

// The least cost of a path under the constraints, by dynamic programming over 60 steps.
std::optional<double> least_cost(const LowLevelCase& c) {
  const CellXY start = c.grid.robots[0].start;
  const auto last_leg = c.goals.size() - 1;
  if (!c.allows_being(c.location(start), 0)) return std::nullopt;
  // by place, leg and whether the last step was an arrival, as a path must end with one
  std::map<std::tuple<Location, std::size_t, bool>, double> reached = {{{c.location(start), 0, true}, 0.0}};
  std::optional<double> best;
  for (int t = 0; t < 60; ++t) {
    std::map<std::tuple<Location, std::size_t, bool>, double> next;
    for (const auto& [state, cost] : reached) {
      const auto [location, leg, arrived] = state;
      const CellXY from = c.cell(location);
      if (arrived && leg == last_leg && from == c.goals.back() && c.may_rest(t))
        best = std::min(best.value_or(cost), cost);
      const std::size_t next_leg = leg < last_leg && from == c.goals[leg] ? leg + 1 : leg;
      for (int dx = -1; dx <= 1; ++dx)
        for (int dy = -1; dy <= 1; ++dy) {
          const CellXY to{from.x + dx, from.y + dy};
          const bool waits = dx == 0 && dy == 0;
          if (!c.grid.is_free(to) || (!waits && !c.grid.is_open(from, to)) || !c.allows(from, to, t + 1)) continue;
          const double after = cost + (dx != 0 && dy != 0 ? std::sqrt(2.0) : 1.0);
          const auto [at, is_new] =
              next.emplace(std::tuple{c.location(to), next_leg, !waits || next_leg != leg}, after);
          if (!is_new) at->second = std::min(at->second, after);
        }
    }
    reached = std::move(next);
  }
  return best;
}

TEST_CASE("focal search finds a path within its bound of the least cost, if there is one") {
  int found = 0;
  int none = 0;
  for (uint64_t seed = 0; seed < 4000; ++seed) {
    const LowLevelCase c(seed);
    const CProblem host(c.grid);
    const ecbs8::Problem problem = make_problem<8>(dmrp::PlanningProblem(host.problem()), true);
    const ecbs8::TourDistances distances(problem.graph, problem.agents[0], never());
    ecbs8::ConstraintTable constraints(problem.graph);
    constraints.fill({{Constraint::Use::at, 0, nowhere, 0, 30}});  // replaced by the next fill()
    constraints.fill(c.constraints);
    ecbs8::Occupancy others(problem.graph, 3);
    others.set(1, c.others[1]);
    others.set(1, {});  // leaves no trace
    for (int i = 0; i < 2; ++i) others.set(i + 1, c.others[static_cast<std::size_t>(i)]);
    const std::optional<double> least = least_cost(c);
    (least ? found : none) += 1;
    ecbs8::FocalSearch search(problem.graph);
    for (const double suboptimality : {1.0, 1.5, 4.0}) {
      CAPTURE(seed, suboptimality);
      ecbs8::BoundedPath path;
      const auto result = search.search(problem.agents[0], distances, constraints, others, 0,
                                        ecbs8::Suboptimality(suboptimality), never(), path);
      REQUIRE((result == ecbs8::FocalSearch::Result::found) == least.has_value());
      if (!least) continue;
      const double cost = ecbs8::as_number(path.cost);
      const double lower_bound = ecbs8::as_number(path.lower_bound);
      REQUIRE(lower_bound <= *least + 1e-6);
      REQUIRE(cost >= *least - 1e-6);
      REQUIRE(cost <= suboptimality * lower_bound);
      double walked = 0;
      for (std::size_t t = 1; t < path.locations.size(); ++t) {
        const CellXY from = c.cell(path.locations[t - 1]);
        const CellXY to = c.cell(path.locations[t]);
        REQUIRE((from == to || c.grid.is_open(from, to)));
        REQUIRE(c.allows(from, to, static_cast<int>(t)));
        walked += from.x != to.x && from.y != to.y ? std::sqrt(2.0) : 1.0;
      }
      REQUIRE(walked == Approx(cost));
      REQUIRE(c.cell(path.locations.back()) == c.goals.back());
      REQUIRE(c.may_rest(static_cast<int>(path.locations.size()) - 1));
    }
  }
  CHECK(found > 2000);
  CHECK(none > 200);
}

}  // namespace focal_search_test
