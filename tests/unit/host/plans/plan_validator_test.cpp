// SPDX-License-Identifier: MIT
// Every breach of a planner's contract and every kind of conflict, on a grid of 6 x 4 cells of 1 m.
#include "host/plans/plan_validator.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "host/plans/planning.hpp"

namespace plan_validator_test {

using namespace dmrp::host;

constexpr std::int64_t step_ns = 1'800'000'000;
constexpr std::int64_t from_ns = 500'000'000;
constexpr std::uint32_t width = 6;
constexpr std::uint32_t height = 4;

struct Cell {
  int column;
  int row;
};

dmrp_vec2 center(Cell cell) {
  return {10.0 + cell.column + 0.5, 20.0 + cell.row + 0.5};
}

dmrp_waypoint waypoint(dmrp_vec2 at, std::int64_t t_ns, std::uint32_t goal = 0) {
  dmrp_waypoint w{};
  w.x = at.x;
  w.y = at.y;
  w.theta = std::numeric_limits<double>::quiet_NaN();
  w.t_ns = t_ns;
  w.goal_index = goal;
  return w;
}

// One waypoint per step.
std::vector<dmrp_waypoint> path(const std::vector<Cell>& cells) {
  std::vector<dmrp_waypoint> out;
  for (const Cell& cell : cells)
    out.push_back(waypoint(center(cell), from_ns + static_cast<std::int64_t>(out.size()) * step_ns));
  return out;
}

// The planning problem of the paths: each from its first cell to its last.
class Case {
 public:
  explicit Case(PlannedPaths made) : paths(std::move(made)), free_(width * height, 1), edges_(width * height, 0xff) {
    for (int row = 0; row < static_cast<int>(height); ++row)
      for (int column = 0; column < static_cast<int>(width); ++column)
        for (int direction = 0; direction < 8; ++direction) {
          static constexpr int dx[] = {1, 1, 0, -1, -1, -1, 0, 1};
          static constexpr int dy[] = {0, 1, 1, 1, 0, -1, -1, -1};
          const int c = column + dx[direction];
          const int r = row + dy[direction];
          if (c < 0 || r < 0 || c >= static_cast<int>(width) || r >= static_cast<int>(height))
            close({column, row}, direction);
        }
    footprint_.struct_size = sizeof(footprint_);
    footprint_.radius_m = 0.25;
    robot_.footprint = &footprint_;
    for (const auto& made_path : paths) {
      const dmrp_waypoint& last = made_path.back();
      goals_.push_back({goal_at({last.x, last.y})});
      dmrp_planning_robot robot{};
      robot.state = DMRP_ROBOT_ACTIVE;
      robot.robot = &robot_;
      robot.start = {made_path.front().x, made_path.front().y};
      robots_.push_back(robot);
    }
  }

  static dmrp_goal goal_at(dmrp_vec2 at) {
    dmrp_goal goal{};
    goal.pose = {at.x, at.y, std::numeric_limits<double>::quiet_NaN()};
    return goal;
  }

  void close(Cell cell, int direction) {
    auto& edges = edges_[static_cast<std::size_t>(cell.row) * width + static_cast<std::size_t>(cell.column)];
    edges = static_cast<std::uint8_t>(edges & ~(1u << direction));
  }
  void block(Cell cell) {
    free_[static_cast<std::size_t>(cell.row) * width + static_cast<std::size_t>(cell.column)] = 0;
  }
  dmrp_planning_robot& robot(std::size_t i) { return robots_[i]; }
  void set_radius(double radius_m) { footprint_.radius_m = radius_m; }
  void set_goals(std::size_t i, const std::vector<Cell>& cells) {
    goals_[i].clear();
    for (const Cell& cell : cells) goals_[i].push_back(goal_at(center(cell)));
  }

