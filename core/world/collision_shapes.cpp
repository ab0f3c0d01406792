// SPDX-License-Identifier: MIT
#include "core/world/collision_shapes.hpp"

#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

#include "core/scene/convex_separation.hpp"
#include "core/scene/touching.hpp"

namespace dmrp::core {
namespace {

Eigen::Isometry3d placed(const ConvexPart& part) {
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.translation() << part.position.x, part.position.y, 0.0;
  if (part.theta != 0.0)
    transform.linear() = Eigen::AngleAxisd(part.theta, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return transform;
}

dmrp_vec2 in_plane(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y()};
}

// Leaves the point out: FCL's own is not in the middle.
std::optional<PartOverlap> collide(const fcl::CollisionGeometryd& a, const Eigen::Isometry3d& at_a,
                                   const fcl::CollisionGeometryd& b, const Eigen::Isometry3d& at_b) {
  fcl::CollisionResultd result;
  if (fcl::collide(&a, at_a, &b, at_b, fcl::CollisionRequestd(1, true), result) == 0) return std::nullopt;
  const fcl::Contactd& contact = result.getContact(0);
  return PartOverlap{contact.penetration_depth, {}, -in_plane(contact.normal)};
}

// The middle of the overlap of a disc with something on the other side of its centre than `normal`.
dmrp_vec2 middle(const ConvexPart& disc, double depth_m, dmrp_vec2 normal) {
  return disc.position - normal * (disc.radius_m - 0.5 * depth_m);
}

std::optional<PartOverlap> overlap_of_discs(const ConvexPart& a, const ConvexPart& b) {
  auto found = collide(fcl::Sphered(a.radius_m), placed(a), fcl::Sphered(b.radius_m), placed(b));
  if (!found) return found;
  if (a.position == b.position) found->normal = {1.0, 0.0};
  found->point = middle(a, found->depth_m, found->normal);
  return found;
}

std::optional<PartOverlap> overlap_of_polygons(const ConvexPart& a, const ConvexPart& b) {
  if (!collide(*a.prism, placed(a), *b.prism, placed(b))) return std::nullopt;
  const Separation apart = separation(a.polygon, b.polygon);
  if (apart.distance_m >= -touching_m) return std::nullopt;
  return PartOverlap{-apart.distance_m, middle_of_overlap(a.polygon, b.polygon), apart.normal};
}

std::optional<PartOverlap> overlap_of_disc(const ConvexPart& disc, const ConvexPart& polygon) {
  const fcl::Sphered center(0.0);
  fcl::DistanceRequestd request(true);
  request.distance_tolerance = touching_m;
  fcl::DistanceResultd result;
  const double distance_m = fcl::distance(&center, placed(disc), polygon.prism.get(), placed(polygon), request, result);
  if (distance_m > disc.radius_m) return std::nullopt;
  double depth_m = disc.radius_m - distance_m;
  dmrp_vec2 normal = (disc.position - in_plane(result.nearest_points[1])) / distance_m;
  if (distance_m <= touching_m) {  // the centre lies in the polygon: FCL does not say how deep
    const Separation apart = separation(polygon.polygon, disc.position, disc.radius_m);
    depth_m = -apart.distance_m;
    normal = -apart.normal;
  }
  return PartOverlap{depth_m, middle(disc, depth_m, normal), normal};
}

}  // namespace

std::shared_ptr<const fcl::Convexd> make_prism(const ConvexPolygon& polygon) {
  assert(polygon.size() >= 3);
  double width_m = 0.0;
  for (const dmrp_vec2 vertex : polygon) width_m = std::max(width_m, toolkit::distance(polygon[0], vertex));
  // FCL's GJK stops early when the next support point is as far away as the nearest point so far. Heights in an
  // irrational ratio keep the corners of shapes on a lattice from being as far away as each other.
  const double root = std::sqrt(5.0);
  const auto vertices = std::make_shared<std::vector<Eigen::Vector3d>>();
  for (const double height_m : {(root - 3.0) * width_m, (root - 1.0) * width_m})
    for (const dmrp_vec2 vertex : polygon) vertices->emplace_back(vertex.x, vertex.y, height_m);

  // faces: a count, then as many vertices, counter-clockwise as seen from outside
  const int count = static_cast<int>(polygon.size());
  const auto faces = std::make_shared<std::vector<int>>();
  faces->push_back(count);
  for (int i = 0; i < count; ++i) faces->push_back(count - 1 - i);
  faces->push_back(count);
  for (int i = 0; i < count; ++i) faces->push_back(count + i);
  for (int i = 0, before = count - 1; i < count; before = i++)
    faces->insert(faces->end(), {4, before, i, count + i, count + before});
  return std::make_shared<fcl::Convexd>(vertices, count + 2, faces);
}

std::optional<PartOverlap> overlap(const ConvexPart& a, const ConvexPart& b) {
  if (a.is_disc()) return b.is_disc() ? overlap_of_discs(a, b) : overlap_of_disc(a, b);
  if (!b.is_disc()) return overlap_of_polygons(a, b);
  auto found = overlap_of_disc(b, a);
  if (found) found->normal = -found->normal;
  return found;
}

std::optional<PartOverlap> overlap_with_half_plane(const ConvexPart& part, dmrp_vec2 outward, double offset_m) {
  const fcl::Halfspaced half_space({outward.x, outward.y, 0.0}, offset_m);
  const auto here = Eigen::Isometry3d::Identity();
  auto found = part.is_disc() ? collide(fcl::Sphered(part.radius_m), placed(part), half_space, here)
                              : collide(*part.prism, placed(part), half_space, here);
  if (!found) return found;
  const auto deepest = std::min_element(part.polygon.begin(), part.polygon.end(), [&](dmrp_vec2 one, dmrp_vec2 other) {
    return toolkit::dot(one, outward) < toolkit::dot(other, outward);
  });
  found->point = part.is_disc() ? middle(part, found->depth_m, outward) : *deepest + 0.5 * found->depth_m * outward;
  return found;
}

}  // namespace dmrp::core
