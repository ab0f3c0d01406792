// SPDX-License-Identifier: MIT
// Plans in CSV, in metres and in cells, of one task and of several, and what is wrong with them.
#include "host/plans/plan_file.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <limits>

#include "host/errors/input_error.hpp"
#include "host/plan/plan_figures.hpp"
#include "tests/unit/host/results/results_example.hpp"

namespace plan_file_test {

using namespace dmrp::host;
using Catch::Matchers::Contains;

constexpr std::int64_t step_ns = 1'800'000'000;
constexpr std::int64_t from_ns = 500'000'000;
constexpr const char* one = "0123456789abcdef";
constexpr const char* other = "fedcba9876543210";

// A grid of 6 x 4 cells of 0.1 m; the first robot has two goals, the second one.
struct Problem {
  Problem() {
    grid.width = 6;
    grid.height = 4;
    grid.resolution_m = 0.1;
    grid.origin = {10.0, -20.0};
    for (std::size_t i = 0; i < 2; ++i) {
      robots[i].goals = goals[i].data();
      robots[i].goal_count = i == 0 ? 2 : 1;
      robots[i].goal_stride = sizeof(dmrp_goal);
    }
    goals[0][0].pose = {10.0 + 2.5 * 0.1, -20.0 + 0.5 * 0.1, 0.0};
    goals[0][1].pose = {10.0 + 1.5 * 0.1, -20.0 + 0.5 * 0.1, 0.0};
    goals[1][0].pose = {10.0 + 0.5 * 0.1, -20.0 + 3.5 * 0.1, 0.0};
    c.robot_count = 2;
    c.robots = robots.data();
    c.robot_stride = sizeof(dmrp_planning_robot);
    c.effective_from_ns = from_ns;
    c.step_duration_ns = step_ns;
    c.grid = &grid;
  }
  Problem(const Problem&) = delete;

