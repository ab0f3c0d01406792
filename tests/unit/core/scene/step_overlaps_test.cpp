// SPDX-License-Identifier: MIT
// Footprints that overlap during a step, against outlines that move in small pieces of time.
#include "core/scene/step_overlaps.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>

#include "tests/support/outline_overlap.hpp"

namespace step_overlaps_test {

using dmrp::core::StepOverlaps;
using dmrp::test::Outline;
using dmrp::toolkit::Cell;
using dmrp::toolkit::Stream;

constexpr double cell_m = 0.8;
constexpr std::uint32_t side = 9;

// Cells that are all free, with a clearance of 5 m.
struct Hall {
  std::vector<std::uint8_t> free = std::vector<std::uint8_t>(side * side, 1);
  std::vector<std::uint8_t> edges = std::vector<std::uint8_t>(side * side, 0xff);
  std::vector<float> clearance = std::vector<float>(side * side, 5.0f);
  dmrp_grid grid{sizeof(dmrp_grid), side, side, 0, cell_m, {0.0, 0.0}, free.data(), edges.data(), clearance.data()};
};

StepOverlaps::Robot disc(const Hall& hall, double radius_m) {
  return {radius_m, {}, &hall.grid, true};
}

StepOverlaps::Robot rectangle(const Hall& hall, double length_m, double width_m) {
  const double x = length_m / 2;
  const double y = width_m / 2;
  return {std::hypot(x, y), {{{-x, -y}, {x, -y}, {x, y}, {-x, y}}}, &hall.grid, true};
}

StepOverlaps::Robot random_robot(Stream& random, const Hall& hall) {
  if (random.chance(0.3)) return disc(hall, random.uniform(0.2, 0.9));
  if (random.chance(0.5)) return rectangle(hall, random.uniform(0.6, 1.6), random.uniform(0.2, 0.6));
  // two parts, not symmetric
  StepOverlaps::Robot robot = rectangle(hall, random.uniform(0.4, 0.8), 0.2);
  const double nose_m = random.uniform(0.5, 1.0);
  robot.parts.push_back({{0.1, -0.3}, {nose_m, 0.0}, {0.1, 0.3}});
  robot.radius_m = std::max(robot.radius_m, nose_m);
  return robot;
}

// The outlines that the robot may have on the way, as unions of parts: heading ahead or back; standing, the circle.
std::vector<Outline> outlines(const StepOverlaps::Robot& robot, Cell from, Cell to) {
  if (robot.parts.empty() || from == to) return {{robot.radius_m, {}}};
  const double length = std::hypot(to.column - from.column, to.row - from.row);
  const double c = (to.column - from.column) / length;
  const double s = (to.row - from.row) / length;
  std::vector<Outline> out;
  for (const double sign : {1.0, -1.0})
    for (const auto& part : robot.parts) {
      Outline& outline = out.emplace_back();
      for (const dmrp_vec2 p : part)
        outline.corners.push_back({sign * (c * p.x - s * p.y), sign * (s * p.x + c * p.y)});
    }
  return out;
}

dmrp_vec2 between(Cell from, Cell to, double share) {
  return {cell_m * (from.column + share * (to.column - from.column)),
          cell_m * (from.row + share * (to.row - from.row))};
}

double deepest(const StepOverlaps::Robot& a, Cell a0, Cell a1, const StepOverlaps::Robot& b, Cell b0, Cell b1) {
  double depth = dmrp::test::overlap_depth({a.radius_m, {}}, between(a0, a1, 1), {b.radius_m, {}}, between(b0, b1, 1));
  for (int i = 0; i <= 200; ++i)
    for (const Outline& one : outlines(a, a0, a1))
      for (const Outline& two : outlines(b, b0, b1))
        depth = std::max(depth,
                         dmrp::test::overlap_depth(one, between(a0, a1, i / 200.0), two, between(b0, b1, i / 200.0)));
  return depth;
}

TEST_CASE("footprints overlap during a step as their outlines do") {
  constexpr double grazing_m = 1e-3;  // between two pieces of time
  const Hall hall;
  Stream random(3, "steps");
  const auto near = [&](std::int32_t at) { return at + static_cast<std::int32_t>(random.below(3)) - 1; };
  int overlapping = 0;
  int apart = 0;
  for (int round = 0; round < 1500; ++round) {
    const std::vector<StepOverlaps::Robot> robots = {random_robot(random, hall), random_robot(random, hall)};
    StepOverlaps overlaps(cell_m, robots);
    const Cell a0{4, 4};
    const Cell b0{2 + static_cast<std::int32_t>(random.below(5)), 2 + static_cast<std::int32_t>(random.below(5))};
    const Cell a1{near(a0.column), near(a0.row)};
    const Cell b1{near(b0.column), near(b0.row)};
    const double depth_m = deepest(robots[0], a0, a1, robots[1], b0, b1);
    CAPTURE(round, depth_m);
    const bool found = overlaps.are_possible() && overlaps.overlap(0, a0, a1, 1, b0, b1);
    if (depth_m > 1e-5) REQUIRE(found);
    if (depth_m < -grazing_m) REQUIRE(!found);
    if (overlaps.are_possible()) REQUIRE(overlaps.overlap(1, b0, b1, 0, a0, a1) == found);
    ++(found ? overlapping : apart);
  }
  CHECK(overlapping > 300);
  CHECK(apart > 300);
}

TEST_CASE("robots that fit the cells next to each other need no look") {
  const Hall hall;
  const double most_m = cell_m / std::sqrt(2.0);
  CHECK_FALSE(StepOverlaps(cell_m, {disc(hall, most_m / 2), disc(hall, most_m / 2)}).are_possible());
  CHECK(StepOverlaps(cell_m, {disc(hall, 0.9), disc(hall, 0.0)}).are_possible());
  CHECK_FALSE(StepOverlaps(cell_m, {}).are_possible());
}

TEST_CASE("discs that touch are apart, discs that overlap by a hair are not") {
  const Hall hall;
  StepOverlaps touching(cell_m, {disc(hall, 0.4), disc(hall, 0.4)});
  CHECK_FALSE(touching.overlap(0, {3, 3}, 1, {4, 3}));
  CHECK(touching.overlap(0, {3, 3}, {4, 3}, 1, {4, 3}, {4, 4}));  // one leaves at a right angle
  StepOverlaps over(cell_m, {disc(hall, 0.4), disc(hall, 0.40001)});
  CHECK(over.overlap(0, {3, 3}, 1, {4, 3}));
}

TEST_CASE("robots that cannot turn on their cells have the heading of their only axis") {
  Hall hall;
  for (std::uint32_t column = 0; column < side; ++column)
    for (const std::uint32_t row : {3u, 4u}) {
      hall.edges[row * side + column] = DMRP_EDGE_E | DMRP_EDGE_W;
      hall.clearance[row * side + column] = 0.4f;
    }
  StepOverlaps long_ones(cell_m, {rectangle(hall, 1.4, 0.6), rectangle(hall, 1.4, 0.6)});
  CHECK_FALSE(long_ones.overlap(0, {3, 3}, 1, {3, 4}));                  // side by side in the corridors
  CHECK_FALSE(long_ones.overlap(0, {3, 3}, {4, 3}, 1, {4, 4}, {3, 4}));  // they pass each other
  CHECK(long_ones.overlap(0, {3, 3}, 1, {4, 3}));                        // one behind the other: 1.4 m, two cells
  CHECK(long_ones.overlap(0, {3, 5}, 1, {3, 4}));                        // the first one may turn on its cell
}

TEST_CASE("two robots that both rest are never in each other's way") {
  const Hall hall;
  std::vector<StepOverlaps::Robot> robots = {disc(hall, 0.7), disc(hall, 0.7)};
  robots[0].is_active = false;
  CHECK(StepOverlaps(cell_m, robots).overlap(0, {3, 3}, 1, {4, 3}));
  robots[1].is_active = false;
  CHECK_FALSE(StepOverlaps(cell_m, robots).overlap(0, {3, 3}, 1, {4, 3}));
}

}  // namespace step_overlaps_test
