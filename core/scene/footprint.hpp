// SPDX-License-Identifier: MIT
// footprint.hpp: the outline of a robot in its own frame: a union of convex polygons.
#pragma once

#include <span>

#include "core/scene/settings.hpp"

namespace dmrp::core {

// The radius of the smallest circle around the origin that contains all parts, m.
double circumscribed_radius(std::span<const ConvexPolygon> parts);

// The radius of the largest disc around the origin inside the union of the parts, m; 0 if the origin is not inside.
// Exact: the distance from the origin to the union's outline, which excludes edges inside other parts.
double inscribed_radius(std::span<const ConvexPolygon> parts);

// Of the footprint: the disc's radius, or that of the parts.
double inscribed_radius(const RobotSettings& robot);

// The area that a convex polygon covers while it moves by `way` without turning, itself convex.
ConvexPolygon swept(const ConvexPolygon& polygon, dmrp_vec2 way);

}  // namespace dmrp::core