  PlanVerdict verdict(std::uint32_t connectivity, const SweepIsFree& sweep_is_free = nullptr) {
    dmrp_grid grid{};
    grid.struct_size = sizeof(grid);
    grid.width = width;
    grid.height = height;
    grid.resolution_m = 1.0;
    grid.origin = {10.0, 20.0};
    grid.free = free_.data();
    grid.edges = edges_.data();
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      if (!robots_[i].grid) robots_[i].grid = &grid;
      robots_[i].goals = goals_[i].data();
      robots_[i].goal_count = static_cast<std::uint32_t>(goals_[i].size());
      robots_[i].goal_stride = sizeof(dmrp_goal);
    }
    dmrp_planning_problem problem{};
    problem.struct_size = sizeof(problem);
    problem.robot_count = static_cast<std::uint32_t>(robots_.size());
    problem.robots = robots_.data();
    problem.robot_stride = sizeof(dmrp_planning_robot);
    problem.effective_from_ns = from_ns;
    problem.step_duration_ns = step_ns;
    problem.grid = &grid;
    problem.window_steps = window_steps;
    return validate_plan(problem, paths, connectivity, sweep_is_free, partial);
  }

  PlannedPaths paths;
  std::vector<bool> partial;
  std::uint32_t window_steps = 0;

 private:
  std::vector<std::uint8_t> free_;
  std::vector<std::uint8_t> edges_;
  dmrp_footprint footprint_{};
  dmrp_robot robot_{};
  std::vector<std::vector<dmrp_goal>> goals_;
  std::vector<dmrp_planning_robot> robots_;
};

std::string error_of(Case& c, std::uint32_t connectivity = 4) {
  return c.verdict(connectivity).error;
}

// The pair in both orders: conflicts are symmetric.
PlanVerdict conflicts_of(const std::vector<Cell>& a, const std::vector<Cell>& b, std::uint32_t connectivity) {
  const PlanVerdict one = Case({path(a), path(b)}).verdict(connectivity);
  const PlanVerdict other = Case({path(b), path(a)}).verdict(connectivity);
  REQUIRE(one.error.empty());
  REQUIRE(other.error.empty());
  CHECK(one.conflicts == other.conflicts);
  CHECK(one.first_conflict == other.first_conflict);
  return one;
}

TEST_CASE("each robot's moves are judged on its own grid") {
  Case c({path({{0, 0}, {1, 0}}), path({{0, 2}, {1, 2}})});
  const std::vector<std::uint8_t> nothing_free(width * height, 0);
  dmrp_grid closed{};
  closed.struct_size = sizeof(closed);
  closed.width = width;
  closed.height = height;
  closed.resolution_m = 1.0;
  closed.origin = {10.0, 20.0};
  closed.free = nothing_free.data();
  closed.edges = nothing_free.data();
  c.robot(1).grid = &closed;
  CHECK(error_of(c) == "robot 1, waypoint 0 (10.5, 22.5) is not on a free cell");
}

TEST_CASE("a verdict tells the waypoint of the first mistake, or conflict") {
  Case jump({path({{0, 0}, {1, 0}}), path({{0, 2}, {1, 2}, {3, 2}})});
  PlanVerdict verdict = jump.verdict(8);
  CHECK((verdict.robot == 1 && verdict.waypoint == 2));
  Case meet({path({{5, 3}}), path({{0, 0}, {1, 0}, {2, 0}, {2, 0}}), path({{2, 2}, {2, 1}, {2, 0}})});
  verdict = meet.verdict(4);
  CHECK((verdict.robot == 1 && verdict.waypoint == 2));
  verdict = meet.verdict(DMRP_CONNECTIVITY_ANY, [](auto, auto, double) { return true; });
  CHECK((verdict.robot == 1 && verdict.waypoint == 2));
  Case late({path({{0, 0}, {1, 0}, {2, 0}, {3, 0}}), path({{3, 0}})});  // rests in the way
  verdict = late.verdict(4);
  CHECK((verdict.robot == 0 && verdict.waypoint == 3));
}

TEST_CASE("a good plan has no error and no conflict") {
  Case c({path({{0, 0}, {1, 0}, {1, 1}, {1, 1}, {2, 1}}), path({{0, 3}, {1, 3}}), path({{5, 0}})});
  const PlanVerdict verdict = c.verdict(4);
  CHECK(verdict.error.empty());
  CHECK(verdict.conflicts == 0);
  CHECK(verdict.first_conflict.empty());
}

