// SPDX-License-Identifier: MIT
// collision_shapes.hpp: convex parts of bodies as shapes of FCL, and how deep two of them overlap. Includes FCL, so no
// other header includes it.
//
// FCL works in space: a disc is a sphere around a point of the plane, a convex polygon a prism through the plane. FCL
// decides whether two overlap. Rules for its queries, each from a comparison with closed forms (docs/measured/collision.md):
//
// - A prism is twice as high as wide: the shortest way out of an overlap never leads up or down, and the bounding box
//   of a turned prism, a cube around its bounding sphere, stays small. The plane does not cut it in the middle: GJK
//   would be wrong for one point of twenty, by up to 0.6 m.
// - Sphere and sphere, and any shape and a half-space: collide(), which is a closed form.
// - Disc and prism: unsigned distance() from the disc's centre (a sphere of radius 0), which is GJK by libccd and exact
//   with a tolerance of 1e-9. With 1e-6, FCL's default, or with a sphere of the disc's radius it is not.
// - Prism and prism: collide(), which is MPR by libccd. It is right about overlaps as deep as bodies can have, but its
//   depth is not always the least one: separation() measures that.
// - The order is fixed: the disc first, else the lower index. GJK and MPR of swapped arguments differ in the last bits.
// - Never: signed distance (its assertions end the process), the independent GJK solver (wrong for one pair of ten),
//   continuous collision (misses one of ten), collide() of a sphere or a cylinder with a prism (misses overlaps).
#pragma once

#include <dmrp/values.h>
#include <fcl/geometry/shape/convex.h>

#include <dmrp/toolkit/rectangle.hpp>
#include <memory>
#include <optional>

#include "core/scene/settings.hpp"

namespace dmrp::core {

// A disc, or a convex polygon; at a place in the world.
struct ConvexPart {
  dmrp_vec2 position{};
  double theta = 0.0;
  double radius_m = 0.0;                        // of a disc
  ConvexPolygon polygon{};                      // in the world; empty: a disc
  std::shared_ptr<const fcl::Convexd> prism{};  // of the polygon, in the frame of position and theta
  toolkit::Rectangle bounds{};

  bool is_disc() const { return polygon.empty(); }
};

// How deep part a lies in part b.
struct PartOverlap {
  double depth_m = 0.0;
  dmrp_vec2 point{};   // in the middle of the overlap
  dmrp_vec2 normal{};  // unit, from b toward a
};

std::shared_ptr<const fcl::Convexd> make_prism(const ConvexPolygon& polygon);

// None if they are apart. Polygons need their prisms.
std::optional<PartOverlap> overlap(const ConvexPart& a, const ConvexPart& b);

// The other part is the half-plane of the points p with dot(p, outward) <= offset_m; `outward` is a unit vector.
std::optional<PartOverlap> overlap_with_half_plane(const ConvexPart& part, dmrp_vec2 outward, double offset_m);

}  // namespace dmrp::core
