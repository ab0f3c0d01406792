// SPDX-License-Identifier: MIT
// convex_separation.hpp: exact distances and overlaps of convex bodies in the plane.
#pragma once

#include <dmrp/toolkit/polygon.hpp>

#include "core/scene/settings.hpp"

namespace dmrp::core {

// How far two convex bodies are apart.
struct Separation {
  double distance_m = 0.0;  // negative: the least distance by which one must move to end their overlap
  dmrp_vec2 normal{};       // unit, from b toward a: the bodies' projections on it are distance_m apart
};

// For polygons that overlap, the axis of least overlap (separating axis theorem); otherwise that of the nearest points.
Separation separation(toolkit::PolygonView a, toolkit::PolygonView b);
Separation separation(toolkit::PolygonView a, dmrp_vec2 center, double radius_m);  // b: a disc

// The middle of the overlap of two polygons that overlap by more than touching_m.
dmrp_vec2 middle_of_overlap(toolkit::PolygonView a, toolkit::PolygonView b);

// The farthest extent of the polygon in a direction, relative to `from`.
double extent(toolkit::PolygonView polygon, dmrp_vec2 from, dmrp_vec2 direction);

}  // namespace dmrp::core
