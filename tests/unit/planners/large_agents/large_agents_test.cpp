// SPDX-License-Identifier: MIT
// Robots of different sizes and shapes: the planners against a joint search with a conflict relation of its own, and
// every plan against outlines that move in small pieces of time.
#include <catch2/catch.hpp>
#include <map>

#include "tests/support/draws.hpp"
#include "tests/unit/planners/joint_optimum.hpp"
#include "tests/unit/planners/large_agents/outlines.hpp"
#include "tests/unit/planners/plan_check.hpp"
#include "tests/unit/planners/planner_variants.hpp"
#include "tests/unit/planners/random_case.hpp"

namespace large_agents_test {

using namespace dmrp::test;

std::vector<dmrp_vec2> rectangle(double length_m, double width_m) {
  return {{-length_m / 2, -width_m / 2},
          {length_m / 2, -width_m / 2},
          {length_m / 2, width_m / 2},
          {-length_m / 2, width_m / 2}};
}

// Discs of several sizes, and polygons that are longer than wide; cells are 0.5 m wide.
void give_shape(Random& random, CaseRobot& robot) {
  const int kind = random.below(7);
  if (kind < 5) {
    constexpr double radii_m[] = {0.1, 0.2, 0.3, 0.42, 0.6};
    robot.radius_m = radii_m[kind];
    return;
  }
  robot.outline = kind == 5 ? rectangle(0.7, 0.3) : std::vector<dmrp_vec2>{{-0.1, -0.15}, {0.45, 0.0}, {-0.1, 0.15}};
  robot.radius_m = kind == 5 ? std::hypot(0.35, 0.15) : 0.45;
}

// Random cases with robots that differ in shape and, some of them, in their free cells.
PlanningCase mixed_case(uint64_t seed, int most_robots) {
  PlanningCase c = random_case(seed, most_robots);
  Random random(seed + 77);
  for (CaseRobot& robot : c.robots) {
    robot.state = DMRP_ROBOT_ACTIVE;
    give_shape(random, robot);
    for (int y = 0; y < c.height && random.one_in(2); ++y)
      for (int x = 0; x < c.width; ++x) {
        const CellXY cell{x, y};
        const bool is_end = cell == robot.start || std::count(robot.goals.begin(), robot.goals.end(), cell) > 0;
        if (c.is_free(cell) && !is_end && random.one_in(8)) robot.closed.push_back(cell);
      }
  }
  return c;
}

std::string check_mixed(const PlanningCase& c, const Plan& plan) {
  if (const std::string error = check_plan(c, plan); !error.empty()) return error;
  StepOverlap overlap(c);
  std::vector<std::vector<CellXY>> cells;
  std::size_t steps = 0;
  for (const auto& path : plan.paths) {
    cells.push_back(*cells_of(c, path));
    steps = std::max(steps, path.size());
  }
  const auto at = [&](std::size_t i, std::size_t t) { return cells[i][std::min(t, cells[i].size() - 1)]; };
  for (std::size_t a = 0; a < cells.size(); ++a) {
    for (const CellXY cell : cells[a])
      if (std::count(c.robots[a].closed.begin(), c.robots[a].closed.end(), cell) > 0)
        return "robot " + std::to_string(a) + " leaves its own grid";
    for (std::size_t b = a + 1; b < cells.size(); ++b)
      for (std::size_t t = 1; t <= steps; ++t)
        if (overlap(a, at(a, t - 1), at(a, t), b, at(b, t - 1), at(b, t)))
          return "robots " + std::to_string(a) + " and " + std::to_string(b) + " touch in step " + std::to_string(t);
  }
  return "";
}

std::optional<int> optimum_of(const PlanningCase& c) {
  StepOverlap overlap(c);
  return JointSearch(c, std::numeric_limits<std::size_t>::max(),
                     [&](std::size_t a, CellXY a0, CellXY a1, std::size_t b, CellXY b0, CellXY b1) {
                       return overlap(a, a0, a1, b, b0, b1);
                     })
      .optimum();
}

struct MixedPlanner {
  std::string id;
  double suboptimality;  // 0: no bound
  ParamOverrides overrides;
};

const std::vector<MixedPlanner> mixed_planners = {
    {cbs, 1, {{"node_limit", std::int64_t{1000}}}},
    {ecbs, 1.2, {{"node_limit", std::int64_t{1000}}, {"suboptimality", 1.2}}},
    {eecbs, 1.5, {{"node_limit", std::int64_t{1000}}, {"suboptimality", 1.5}}},
    {"dmrp.planner.sipp", 0, {{"restarts", std::int64_t{20}}}},
};

TEST_CASE("robots of many shapes get plans without contact, within their bounds", "[large_agents]") {
  std::vector<std::unique_ptr<PluginUnderTest>> planners;
  for (const MixedPlanner& which : mixed_planners)
    planners.push_back(std::make_unique<PluginUnderTest>(planner_library, which.id, which.overrides));
  std::map<std::string, Tally> tallies;
  int with_plan = 0;
  for (uint64_t seed = 1; seed <= draws(100u); ++seed) {
    const PlanningCase c = mixed_case(seed, 3);
    const std::optional<int> optimum = optimum_of(c);
    with_plan += optimum.has_value();
    for (std::size_t i = 0; i < planners.size(); ++i) {
      const MixedPlanner& which = mixed_planners[i];
      CAPTURE(which.id, seed);
      const Plan plan = run_planner(*planners[i], c);
      Tally& tally = tallies[which.id];
      if (plan.status == DMRP_NO_SOLUTION) {
        REQUIRE(!optimum);
        ++tally.unsolvable;
        continue;
      }
      if (optimum) REQUIRE(plan.statistics.at("lower_bound") <= *optimum);
      if (plan.status == DMRP_TIMEOUT) {
        ++tally.given_up;
        continue;
      }
      REQUIRE(plan.status == DMRP_OK);
      REQUIRE(optimum);
      REQUIRE(check_mixed(c, plan) == "");
      REQUIRE(plan.statistics.at("cost") == plan.cost());
      REQUIRE(plan.cost() >= *optimum);
      if (which.suboptimality == 1) REQUIRE(plan.cost() == *optimum);
      if (which.suboptimality > 0)
        REQUIRE(plan.cost() <= which.suboptimality * plan.statistics.at("lower_bound") + 1e-9);
      ++tally.solved;
    }
  }
  CHECK(with_plan >= draws(36));
  for (const auto& [id, tally] : tallies) {
    CAPTURE(id, tally.solved, tally.unsolvable, tally.given_up, with_plan);
    CHECK(tally.solved >= with_plan * 95 / 100);
  }
}

TEST_CASE("a large robot lets a small one pass only where both fit", "[large_agents]") {
  // two rows of cells: discs of 0.3 and 0.15 m cannot be side by side in cells of 0.5 m at a right angle's corner, but can
  // pass each other in a straight line
  PlanningCase straight({"......", "......"});
  straight.robot({0, 0}, {{5, 0}}).robot({5, 1}, {{0, 1}});
  straight.robots[0].radius_m = 0.3;
  straight.robots[1].radius_m = 0.2;
  CHECK(run_planner(cbs, straight).cost() == 10);
  straight.robots[1].radius_m = 0.21;  // 0.51 m together
  CHECK(run_planner(cbs, straight, {{"node_limit", std::int64_t{200}}}).status == DMRP_TIMEOUT);
}

TEST_CASE("long robots pass each other side by side and wait where they cannot", "[large_agents]") {
  // 0.7 x 0.3 m: 0.76 m across, so two of them cannot stand on neighbouring cells, but drive past each other
  PlanningCase c({"..........", "..........", ".........."});
  c.robot({0, 0}, {{9, 0}}).robot({9, 1}, {{0, 1}});
  for (CaseRobot& robot : c.robots) {
    robot.outline = rectangle(0.7, 0.3);
    robot.radius_m = std::hypot(0.35, 0.15);
  }
  const Plan plan = run_planner(cbs, c);
  REQUIRE(plan.status == DMRP_OK);
  CHECK(check_mixed(c, plan) == "");
  CHECK(plan.cost() == *optimum_of(c));
}

TEST_CASE("robots that rest are obstacles with their outlines", "[large_agents]") {
  PlanningCase c({".......", ".......", ".......", ".......", "......."});
  c.robot({0, 2}, {{6, 2}}).robot({3, 2}, {{3, 2}}, DMRP_ROBOT_FINISHED);
  c.robots[1].radius_m = 0.5;  // with the other's 0.15 m more than one cell
  for (const MixedPlanner& which : mixed_planners) {
    PluginUnderTest planner(planner_library, which.id, which.overrides);
    const Plan plan = run_planner(planner, c);
    REQUIRE(plan.status == DMRP_OK);
    CHECK(check_mixed(c, plan) == "");
    CHECK(plan.cost() == 10);  // two rows aside: 0.65 m
  }
}

TEST_CASE("each robot has its own grid", "[large_agents]") {
  // a passage in the middle that is closed for the wide robot alone
  PlanningCase c({".....", "##.##", "....."});
  c.robot({0, 0}, {{0, 2}}).robot({4, 0}, {{4, 2}});
  c.robots[1].closed = {{2, 1}};
  PluginUnderTest individual_paths(planner_library, individual);
  CHECK(run_planner(individual_paths, c).status == DMRP_NO_SOLUTION);
  CHECK(individual_paths.host().errors.back() == "robot 1 cannot reach its goal");
  c.robots[1].goals = {{0, 0}};
  for (const std::string& id : {std::string(individual), std::string(cbs), std::string("dmrp.planner.sipp")}) {
    const Plan plan = run_planner(id, c);
    REQUIRE(plan.status == DMRP_OK);
    CHECK(check_paths(c, plan) == "");
    CHECK(plan.cost() == (id == individual ? 10 : 11));  // they cross each other's way
  }
}

TEST_CASE("planners that cannot plan for large robots name two of them and their numbers", "[large_agents]") {
  PlanningCase c({"......", "......"});
  c.robot({0, 0}, {{3, 0}}).robot({5, 1}, {{2, 1}}).robot({5, 0}, {{5, 0}});
  c.robots[1].radius_m = 0.25;
  c.robots[2].radius_m = 0.4;
  const std::string others = "; of the built-in planners cbs, ecbs, eecbs and sipp plan for them";
  for (const char* id : {"dmrp.planner.pibt", "dmrp.planner.lacam", "dmrp.planner.lns", "dmrp.planner.ecbs8"}) {
    PluginUnderTest planner(planner_library, id);
    CHECK(run_planner(planner, c).status == DMRP_NO_SOLUTION);
    CHECK(planner.host().errors.back() ==
          "robot 1 (radius 0.25 m) and robot 2 (radius 0.40 m) can touch without meeting in a cell: radii of 0.65 m "
          "together, at most 0.35 m fit cells of 0.50 m" +
              others);
    PlanningCase grids = c;
    for (CaseRobot& robot : grids.robots) robot.radius_m = 0.1;
    grids.robots[1].closed = {{4, 0}};
    CHECK(run_planner(planner, grids).status == DMRP_NO_SOLUTION);
    CHECK(planner.host().errors.back() ==
          "robot 0 (12 free cells) and robot 1 (11 free cells) have different grids" + others);
  }
}

TEST_CASE("starts and goals that robots cannot share are named at once", "[large_agents]") {
  PlanningCase c({"......", "......"});
  c.robot({0, 0}, {{3, 0}}).robot({1, 0}, {{5, 1}});
  c.robots[0].radius_m = 0.4;
  for (const MixedPlanner& which : mixed_planners) {
    PluginUnderTest planner(planner_library, which.id, which.overrides);
    CHECK(run_planner(planner, c).status == DMRP_NO_SOLUTION);
    CHECK(planner.host().errors.back() ==
          "robot 0 (radius 0.40 m) starts 0.50 m from robot 1 (radius 0.15 m): their outlines overlap");
    PlanningCase ends = c;
    std::swap(ends.robots[1].start, ends.robots[1].goals[0]);
    ends.robots[0].goals = {{0, 0}};
    CHECK(run_planner(planner, ends).status == DMRP_NO_SOLUTION);
    CHECK(planner.host().errors.back() ==
          "robot 0 (radius 0.40 m) ends 0.50 m from robot 1 (radius 0.15 m): their outlines overlap");
  }
}

}  // namespace large_agents_test