  dmrp_grid grid{};
  std::array<std::array<dmrp_goal, 2>, 2> goals{};
  std::array<dmrp_planning_robot, 2> robots{};
  dmrp_planning_problem c{};
};

class PlanFolder {
 public:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  std::string mistake(const std::string& text) const {
    const Problem problem;
    try {
      PlanFile(write("plan.csv", text)).paths(one, problem.c);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no mistake";
  }

 private:
  dmrp::test::ScratchFolder folder_;
};

TEST_CASE("cells count from the top left, and steps from when the plan takes effect") {
  const PlanFolder folder;
  const Problem problem;
  const std::string text = "agent,t,x,y\n0,0,1,3\n0,1,2,3\n0,2.5,1,3\n1,0,0,0\n";
  const PlannedPaths paths = PlanFile(folder.write("plan.csv", text)).paths(one, problem.c);
  REQUIRE(paths.size() == 2);
  REQUIRE(paths[0].size() == 3);
  CHECK(paths[0][0].x == 10.0 + 1.5 * 0.1);
  CHECK(paths[0][0].y == -20.0 + 0.5 * 0.1);
  CHECK(paths[0][0].t_ns == from_ns);
  CHECK(paths[0][1].t_ns == from_ns + step_ns);
  CHECK(paths[0][2].t_ns == from_ns + step_ns * 5 / 2);
  CHECK(std::isnan(paths[0][0].theta));
  CHECK(paths[1][0].y == -20.0 + 3.5 * 0.1);
  // the second goal's place was passed before the first goal
  CHECK(paths[0][0].goal_index == 0);
  CHECK(paths[0][1].goal_index == 0);
  CHECK(paths[0][2].goal_index == 1);
  CHECK(paths_csv(problem.c, paths) == text);
}

TEST_CASE("a file has the plans of several tasks, or one for all") {
  const PlanFolder folder;
  const Problem problem;
  const std::string rows = "0,0,1.5,2,,0\n0,7,1,2,0.5,1\n";
  const PlanFile several(folder.write("several.csv", std::string("task,robot,t_ns,x,y,theta,goal_index\n") + one +
                                                         ",0,0,1.5,2,,0\n" + other + ",0,3,4,5,,0\n"));
  CHECK((several.holds(one) && several.holds(other)));
  CHECK_FALSE(several.holds("0000000000000000"));
  CHECK(several.paths(one, problem.c).at(0).at(0).x == 1.5);
  CHECK(several.paths(other, problem.c).at(0).at(0).t_ns == 3);
  CHECK_THROWS_WITH(several.fail(other, 0, 0, "no"), Contains("several.csv:3:1: no"));

  const PlanFile all(folder.write("all.csv", std::string("robot,t_ns,x,y,theta,goal_index\r\n") + rows));
  CHECK((all.holds(one) && all.holds("")));
  CHECK(all.paths(one, problem.c).at(0).at(1).goal_index == 1);
  CHECK_THROWS_WITH(all.fail(one, 0, 1, "no"), Contains("all.csv:3:1: no"));
  CHECK_THROWS_WITH(all.fail(one, 1, 0, "no"), Contains("all.csv:3:1: no"));
}

TEST_CASE("what a plan lacks is told with file and task") {
  const PlanFolder folder;
  const Problem problem;
  PlanFiles files{folder.write("{repetition}.csv", "")};
  files.by_repetition[2] = folder.write("2.csv", std::string("task,agent,t,x,y\n") + one + ",0,0,1,3\n");
  PlansOfFiles plans(files);
  PlannerAnswer answer = plans.answer(2, one, problem.c);
  CHECK(answer.status == DMRP_OK);
  CHECK(answer.paths.size() == 1);
  answer = plans.answer(2, other, problem.c);
  CHECK(answer.status == DMRP_NO_SOLUTION);
  CHECK_THAT(answer.text, Contains("2.csv: holds no plan of task fedcba9876543210"));
  answer = plans.answer(1, one, problem.c);
  CHECK(answer.status == DMRP_NO_SOLUTION);
  CHECK_THAT(answer.text, Contains("{repetition}.csv: there is no file of repetition 1"));
}

TEST_CASE("a mistake is told by line and column") {
  const PlanFolder folder;
  const std::string cells = "agent,t,x,y\n";
  CHECK(folder.mistake(cells + "0,0,1,3\n") == "no mistake");
  CHECK_THAT(folder.mistake(""), Contains("plan.csv:1:1: the first line must be "));
  CHECK_THAT(folder.mistake("agent,step,x,y\n"), Contains(":1:1: the first line must be "));
  CHECK_THAT(folder.mistake(cells + "zero,0,1,3\n"), Contains(":2:1: agent must be a whole number, not 'zero'"));
  CHECK_THAT(folder.mistake(cells + "1,0,1,3\n"), Contains(":2:1: agent must be 0, or the next one, not 1"));
  CHECK_THAT(folder.mistake(cells + "0,0,1,3\n\n0,1,1,3\n"), Contains(":3:1: agent must be a whole number, not ''"));
  CHECK_THAT(folder.mistake(cells + "0,1e300,1,3\n"), Contains(":2:3: t is beyond all trials"));
  CHECK_THAT(folder.mistake(cells + "0,nan,1,3\n"), Contains(":2:3: t is beyond all trials"));
  CHECK_THAT(folder.mistake(cells + "0,0,1\n"), Contains(":2:"));
  CHECK_THAT(folder.mistake(cells + "0,0,1,3,5\n"), Contains("a row has the values agent,t,x,y"));
  const std::string tasks = "task,agent,t,x,y\n";
  const std::string row = ",0,0,1,3\n";
  CHECK_THAT(folder.mistake(tasks + "7" + row), Contains(":2:1: task must be 16 hexadecimal digits, as in trials.csv"));
  CHECK_THAT(folder.mistake(tasks + one + row + other + row + one + row),
             Contains(":4:1: the rows of task 0123456789abcdef must be together"));
}

}  // namespace plan_file_test