TEST_CASE("a plan's structure") {
  Case c({path({{0, 0}, {1, 0}, {2, 0}})});
  auto& way = c.paths[0];
  SECTION("a path for every robot") {
    c.paths.push_back(way);
    CHECK(error_of(c) == "2 paths for 1 robots");
  }
  SECTION("at least one waypoint") {
    way.clear();
    CHECK(error_of(c) == "robot 0 has no waypoints");
  }
  SECTION("finite numbers") {
    way[1].x = std::numeric_limits<double>::quiet_NaN();
    CHECK(error_of(c) == "robot 0, waypoint 1 is not finite");
    way[1].x = 11.5;
    way[2].theta = std::numeric_limits<double>::infinity();
    CHECK(error_of(c) == "robot 0, waypoint 2 is not finite");
  }
  SECTION("time goes on") {
    way[2].t_ns = way[1].t_ns;
    CHECK(error_of(c) == "robot 0, waypoint 2: times do not grow");
  }
  SECTION("begins at the start") {
    c.robot(0).start = center({0, 1});
    CHECK(error_of(c) == "robot 0 begins at (10.5, 20.5), not at its start (10.5, 21.5)");
  }
  SECTION("begins when the plan takes effect") {
    for (dmrp_waypoint& w : way) w.t_ns += 1;
    CHECK(error_of(c) == "robot 0 begins at 500000001 ns, not when the plan takes effect (500000000 ns)");
  }
  SECTION("ends at the goal") {
    way.pop_back();
    CHECK(error_of(c) == "robot 0 ends at (11.5, 20.5), not at its goal (12.5, 20.5)");
  }
  SECTION("a robot that is not active stays") {
    c.robot(0).state = DMRP_ROBOT_FINISHED;
    CHECK(error_of(c) == "robot 0 is not active, but its path moves");
    way.resize(1);
    CHECK(error_of(c).empty());
  }
}

TEST_CASE("a tour visits its goals in order") {
  // to (2, 0), to (0, 0), to (1, 1)
  Case c({path({{0, 0}, {1, 0}, {2, 0}, {1, 0}, {0, 0}, {0, 1}, {1, 1}})});
  auto& way = c.paths[0];
  c.set_goals(0, {{2, 0}, {0, 0}, {1, 1}});
  const std::uint32_t toward[] = {0, 0, 0, 1, 1, 2, 2};
  for (std::size_t i = 0; i < way.size(); ++i) way[i].goal_index = toward[i];
  SECTION("in order") {
    CHECK(error_of(c).empty());
  }
  SECTION("a tour of which two goals are done already") {
    c.robot(0).first_goal_index = 2;
    for (dmrp_waypoint& w : way) w.goal_index += 2;
    CHECK(error_of(c).empty());
  }
  SECTION("a goal that it does not come to") {
    c.set_goals(0, {{2, 0}, {3, 3}, {1, 1}});
    CHECK(error_of(c) == "robot 0 does not visit its goal 1");
  }
  SECTION("in the wrong order") {
    c.set_goals(0, {{0, 0}, {2, 0}, {1, 1}});
    CHECK_FALSE(error_of(c).empty());
  }
  SECTION("goal indices that fall back") {
    way[5].goal_index = 0;
    CHECK(error_of(c) == "robot 0 goes back to goal 0");
  }
  SECTION("a goal index beyond the last") {
    way[6].goal_index = 3;
    CHECK(error_of(c) == "robot 0 heads for goal 3, which it does not have");
  }
}

