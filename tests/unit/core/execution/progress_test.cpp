// SPDX-License-Identifier: MIT
#include "core/execution/progress.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using namespace dmrp;
using namespace dmrp::core;

namespace {

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

}  // namespace

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
  CHECK(progress.gained_m() == Approx(4.0));
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

TEST_CASE("a change of the path is no gain") {
  const std::vector<dmrp_waypoint> path = {waypoint(0, 0), waypoint(5, 0)};
  PathProgress progress;
  progress.set_path(path, {0.0, 0.0});
  progress.update({1.0, 0.0}, 0);
  progress.set_path(path, {1.0, 0.0});
  CHECK(progress.progress_m() == Approx(1.0));
  CHECK(progress.gained_m() == Approx(1.0));
  progress.update({1.5, 0.0}, 0);
  CHECK(progress.gained_m() == Approx(1.5));
}

TEST_CASE("frequent replanning does not change the gain") {
  // every 0.3 m a new path begins at the next cell's centre
  PathProgress progress;
  progress.set_path(lane(0, 9), {0.0, 0.0});
  for (int i = 1; i <= 70; ++i) {
    const double x = 0.1 * i;
    progress.update({x, 0.0}, 0);
    if (i % 3 == 0) progress.set_path(lane(std::ceil(x), 9), {x, 0.0});
  }
  CHECK(progress.gained_m() == Approx(7.0));
  CHECK(progress.off_path_m() == Approx(0.0).margin(1e-9));
}

TEST_CASE("a robot that moves back and forth gains nothing by new paths") {
  PathProgress progress;
  progress.set_path(lane(0, 9), {0.0, 0.0});
  progress.update({2.0, 0.0}, 0);
  for (int swing = 0; swing < 20; ++swing) {
    progress.update({1.2, 0.0}, 0);
    progress.set_path(lane(swing % 2 == 0 ? 1 : 2, 9), {1.2, 0.0});
    progress.update({1.6, 0.0}, 0);
    progress.update({2.0, 0.0}, 0);
  }
  CHECK(progress.gained_m() == Approx(2.0));
  progress.update({2.5, 0.0}, 0);
  CHECK(progress.gained_m() == Approx(2.5));
}

TEST_CASE("a path that begins elsewhere has begun when its first waypoint is passed") {
  PathProgress progress;
  progress.set_path(lane(2, 5), {1.0, 0.0});
  CHECK_FALSE(progress.has_begun());
  progress.update({1.5, 0.0}, 0);
  CHECK_FALSE(progress.has_begun());
  CHECK(progress.progress_m() == 0.0);
  CHECK(progress.waypoint() == 0);
  CHECK(progress.gained_m() == Approx(0.5));
  progress.update({3.2, 0.0}, 0);
  CHECK(progress.has_begun());
  CHECK(progress.progress_m() == Approx(1.2));
  CHECK(progress.waypoint() == 1);
}
