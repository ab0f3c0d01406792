// SPDX-License-Identifier: MIT
#include "host/maps/drawn_tasks.hpp"

#include <catch2/catch.hpp>
#include <set>
#include <utility>

#include "host/errors/input_error.hpp"

namespace drawn_tasks_test {

using namespace dmrp;
using host::draw_tasks;
using host::MovingAiTask;

// Two parts of 4 free cells each.
core::CellMap two_parts() {
  return {5, 2, {1, 1, 0, 1, 1, 1, 1, 0, 1, 1}};
}
core::CellMap one_cell_wide() {
  return {6, 1, {1, 0, 1, 1, 1, 0}};
}

TEST_CASE("drawn tasks have distinct free starts and goals in the same part of the map") {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto tasks = draw_tasks(two_parts(), "m.map", 8, seed);
    REQUIRE(tasks.size() == 8);
    std::set<std::pair<std::uint32_t, std::uint32_t>> starts;
    std::set<std::pair<std::uint32_t, std::uint32_t>> goals;
    for (const MovingAiTask& task : tasks) {
      REQUIRE(task.start.x != 2);
      REQUIRE(task.goal.x != 2);
      REQUIRE((task.start.x < 2) == (task.goal.x < 2));
      starts.emplace(task.start.x, task.start.y);
      goals.emplace(task.goal.x, task.goal.y);
    }
    REQUIRE(starts.size() == 8);
    REQUIRE(goals.size() == 8);
  }
  for (const MovingAiTask& task : draw_tasks(one_cell_wide(), "m.map", 4, 1)) {
    CHECK((task.start.x == 0) == (task.goal.x == 0));
    CHECK(task.start.y == 0);
  }
}

TEST_CASE("fewer drawn tasks are the first of more, and another seed draws others") {
  const auto all = draw_tasks(two_parts(), "m.map", 8, 5);
  const auto some = draw_tasks(two_parts(), "m.map", 3, 5);
  const auto others = draw_tasks(two_parts(), "m.map", 8, 6);
  bool differ = false;
  for (std::size_t i = 0; i < 8; ++i) {
    if (i < 3) CHECK((some[i].start == all[i].start && some[i].goal == all[i].goal));
    differ = differ || !(others[i].start == all[i].start) || !(others[i].goal == all[i].goal);
  }
  CHECK(differ);
}

TEST_CASE("more tasks than free cells are a mistake") {
  CHECK_THROWS_WITH(draw_tasks(two_parts(), "m.map", 9, 1), "--draw 9: m.map has 8 free cells");
}

}  // namespace drawn_tasks_test