TEST_CASE("moves on the grid") {
  SECTION("between the centres of cells") {
    Case c({path({{0, 0}, {1, 0}, {2, 0}})});
    c.paths[0][1].x += 0.01;
    CHECK(error_of(c) == "robot 0, waypoint 1 (11.51, 20.5) is not on a cell's centre");
  }
  SECTION("inside the grid") {
    Case c({path({{0, 0}, {-1, 0}, {0, 0}})});
    CHECK(error_of(c) == "robot 0, waypoint 1 (9.5, 20.5) is not on a cell's centre");
  }
  SECTION("on free cells") {
    Case c({path({{0, 0}, {1, 0}, {2, 0}})});
    c.block({1, 0});
    CHECK(error_of(c) == "robot 0, waypoint 1 (11.5, 20.5) is not on a free cell");
  }
  SECTION("one a step") {
    Case c({path({{0, 0}, {1, 0}, {2, 0}})});
    c.paths[0][2].t_ns += step_ns;
    CHECK(error_of(c) == "robot 0, waypoint 2: a move does not take one step");
  }
  SECTION("to a neighbour") {
    Case c({path({{0, 0}, {2, 0}})});
    CHECK(error_of(c, 4) == "robot 0, waypoint 1: the move is not one to a neighbour");
    CHECK(error_of(c, 8) == "robot 0, waypoint 1: the move is not one to a neighbour");
  }
  SECTION("diagonal only if that was declared") {
    Case c({path({{0, 0}, {1, 1}})});
    CHECK(error_of(c, 4) == "robot 0, waypoint 1: the move is not one to a neighbour");
    CHECK(error_of(c, 8).empty());
  }
  SECTION("not through a thin wall between two free cells") {
    static constexpr Cell around[] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
    for (int direction = 0; direction < 8; ++direction) {
      const Cell to{2 + around[direction].column, 2 + around[direction].row};
      Case c({path({{2, 2}, to})});
      CHECK(error_of(c, 8).empty());
      c.close({2, 2}, direction);
      CHECK(error_of(c, 8) == "robot 0, waypoint 1: the move to (" + std::to_string(10 + to.column) + ".5, " +
                                  std::to_string(20 + to.row) + ".5) is not open");
    }
  }
}

TEST_CASE("conflicts of 4-connected plans") {
  SECTION("vertex: on one cell at one time") {
    const PlanVerdict v = conflicts_of({{0, 0}, {1, 0}, {2, 0}}, {{1, 1}, {1, 0}, {1, 1}, {1, 2}}, 4);
    CHECK(v.conflicts == 1);
    CHECK(v.first_conflict == "vertex conflict of robots 0 and 1 at step 1");
  }
  SECTION("vertex: over a robot that rests at its goal") {
    const PlanVerdict v = conflicts_of({{1, 0}, {2, 0}}, {{2, 2}, {2, 2}, {2, 1}, {2, 0}, {3, 0}}, 4);
    CHECK(v.conflicts == 1);
    CHECK(v.first_conflict == "vertex conflict of robots 0 and 1 at step 3");
  }
  SECTION("vertex: a common start is told apart") {
    const PlanVerdict v = conflicts_of({{0, 0}, {1, 0}}, {{0, 0}, {0, 1}}, 4);
    CHECK(v.conflicts == 1);
    CHECK(v.first_conflict == "robots 0 and 1 share a start");
  }
  SECTION("swap: each on the other's cell") {
    const PlanVerdict v = conflicts_of({{1, 0}, {2, 0}}, {{2, 0}, {1, 0}}, 4);
    CHECK(v.conflicts == 1);
    CHECK(v.first_conflict == "swap conflict of robots 0 and 1 at step 1");
  }
  SECTION("following close behind is none") {
    CHECK(conflicts_of({{1, 0}, {2, 0}, {3, 0}}, {{0, 0}, {1, 0}, {2, 0}}, 4).conflicts == 0);
    CHECK(conflicts_of({{1, 0}, {2, 0}}, {{1, 1}, {1, 0}}, 4).conflicts == 0);
  }
  SECTION("a ring that turns is none") {
    Case c({path({{0, 0}, {1, 0}}), path({{1, 0}, {1, 1}}), path({{1, 1}, {0, 1}}), path({{0, 1}, {0, 0}})});
    CHECK(c.verdict(4).conflicts == 0);
  }
  SECTION("all pairs are counted") {
    Case c({path({{0, 0}, {1, 0}}), path({{1, 0}, {0, 0}}), path({{2, 2}, {1, 2}}), path({{0, 2}, {1, 2}})});
    CHECK(c.verdict(4).conflicts == 2);
  }
}

