// SPDX-License-Identifier: MIT
// body.hpp: the outline of a robot, and whether two robots overlap while each takes a step.
#pragma once

#include <dmrp/robot.h>

#include <array>
#include <cstdint>
#include <vector>

namespace dmrp::planners {

// What a robot does during a step on the 4-connected grid: a move in one of the four directions, heading ahead or back,
// or a stand. Where a robot can turn, it may have any heading while it stands, and covers the circle around its outline.
enum class Motion : std::uint8_t {
  east,
  north,
  west,
  south,
  stands_at_any_heading,
  stands_east_west,    // on a cell that it can pass along this axis only, heading either way
  stands_north_south,  // the same
};
constexpr std::size_t motion_count = 7;

struct Body {
  explicit Body(const dmrp_footprint& footprint);

  bool operator==(const Body& other) const;

  double radius_m;                            // of the disc, or of the circle around the parts
  std::vector<std::vector<dmrp_vec2>> parts;  // convex, counter-clockwise, in the robot's frame; none: a disc
};

// The way of a motion, in cells.
std::array<std::int32_t, 2> way_of(Motion motion);

// Whether the bodies overlap at some time while both move at constant speed for one step. `b_from_a` is b's position
// relative to a's at the beginning. Exact: the motion of a relative to b is a straight line, so for two polygons that
// line is clipped by the half-planes of their Minkowski difference, and for discs its distance is measured.
bool overlap_during(const Body& a, Motion a_does, const Body& b, Motion b_does, dmrp_vec2 b_from_a, double cell_m);

}  // namespace dmrp::planners
