// SPDX-License-Identifier: MIT
// sensed_bodies.hpp: the bodies of robots and people, the gaps between them, and which of them a robot senses.
#pragma once

#include <dmrp/values.h>

#include <cstdint>
#include <vector>

#include "core/world/world.hpp"

namespace dmrp::core {

// Holds a body in the world frame, which is a disc if it has no parts.
struct Body {
  dmrp_vec2 center;
  double radius_m;  // of the disc, or of the circle around `center` that contains the parts
  std::vector<ConvexPolygon> parts;
};

Body body_of(const RobotSettings& settings, const dmrp_pose& pose);

double gap_between(const Body& a, const Body& b);

// To the nearest static body; a gap of a body with parts is measured up to `at_most_m`.
double gap_to_static(const StaticGeometry& geometry, const Body& body, double at_most_m);

// Whether the robot's lidar would reach the centre of the agent: in range, in its field of view, and behind no static body.
bool senses(const World& world, std::uint32_t robot, const dmrp_agent& agent);

}  // namespace dmrp::core