TEST_CASE("conflicts of 8-connected plans") {
  SECTION("diagonals that cross") {
    const PlanVerdict v = conflicts_of({{1, 1}, {2, 2}}, {{2, 1}, {1, 2}}, 8);
    CHECK(v.conflicts == 1);
    CHECK(v.first_conflict == "crossing conflict of robots 0 and 1 at step 1");
  }
  SECTION("past a robot that stands beside the diagonal") {
    CHECK(conflicts_of({{1, 1}, {2, 2}}, {{2, 1}}, 8).first_conflict == "passing conflict of robots 0 and 1 at step 1");
    CHECK(conflicts_of({{1, 1}, {2, 2}}, {{1, 2}}, 8).conflicts == 1);
  }
  SECTION("past one that leaves a cell beside it: at t") {
    CHECK(conflicts_of({{1, 1}, {2, 2}}, {{2, 1}, {3, 1}}, 8).first_conflict ==
          "passing conflict of robots 0 and 1 at step 1");
  }
  SECTION("past one that comes to a cell beside it: at t + 1") {
    CHECK(conflicts_of({{1, 1}, {2, 2}}, {{0, 2}, {1, 2}}, 8).first_conflict ==
          "passing conflict of robots 0 and 1 at step 1");
  }
  SECTION("a diagonal swap is a swap") {
    CHECK(conflicts_of({{1, 1}, {2, 2}}, {{2, 2}, {1, 1}}, 8).first_conflict ==
          "swap conflict of robots 0 and 1 at step 1");
  }
  SECTION("side by side, and one behind the other, is none") {
    CHECK(conflicts_of({{1, 1}, {2, 2}}, {{1, 0}, {1, 0}, {2, 0}}, 8).conflicts == 0);
    CHECK(conflicts_of({{1, 1}, {2, 2}}, {{0, 0}, {1, 1}}, 8).conflicts == 0);
  }
}

TEST_CASE("any-angle plans are moving discs") {
  const auto open = [](dmrp_vec2, dmrp_vec2, double) { return true; };
  const auto straight = [](dmrp_vec2 from, dmrp_vec2 to, double from_s, double to_s) {
    return std::vector<dmrp_waypoint>{waypoint(from, from_ns + std::llround(from_s * 1e9)),
                                      waypoint(to, from_ns + std::llround(to_s * 1e9))};
  };
  SECTION("centres of cells and steps are nothing to them") {
    Case c({straight({10.1, 20.2}, {13.3, 21.7}, 0.0, 4.7)});
    CHECK(c.verdict(DMRP_CONNECTIVITY_ANY, open).error.empty());
  }
  SECTION("they keep clear of walls") {
    Case c({straight({11, 21}, {13, 21}, 0.0, 4.0)});
    std::vector<double> asked;
    const auto wall = [&](dmrp_vec2 from, dmrp_vec2 to, double radius_m) {
      asked = {from.x, from.y, to.x, to.y, radius_m};
      return false;
    };
    CHECK(c.verdict(DMRP_CONNECTIVITY_ANY, wall).error == "robot 0, waypoint 1: the motion meets a static shape");
    CHECK(asked == std::vector<double>{11, 21, 13, 21, 0.25});
  }
  SECTION("crossing at the same time: centres meet after 2 s") {
    Case c({straight({11, 22}, {15, 22}, 0.0, 4.0), straight({13, 20}, {13, 24}, 0.0, 4.0)});
    const PlanVerdict v = c.verdict(DMRP_CONNECTIVITY_ANY, open);
    CHECK(v.conflicts == 1);
    CHECK(v.first_conflict == "robots 0 and 1 come within 0.000 m of each other at 0.50 s");
  }
  SECTION("side by side: 0.5 m touches, 0.49 m is a conflict") {
    Case touching({straight({11, 22}, {15, 22}, 0, 4), straight({11, 22.5}, {15, 22.5}, 0, 4)});
    CHECK(touching.verdict(DMRP_CONNECTIVITY_ANY, open).conflicts == 0);
    Case near({straight({11, 22}, {15, 22}, 0, 4), straight({11, 22.49}, {15, 22.49}, 0, 4)});
    CHECK(near.verdict(DMRP_CONNECTIVITY_ANY, open).conflicts > 0);
  }
  SECTION("crossing one after the other: least distance 2 sin 45 degrees of the lead") {
    // 1 m/s each; the second reaches the crossing `lead` seconds later
    const auto late = [&](double lead) {
      auto second = straight({13, 20 - lead}, {13, 24 - lead}, 0, 4);
      Case c({straight({11, 22}, {15, 22}, 0, 4), second});
      return c.verdict(DMRP_CONNECTIVITY_ANY, open).conflicts;
    };
    CHECK(late(0.70) > 0);   // 0.495 m
    CHECK(late(0.72) == 0);  // 0.509 m
  }
  SECTION("into one that rests at its goal") {
    Case c({straight({11, 22}, {12, 22}, 0, 1), straight({12, 24}, {12, 21}, 5, 8)});
    c.paths[1].insert(c.paths[1].begin(), waypoint({12, 24}, from_ns));
    CHECK(c.verdict(DMRP_CONNECTIVITY_ANY, open).conflicts > 0);
  }
}

