// SPDX-License-Identifier: MIT
#include "core/execution/progress.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

namespace progress_test {

using namespace dmrp;
using namespace dmrp::core;

dmrp_waypoint waypoint(double x, double y, std::uint32_t goal = 0) {
  dmrp_waypoint made{};
  made.x = x;
  made.y = y;
  made.goal_index = goal;
  return made;
}

std::vector<dmrp_waypoint> lane(double from, double to) {
  std::vector<dmrp_waypoint> path;
  for (double x = from; x <= to; x += 1.0) path.push_back(waypoint(x, 0));
  return path;
}

TEST_CASE("progress follows a path and never decreases") {
  const std::vector<dmrp_waypoint> path = {waypoint(0, 0), waypoint(2, 0), waypoint(2, 0), waypoint(2, 2)};
  PathProgress progress;
  progress.set_path(path, {0.0, 0.0});
  progress.update({1.0, 0.3}, 0);
  CHECK(progress.progress_m() == Approx(1.0));
  CHECK(progress.waypoint() == 0);
  progress.update({0.5, 0.0}, 0);
  CHECK(progress.progress_m() == Approx(1.0));
  progress.update({2.1, 0.0}, 0);
  CHECK(progress.progress_m() == Approx(2.0));
  CHECK(progress.waypoint() == 2);  // the wait counts as passed
  progress.update({2.0, 2.5}, 0);
  CHECK(progress.progress_m() == Approx(4.0));
  CHECK(progress.waypoint() == 3);
}

TEST_CASE("progress does not jump to a later lap, nor past a goal that is not reached") {
  // out and back on the same lane, the goal at the far end
  const std::vector<dmrp_waypoint> path = {waypoint(0, 0), waypoint(1, 0), waypoint(2, 0), waypoint(1, 0, 1),
                                           waypoint(0, 0, 1)};
  PathProgress progress;
  progress.set_path(path, {0.0, 0.0});
  progress.update({1.9, 0.05}, 0);
  CHECK(progress.progress_m() == Approx(1.9));
  progress.update({1.2, 0.0}, 0);
  CHECK(progress.progress_m() == Approx(1.9));
  progress.update({2.0, 0.0}, 0);
  progress.update({1.2, 0.0}, 1);
  CHECK(progress.progress_m() == Approx(2.8));
}

TEST_CASE("progress follows a robot that cuts off a long detour") {
  std::vector<dmrp_waypoint> path = {waypoint(0, 0), waypoint(0, 6), waypoint(1, 6), waypoint(1, 0), waypoint(9, 0)};
  PathProgress progress;
  progress.set_path(path, {0.0, 0.0});
  for (int i = 0; i <= 80; ++i) progress.update({0.1 * i, 0.0}, 0);
  // the detour is 13 m long; after as many metres without progress it would be found for certain
  for (int i = 80; i >= 0; --i) progress.update({0.1 * i, 0.0}, 0);
  for (int i = 0; i <= 90; ++i) progress.update({0.1 * i, 0.0}, 0);
  CHECK(progress.progress_m() == Approx(21.0));
}

TEST_CASE("a new path begins at the robot") {
  const std::vector<dmrp_waypoint> path = {waypoint(0, 0), waypoint(5, 0)};
  PathProgress progress;
  progress.set_path(path, {0.0, 0.0});
  progress.update({1.0, 0.0}, 0);
  progress.set_path(path, {1.0, 0.0});
  CHECK(progress.progress_m() == Approx(1.0));
  CHECK(progress.off_path_m() == Approx(0.0).margin(1e-9));
}

TEST_CASE("a loop back to the same cell is driven, not skipped") {
  // out of a cell to give way, and back into it: as PIBT and LaCAM* plan
  const std::vector<dmrp_waypoint> path = {waypoint(0, 0), waypoint(1, 0), waypoint(1, 1), waypoint(1, 0),
                                           waypoint(2, 0)};
  PathProgress progress;
  progress.set_path(path, {0.0, 0.0});
  CHECK(progress.before_return() == 4);
  progress.update({0.9, 0.05}, 0);
  CHECK(progress.progress_m() == Approx(0.9));
  CHECK(progress.before_return() == 2);  // then back to where it is
  for (int i = 0; i < 100; ++i) progress.update({1.0, 0.1 * (i % 2)}, 0);
  CHECK(progress.progress_m() < 1.2);
  progress.update({1.0, 0.9}, 0);
  CHECK(progress.progress_m() == Approx(1.9));
  CHECK(progress.before_return() == 4);
  progress.update({1.0, 1.0}, 0);
  progress.update({1.0, 0.4}, 0);
  progress.update({1.5, 0.0}, 0);
  CHECK(progress.progress_m() == Approx(3.5));
}

TEST_CASE("a plan that pushes a robot out of its cell and back leads it through every cell between") {
  // as PIBT plans for robot 57 of 64 in the warehouse: the order has released the last waypoint, which is the second
  const std::vector<dmrp_waypoint> path = {waypoint(18.5, 21.5), waypoint(17.5, 21.5), waypoint(17.5, 22.5),
                                           waypoint(16.5, 22.5), waypoint(16.5, 21.5), waypoint(17.5, 21.5)};
  PathProgress progress;
  progress.set_path(path, {18.5, 21.5});
  std::vector<std::uint32_t> ends;  // of what the robot may drive
  dmrp_vec2 place = {18.5, 21.5};
  for (int step = 0; step < 2000 && progress.waypoint() + 1 < path.size(); ++step) {
    const std::uint32_t end = progress.before_return();
    if (ends.empty() || ends.back() != end) ends.push_back(end);
    const dmrp_waypoint& next = path[progress.waypoint() + 1];
    const dmrp_vec2 way = dmrp_vec2{next.x, next.y} - place;
    place = place + std::min(1.0, 0.03 / std::max(1e-9, toolkit::norm(way))) * way;
    progress.update(place, 0);
    REQUIRE(progress.waypoint() <= end);
    // more than its tolerance from the end of what it may drive, unless it goes on there
    if (progress.waypoint() < 4)
      CHECK(toolkit::distance(place, toolkit::position(path[progress.before_return()])) > 0.2);
  }
  CHECK(ends == std::vector<std::uint32_t>{5, 4, 5});
}

TEST_CASE("a path that begins elsewhere has begun when its first waypoint is passed") {
  PathProgress progress;
  progress.set_path(lane(2, 5), {1.0, 0.0});
  CHECK_FALSE(progress.has_begun());
  progress.update({1.5, 0.0}, 0);
  CHECK_FALSE(progress.has_begun());
  CHECK(progress.progress_m() == 0.0);
  CHECK(progress.waypoint() == 0);
  progress.update({3.2, 0.0}, 0);
  CHECK(progress.has_begun());
  CHECK(progress.progress_m() == Approx(1.2));
  CHECK(progress.waypoint() == 1);
}

}  // namespace progress_test
