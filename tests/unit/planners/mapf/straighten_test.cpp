// SPDX-License-Identifier: MIT
// straighten(), against trying all paths.
#include "planners/mapf/straighten.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <optional>

#include "tests/unit/planners/mapf/problem_case.hpp"
#include "tests/unit/planners/random.hpp"

namespace straighten_test {

using namespace dmrp::test;
using namespace dmrp::planners;

using Paths = std::vector<std::vector<Location>>;
constexpr int64_t no_limit = int64_t{1} << 40;

Location where(const std::vector<Location>& path, std::size_t t) {
  return path[std::min(t, path.size() - 1)];
}

bool have_conflict(const std::vector<Location>& a, const std::vector<Location>& b) {
  for (std::size_t t = 0; t < std::max(a.size(), b.size()); ++t) {
    if (where(a, t) == where(b, t)) return true;
    if (t > 0 && where(a, t) == where(b, t - 1) && where(a, t - 1) == where(b, t)) return true;
  }
  return false;
}

// A grid and robots that walk on it at random without conflicts. Their walks become their tours.
struct Walks {
  PlanningCase grid;
  Problem problem;
  Paths paths;

  Walks(Random& random, int width, int height, int robots, int steps)
      : grid(draw_grid(random, width, height)), problem(problem_of(grid)) {
    while (static_cast<int>(paths.size()) < robots) {
      const Location start = random.below(width * height);
      const auto starts_there = [&](const auto& path) { return path[0] == start; };
      if (problem.graph.is_open(start) && std::none_of(paths.begin(), paths.end(), starts_there))
        paths.push_back({start});
    }
    for (int t = 1; t <= steps; ++t)
      for (std::size_t i = 0; i < paths.size(); ++i) take_step(random, i, t);
    for (auto& path : paths) {
      while (path.size() > 1 && path.back() == path[path.size() - 2]) path.pop_back();
      problem.agents.push_back(tour_along(random, path));
    }
  }

  static PlanningCase draw_grid(Random& random, int width, int height) {
    PlanningCase c(
        std::vector<std::string>(static_cast<std::size_t>(height), std::string(static_cast<std::size_t>(width), '.')));
    for (int x = 0; x + 1 < width; ++x)
      for (int y = 0; y + 1 < height; ++y) {
        if (random.one_in(8)) c.thin_wall({x, y}, {x + 1, y});
        if (random.one_in(8)) c.thin_wall({x, y}, {x, y + 1});
        if (random.one_in(20)) c.close_one_way({x, y}, {x, y + 1});
      }
    return c;
  }
  // Robots before i have already taken theirs.
  void take_step(Random& random, std::size_t i, int t) {
    std::vector<Location>& path = paths[i];
    const auto now = static_cast<std::size_t>(t);
    const auto is_free = [&](Location to) {
      for (std::size_t other = 0; other < paths.size(); ++other) {
        const Location other_now = where(paths[other], now);
        if (other != i && (other_now == to || (other_now == path.back() && where(paths[other], now - 1) == to)))
          return false;
      }
      return true;
    };
    Location to = random.one_in(4) ? path.back() : problem.graph.neighbor(path.back(), random.below(4));
    for (int tries = 0; to == nowhere || !is_free(to); ++tries) {
      to = tries > 20 ? path.back() : problem.graph.neighbor(path.back(), random.below(4));
      if (tries > 20) break;
    }
    path.push_back(to);
  }

  static Agent tour_along(Random& random, const std::vector<Location>& path) {
    Agent agent;
    agent.start = path[0];
    if (path.size() > 3 && random.one_in(3)) {
      const int first = random.below(static_cast<int>(path.size()) - 2);
      agent.goals.push_back(path[static_cast<std::size_t>(first)]);
      if (random.one_in(3)) agent.goals.push_back(path.end()[-2]);
    }
    agent.goals.push_back(path.back());
    return agent;
  }

  bool is_valid() const {
    for (std::size_t a = 0; a < paths.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (have_conflict(paths[a], paths[b])) return false;
    return true;
  }
  std::vector<std::size_t> lengths() const {
    std::vector<std::size_t> out;
    for (const auto& path : paths) out.push_back(path.size());
    return out;
  }
  int turns() const {
    int sum = 0;
    for (const auto& path : paths) sum += count_turns(problem.graph, path);
    return sum;
  }
};

// Whether a path makes the tour and does not reach its end before its last step.
bool makes_tour(const Agent& agent, const std::vector<Location>& path) {
  if (path[0] != agent.start || path.back() != agent.last_goal()) return false;
  std::int32_t leg = 0;
  std::int32_t leg_before = 0;
  for (std::size_t t = 1; t < path.size(); ++t) {
    leg_before = leg;
    leg = agent.leg_after(leg, path[t - 1]);
  }
  if (leg != agent.last_leg()) return false;
  const bool waits_at_end = path.size() > 1 && path.back() == path[path.size() - 2];
  return !waits_at_end || leg_before != leg;
}

// The fewest turns of robot i with the others' paths fixed, by trying all paths.
class AllPaths {
 public:
  AllPaths(const Walks& walks, std::size_t i) : walks_(walks), i_(i) {
    path_ = {walks.problem.agents[i].start};
    extend();
  }
  int fewest = 1000;