TEST_CASE("footprints that overlap on different cells are conflicts, one for each step") {
  Case c({path({{0, 0}, {1, 0}, {2, 0}, {3, 0}}), path({{1, 1}, {1, 1}, {1, 1}, {2, 1}})});
  CHECK(c.verdict(4).conflicts == 0);
  c.set_radius(0.5);  // they touch
  CHECK(c.verdict(4).conflicts == 0);
  c.set_radius(0.51);
  const PlanVerdict verdict = c.verdict(4);
  CHECK(verdict.error.empty());
  CHECK(verdict.conflicts == 2);  // the first one arrives beside the other, and leaves
  CHECK(verdict.first_conflict == "footprint conflict of robots 0 and 1 at step 1");
}

TEST_CASE("a partial path need not reach the goal, where a window was asked for") {
  Case c({path({{0, 0}, {1, 0}, {2, 0}})});
  c.set_goals(0, {{5, 0}});
  CHECK_THAT(error_of(c), Catch::Contains("not at its goal"));
  c.partial = {true};
  CHECK(error_of(c) == "robot 0 has a partial path, but the whole way was asked for");
  c.window_steps = 2;
  CHECK(error_of(c).empty());
  c.paths[0][1].x += 0.3;  // the rest is as of every path
  CHECK_FALSE(error_of(c).empty());
}

TEST_CASE("a window ends in time, however many waypoints a path has") {
  dmrp_planning_problem problem{};
  problem.effective_from_ns = 500;
  problem.step_duration_ns = 1000;
  problem.window_steps = 10;
  const auto path_with = [](std::int64_t every_ns, std::int64_t to_ns) {
    std::vector<dmrp_waypoint> path;
    for (std::int64_t t_ns = 500; t_ns <= to_ns; t_ns += every_ns)
      path.push_back({static_cast<double>(t_ns), 0.0, 0.0, t_ns, 0, 0});
    return path;
  };
  PlannerAnswer answer;
  answer.paths = {path_with(100, 18'500), path_with(1000, 18'500), path_with(9000, 18'500), path_with(1000, 10'500)};
  cut_to_window(problem, answer);
  CHECK(answer.paths[0].back().t_ns == 10'500);
  CHECK(answer.paths[0].size() == 101);
  CHECK(answer.paths[1].back().t_ns == 10'500);
  CHECK(answer.paths[2].back().t_ns == 9'500);
  CHECK(answer.paths[3].size() == 11);
  CHECK(answer.partial == std::vector<bool>{true, true, true, false});
}

TEST_CASE("a partial path heads for a later goal only after it has been at the one before") {
  Case c({path({{0, 0}, {1, 0}, {2, 0}})});
  c.set_goals(0, {{1, 0}, {5, 0}});
  c.partial = {true};
  c.window_steps = 2;
  c.paths[0][2].goal_index = 1;
  CHECK(error_of(c).empty());
  c.set_goals(0, {{1, 1}, {5, 0}});
  CHECK_FALSE(error_of(c).empty());
}

}  // namespace plan_validator_test
