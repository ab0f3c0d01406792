// SPDX-License-Identifier: MIT
// dmrp/testing.hpp finds what is wrong with a plan, and hands a planner what the hall shows.
#include <catch2/catch.hpp>
#include <dmrp/testing.hpp>

namespace planner_testing_test {

using dmrp::testing::Hall;
using dmrp::testing::PlannerAnswer;

// Drives each robot along the steps that its parameter says: "A:rrd B:ll"; w waits.
class Scripted final : public dmrp::GlobalPlanner {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("test.scripted", "Scripted", "1.0.0").connectivity(DMRP_CONNECTIVITY_4);
  }
  dmrp::Param<std::string> steps = param("steps", "");
  dmrp::Param<std::int64_t> cost = param("cost", std::int64_t{7}).range(0, 9);

  dmrp::Status plan(const dmrp::PlanningProblem& problem, dmrp::PlanSink& sink) override {
    log(dmrp::LogLevel::info, "planning");
    sink.statistic("cost", static_cast<double>(*cost));
    if (steps->empty()) return set_error("no steps"), dmrp::Status::no_solution;
    for (std::uint32_t i = 0; i < problem.robots.size(); ++i) {
      const std::string name = problem.robots[i].robot->name;
      const std::size_t at = steps->find(name + ":");
      if (at == std::string::npos) continue;
      dmrp::Vec2 place = problem.robots[i].start;
      std::vector<dmrp::Waypoint> path = {dmrp::waypoint(place.x, place.y, 0, 0)};
      for (std::size_t k = at + 2; k < steps->size() && (*steps)[k] != ' '; ++k) {
        const char step = (*steps)[k];
        place.x += step == 'r' ? 1.0 : step == 'l' ? -1.0 : step == 'j' ? 2.0 : 0.0;
        place.y += step == 'u' ? 1.0 : step == 'd' ? -1.0 : 0.0;
        path.push_back(dmrp::waypoint(place.x, place.y, static_cast<std::int64_t>(path.size()) * 1'000'000'000, 0));
      }
      sink.path(i, path);
    }
    return dmrp::Status::ok;
  }
};

PlannerAnswer answer(const std::vector<std::string>& rows, const std::string& steps) {
  return dmrp::testing::plan("test.scripted", Hall(rows), {{"steps", steps}});
}

TEST_CASE("a plan that keeps the rules has no breach") {
  const PlannerAnswer good = answer({"A.b", "..B", "..a"}, "A:ddrr B:wwu");
  CHECK(good.status == DMRP_OK);
  CHECK(good.breach.empty());
  CHECK(good.paths[0].size() == 5);
  CHECK(good.statistics.at("cost") == 7.0);
  CHECK(good.log == std::vector<std::string>{"planning"});
}

TEST_CASE("each breach of a plan is named") {
  CHECK(answer({"A.a"}, "A:r").breach == "A does not end at its goal");
  CHECK(answer({"A#a"}, "A:rr").breach == "A is on no free cell at step 1");
  CHECK(answer({"A.a"}, "A:j").breach == "A moves more than a cell at step 1");
  CHECK(answer({"A.a", "B.b"}, "A:rr").breach == "B has no path");
  CHECK(answer({"A.b", "..B", "..a"}, "A:ddrr B:ull").breach == "B does not end at its goal");
  CHECK(answer({"AB", "ba"}, "A:rd B:wdl").breach == "A and B are on one cell at step 1");
  CHECK(answer({"AB", "ba"}, "A:dr B:dl").breach == "A and B change places at step 2");
  CHECK(answer({"Ab.", "Ba."}, "A:rd B:ru").breach == "A and B change places at step 2");
}

TEST_CASE("no plan is an answer with its reason, and what does not exist is said at once") {
  const PlannerAnswer none = answer({"A.a"}, "");
  CHECK(none.status == DMRP_NO_SOLUTION);
  CHECK(none.error == "no steps");
  CHECK(none.breach.empty());
  CHECK_THROWS_WITH(dmrp::testing::plan("test.other", Hall({"A.a"})), "this program has no plugin test.other");
  CHECK_THROWS_WITH(Hall({"A.", "a"}), "a hall has rows of one length");
  CHECK_THROWS_WITH(Hall({"A."}), "the hall has no 'a'");
}

TEST_CASE("a hall is a grid of cells, the first row on top, whose diagonal moves cut no corner") {
  const Hall hall({"a#", "A."});
  const dmrp_grid& grid = *hall.problem().grid;
  CHECK(grid.width == 2);
  CHECK(std::vector<int>(grid.free, grid.free + 4) == std::vector<int>{1, 1, 1, 0});
  CHECK(grid.edges[0] == (DMRP_EDGE_E | DMRP_EDGE_N));
  CHECK(grid.edges[1] == DMRP_EDGE_W);
  CHECK(hall.problem().robots[0].start.y == 0.5);
  CHECK(hall.problem().robots[0].goals->pose.y == 1.5);
}

}  // namespace planner_testing_test

DMRP_PLUGINS(planner_testing_test::Scripted)
