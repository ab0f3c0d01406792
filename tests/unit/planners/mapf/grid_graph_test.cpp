// SPDX-License-Identifier: MIT
// The graph of a grid, distances on it, and the proofs that a problem on it has no plan.
#include "planners/mapf/grid_graph.hpp"

#include <catch2/catch.hpp>

#include "planners/mapf/solvability.hpp"
#include "planners/mapf/tour_table.hpp"
#include "tests/unit/planners/mapf/problem_case.hpp"

namespace grid_graph_test {

using namespace dmrp::test;
using namespace dmrp::planners;

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
  CHECK_FALSE(graph.is_open(2));  // a robot rests there
  CHECK(graph.neighbor(1, 0) == nowhere);
  CHECK(graph.neighbor(5, 3) == nowhere);
  CHECK(problem.agents.size() == 1);
}

TEST_CASE("a graph numbers the free cells only") {
  PlanningCase c({"#.#.", "....", "#.##"});
  const Problem problem = problem_of(c);
  const GridGraph& graph = problem.graph;
  REQUIRE(graph.location_count() == 7);
  CHECK(graph.at(0, 0) == nowhere);
  CHECK(graph.at(-1, 1) == nowhere);
  CHECK(graph.at(4, 1) == nowhere);
  CHECK(graph.at(1, 3) == nowhere);
  Location next = 0;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) {
      if (!c.is_free({column, row})) continue;
      REQUIRE(graph.at(column, row) == next);
      CHECK(graph.column(next) == column);
      CHECK(graph.row(next) == row);
      CHECK(graph.locate(graph.center(next)) == next);
      CHECK(graph.locate(c.center({column, row})) == next);
      ++next;
    }
  CHECK(graph.neighbor(graph.at(1, 0), 1) == graph.at(1, 1));
  CHECK(graph.neighbor(graph.at(1, 0), 0) == nowhere);
}

TEST_CASE("distances count the steps of the whole tour, however long it is") {
  // one way down the left column and up the right one: neighbors in a row may be farther apart than 16 bits count
  for (const int rows : {9, 40'000}) {
    std::vector<std::string> cells(static_cast<std::size_t>(rows), ".#.");
    cells.back() = "...";
    PlanningCase c(cells);
    c.robot({0, 0}, {{2, 0}, {0, 1}});
    const Problem problem = problem_of(c);
    const TourTable table(problem.graph, problem.agents[0]);
    const int whole = 2 * rows;  // from one end to the other
    const auto from = [&](int leg, int column, int row) { return table.distance(leg, problem.graph.at(column, row)); };
    CAPTURE(rows);
    CHECK(from(1, 0, 1) == 0);
    CHECK(from(1, 0, 0) == 1);
    CHECK(from(1, 2, 0) == whole - 1);
    CHECK(from(0, 2, 0) == whole - 1);  // the step back is the first of the next leg
    CHECK(from(0, 0, 0) == whole + whole - 1);
    CHECK(from(0, 0, 8) == whole - 8 + whole - 1);
    CHECK(from(1, 2, 8) == whole - 1 - 8);
  }
}

TEST_CASE("joint positions prove that there is no plan, up to their limit") {
  // A T: three robots cannot all exchange their places around one branch of one cell.
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

}  // namespace grid_graph_test