 private:
  void extend() {
    if (path_.size() == walks_.paths[i_].size()) {
      if (makes_tour(walks_.problem.agents[i_], path_))
        fewest = std::min(fewest, count_turns(walks_.problem.graph, path_));
      return;
    }
    for (int d = 0; d <= 4; ++d) {
      const Location to = d == 4 ? path_.back() : walks_.problem.graph.neighbor(path_.back(), d);
      if (to == nowhere) continue;
      path_.push_back(to);
      if (fits()) extend();
      path_.pop_back();
    }
  }
  bool fits() const {
    const std::size_t t = path_.size() - 1;
    const bool is_last = path_.size() == walks_.paths[i_].size();
    for (std::size_t other = 0; other < walks_.paths.size(); ++other) {
      const auto& path = walks_.paths[other];
      if (other == i_) continue;
      if (where(path, t) == path_[t] || (where(path, t) == path_[t - 1] && where(path, t - 1) == path_[t]))
        return false;
      for (std::size_t later = t; is_last && later < path.size(); ++later)
        if (path[later] == path_[t]) return false;
    }
    return true;
  }

  const Walks& walks_;
  std::size_t i_;
  std::vector<Location> path_;
};

std::int32_t straighten_all(Walks& walks, int64_t work_limit, bool stopped = false) {
  StopSignal stop([stopped] { return stopped; });
  if (stopped) stop.poll_now();
  StopSignal never([] { return false; });
  const auto tables = make_tour_tables(walks.problem, never);
  return straighten(walks.problem, *tables, walks.paths, work_limit, stop);
}

TEST_CASE("straightening leaves no robot a path with fewer turns among the others'") {
  int saved = 0;
  int tours = 0;
  for (uint64_t seed = 0; seed < 1500; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Walks walks(random, 3 + random.below(2), 3, 1 + random.below(3), 3 + random.below(5));
    REQUIRE(walks.is_valid());
    for (std::size_t i = 0; i < walks.paths.size(); ++i) REQUIRE(makes_tour(walks.problem.agents[i], walks.paths[i]));
    const auto lengths = walks.lengths();
    const int turns = walks.turns();
    const int reported = straighten_all(walks, no_limit);
    REQUIRE(walks.is_valid());
    REQUIRE(walks.lengths() == lengths);
    REQUIRE(walks.turns() == turns - reported);
    saved += reported;
    for (std::size_t i = 0; i < walks.paths.size(); ++i) {
      CAPTURE(i);
      REQUIRE(makes_tour(walks.problem.agents[i], walks.paths[i]));
      REQUIRE(AllPaths(walks, i).fewest == count_turns(walks.problem.graph, walks.paths[i]));
      tours += walks.problem.agents[i].goals.size() > 1 ? 1 : 0;
    }
  }
  CHECK(saved > 1000);
  CHECK(tours > 300);
}

TEST_CASE("straightening robots that ignore each other") {
  int saved = 0;
  for (uint64_t seed = 0; seed < 300; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Walks walks(random, 4, 3, 2, 3 + random.below(5));
    const int turns = walks.turns();
    StopSignal never([] { return false; });
    straighten_alone(walks.problem, *make_tour_tables(walks.problem, never), walks.paths, never);
    saved += turns - walks.turns();
    for (std::size_t i = 0; i < walks.paths.size(); ++i) {
      Walks alone = walks;
      alone.paths = {walks.paths[i]};
      alone.problem.agents = {walks.problem.agents[i]};
      REQUIRE(makes_tour(alone.problem.agents[0], alone.paths[0]));
      REQUIRE(AllPaths(alone, 0).fewest == count_turns(walks.problem.graph, walks.paths[i]));
    }
  }
  CHECK(saved > 200);
}

TEST_CASE("straightening large plans keeps costs, tours and freedom from conflicts") {
  for (uint64_t seed = 0; seed < 30; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Walks walks(random, 20, 15, 40, 40);
    REQUIRE(walks.is_valid());
    const auto lengths = walks.lengths();
    const int turns = walks.turns();
    const int64_t limit = seed % 3 == 0 ? 3000 : 300'000;
    const int saved = straighten_all(walks, limit);
    CHECK(saved > 0);
    REQUIRE(walks.turns() == turns - saved);
    REQUIRE(walks.is_valid());
    REQUIRE(walks.lengths() == lengths);
    for (std::size_t i = 0; i < walks.paths.size(); ++i) REQUIRE(makes_tour(walks.problem.agents[i], walks.paths[i]));
  }
}

TEST_CASE("straightening does nothing without a work limit or when it is stopped") {
  Random random(7);
  Walks walks(random, 10, 10, 8, 30);
  const Paths paths = walks.paths;
  CHECK(straighten_all(walks, 0) == 0);
  CHECK(walks.paths == paths);
  CHECK(straighten_all(walks, no_limit, true) == 0);
  CHECK(walks.paths == paths);
  CHECK(straighten_all(walks, no_limit) > 0);
}

TEST_CASE("straightening a staircase") {
  const PlanningCase grid(std::vector<std::string>(4, "...."));
  StopSignal never([] { return false; });
  Problem problem = problem_of(grid);
  problem.agents = {{0, 0, {15}, 0}};
  Paths paths = {{0, 1, 5, 6, 10, 11, 15}};
  SECTION("alone") {
    CHECK(straighten(problem, *make_tour_tables(problem, never), paths, no_limit, never) == 4);
    CHECK(count_turns(problem.graph, paths[0]) == 1);
  }
  SECTION("between two robots that rest in the corners") {
    problem.agents.push_back({1, 3, {3}, 0});
    problem.agents.push_back({2, 12, {12}, 0});
    paths.push_back({3});
    paths.push_back({12});
    CHECK(straighten(problem, *make_tour_tables(problem, never), paths, no_limit, never) == 3);
    CHECK(count_turns(problem.graph, paths[0]) == 2);
  }
  SECTION("with a goal on its way") {
    problem.agents[0].goals = {10, 15};
    CHECK(straighten(problem, *make_tour_tables(problem, never), paths, no_limit, never) == 3);
    CHECK(makes_tour(problem.agents[0], paths[0]));
  }
}

}  // namespace straighten_test
