// SPDX-License-Identifier: MIT
// The planners' rule of overlap against outlines that move in small pieces of time.
#include "planners/large_agents/body.hpp"

#include <catch2/catch.hpp>

#include "tests/support/draws.hpp"
#include "tests/unit/planners/large_agents/outlines.hpp"
#include "tests/unit/planners/random.hpp"

namespace body_test {

using namespace dmrp::test;
using dmrp::planners::Body;
using dmrp::planners::Motion;

// A disc, or a polygon of three to six corners on the circle, around a centre that is not the middle.
CaseRobot random_robot(Random& random) {
  CaseRobot robot;
  robot.radius_m = 0.1 + 0.001 * random.below(800);
  if (random.one_in(3)) return robot;
  const int corners = 3 + random.below(4);
  const double first = 0.01 * random.below(600);
  for (int i = 0; i < corners; ++i) {
    const double angle = first + (i + 0.004 * random.below(100)) * 6.283185307179586 / corners;
    robot.outline.push_back({robot.radius_m * std::cos(angle), 0.6 * robot.radius_m * std::sin(angle)});
  }
  return robot;
}

Body body_of(const CaseRobot& robot) {
  const dmrp_polygon part{robot.outline.data(), static_cast<uint32_t>(robot.outline.size()), 0};
  dmrp_footprint footprint{};
  footprint.part_count = robot.outline.empty() ? 0 : 1;
  footprint.radius_m = robot.radius_m;
  footprint.parts = &part;
  footprint.part_stride = sizeof(part);
  return Body(footprint);
}

TEST_CASE("bodies overlap during a step as their outlines do", "[large_agents]") {
  constexpr double grazing_m = 1e-3;  // between two pieces of time
  constexpr Motion motions[] = {Motion::east, Motion::north, Motion::west, Motion::south,
                                Motion::stands_at_any_heading};
  constexpr CellXY ways[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {0, 0}};
  Random random(5);
  int overlaps = 0;
  int apart = 0;
  for (int round = 0; round < draws(2000); ++round) {
    const CaseRobot a = random_robot(random);
    const CaseRobot b = random_robot(random);
    const int of_a = random.below(5);
    const int of_b = random.below(5);
    const CellXY offset{random.below(7) - 3, random.below(7) - 3};
    const CellXY to_b{offset.x + ways[of_b].x, offset.y + ways[of_b].y};
    // without the ends, at which the robots may have any heading
    double depth = -1e9;
    for (int i = 0; i <= 200; ++i)
      for (const Outline& one : outlines_of(a, {0, 0}, ways[of_a]))
        for (const Outline& two : outlines_of(b, offset, to_b)) {
          const double share = i / 200.0;
          const dmrp_vec2 at_a{0.5 * share * ways[of_a].x, 0.5 * share * ways[of_a].y};
          const dmrp_vec2 at_b{0.5 * (offset.x + share * ways[of_b].x), 0.5 * (offset.y + share * ways[of_b].y)};
          depth = std::max(depth, overlap_depth(one, at_a, two, at_b));
        }
    const bool found = dmrp::planners::overlap_during(body_of(a), motions[of_a], body_of(b), motions[of_b],
                                                      {0.5 * offset.x, 0.5 * offset.y}, 0.5);
    CAPTURE(round, depth);
    if (depth > 1e-6) REQUIRE(found);
    if (depth < -grazing_m) REQUIRE(!found);
    ++(found ? overlaps : apart);
  }
  CHECK(overlaps > draws(250));
  CHECK(apart > draws(250));
}

}  // namespace body_test
