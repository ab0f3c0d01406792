// SPDX-License-Identifier: MIT
// FCL's answers about convex parts against closed forms. Each pair is built so that its gap is known without computing a
// distance: part b lies beyond a line along an edge, or a tangent, of part a, and touches a line parallel to it.
#include "core/world/collision_shapes.hpp"

#include <dlfcn.h>
#include <fcl/narrowphase/detail/convexity_based_algorithm/support.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/random.hpp>

#include "core/scene/convex_separation.hpp"
#include "tests/support/draws.hpp"

namespace collision_shapes_test {

using namespace dmrp;
using namespace dmrp::core;

// This program's __ccdSupport takes the place of libccd's.
bool ccd_is_stubbed = false;
long ccd_calls = 0;

constexpr std::array gaps_m = {0.3, 1e-2, 1e-3, 1e-5, 1e-7, 1e-9, -1e-9, -1e-5, -1e-3, -1.5e-3, -0.03};

ConvexPart disc_at(dmrp_vec2 center, double radius_m) {
  ConvexPart part;
  part.position = center;
  part.radius_m = radius_m;
  return part;
}

// The polygon, given about the origin, at a pose. Static shapes are given in the world: `in_world`.
ConvexPart polygon_at(const dmrp_pose& pose, const ConvexPolygon& local, bool in_world) {
  ConvexPart part;
  part.polygon = toolkit::to_world(pose, local);
  if (!in_world) {
    part.position = toolkit::position(pose);
    part.theta = pose.theta;
  }
  part.prism = make_prism(in_world ? part.polygon : local);
  return part;
}

// Up to eight corners on a circle; or a rectangle, thin ones too.
ConvexPolygon draw_polygon(toolkit::Stream& stream) {
  if (stream.chance(0.5)) {
    const dmrp_vec2 half = {stream.uniform(0.05, 1.0), stream.uniform(0.05, 1.0)};
    return {{-half.x, -half.y}, {half.x, -half.y}, half, {-half.x, half.y}};
  }
  return toolkit::polygon_of_circle({0.0, 0.0}, stream.uniform(0.2, 0.8), 3 + stream.below(6));
}

// Anywhere with any heading, or on a lattice of 5 cm with headings along the axes.
dmrp_pose draw_pose(toolkit::Stream& stream, bool on_lattice) {
  if (!on_lattice) return {stream.uniform(0.0, 40.0), stream.uniform(0.0, 40.0), stream.uniform(-3.1, 3.1)};
  return {0.05 * static_cast<double>(stream.below(800)), 0.05 * static_cast<double>(stream.below(800)),
          0.5 * toolkit::pi * static_cast<double>(stream.below(4))};
}

// A point of the border of a polygon, on an edge or at a corner, and a direction out of the polygon there.
struct BorderPoint {
  dmrp_vec2 point;
  dmrp_vec2 outward;
};
BorderPoint draw_border_point(toolkit::Stream& stream, toolkit::PolygonView polygon, bool at_corner) {
  const std::size_t i = stream.below(polygon.size());
  const auto outward = [&](std::size_t edge) {
    return -toolkit::perpendicular(toolkit::normalized(polygon.edge(edge).to - polygon.edge(edge).from));
  };
  if (!at_corner) {
    const dmrp_segment edge = polygon.edge(i);
    return {edge.from + stream.uniform(0.3, 0.7) * (edge.to - edge.from), outward(i)};
  }
  // between the normals of the two edges that meet there
  const dmrp_vec2 before = outward(i == 0 ? polygon.size() - 1 : i - 1);
  return {polygon[i], toolkit::normalized(before + stream.uniform(0.2, 5.0) * outward(i))};
}

// Both orders of arguments find an overlap of this depth, whose normal points from b toward a; or none if it is a gap.
void check_pair(const ConvexPart& a, const ConvexPart& b, double gap_m, dmrp_vec2 toward_a) {
  const auto found = overlap(a, b);
  const auto swapped = overlap(b, a);
  CAPTURE(gap_m, a.polygon.size(), b.polygon.size());
  REQUIRE(found.has_value() == (gap_m < 0.0));
  REQUIRE(swapped.has_value() == found.has_value());
  if (!found) return;
  REQUIRE(found->depth_m == Approx(-gap_m).margin(1e-9));
  REQUIRE(swapped->depth_m == Approx(-gap_m).margin(1e-9));
  REQUIRE(toolkit::distance(found->normal, toward_a) < 1e-6);
  REQUIRE(toolkit::distance(swapped->normal, -toward_a) < 1e-6);
  REQUIRE(toolkit::distance(found->point, swapped->point) < 1e-9);
}

extern "C" void __ccdSupport(const void* one, const void* two, const ccd_vec3_t* direction, const ccd_t* ccd,
                             ccd_support_t* support) {
  static const auto real = reinterpret_cast<decltype(&__ccdSupport)>(dlsym(RTLD_NEXT, "__ccdSupport"));
  ++ccd_calls;
  if (ccd_is_stubbed)
    *support = {{{1.0, 0.0, 0.0}}, {{1.0, 0.0, 0.0}}, {{0.0, 0.0, 0.0}}};
  else
    real(one, two, direction, ccd, support);
}

TEST_CASE("discs overlap as deep as their closed form says") {
  toolkit::Stream stream(1, "test.collision_shapes");
  for (int i = 0; i < dmrp::test::draws(2000); ++i) {
    const dmrp_pose at = draw_pose(stream, i % 2 == 0);
    const ConvexPart a = disc_at(toolkit::position(at), stream.uniform(0.1, 1.0));
    const dmrp_vec2 way = toolkit::from_angle(at.theta);
    for (const double gap_m : gaps_m) {
      const double radius_m = stream.uniform(0.1, 1.0);
      check_pair(a, disc_at(a.position + way * (a.radius_m + radius_m + gap_m), radius_m), gap_m, -way);
    }
  }
  const ConvexPart a = disc_at({1.0, 2.0}, 0.5);
  const auto same_centre = overlap(a, disc_at({1.0, 2.0}, 0.25));
  REQUIRE(same_centre.has_value());
  CHECK(same_centre->depth_m == 0.75);
  CHECK(toolkit::norm(same_centre->normal) == 1.0);
}

TEST_CASE("discs beside edges and corners overlap as deep as their closed form says") {
  toolkit::Stream stream(2, "test.collision_shapes");
  for (int i = 0; i < dmrp::test::draws(2000); ++i) {
    const ConvexPart polygon = polygon_at(draw_pose(stream, i % 2 == 0), draw_polygon(stream), i % 4 < 2);
    for (const double gap_m : gaps_m) {
      const BorderPoint border = draw_border_point(stream, polygon.polygon, stream.chance(0.5));
      const double radius_m = stream.uniform(0.1, 0.5);
      const ConvexPart disc = disc_at(border.point + border.outward * (radius_m + gap_m), radius_m);
      check_pair(disc, polygon, gap_m, border.outward);
    }
  }
}

TEST_CASE("a disc whose centre lies in a polygon is deeper than its radius") {
  const ConvexPart block = polygon_at({3.0, 2.0, 0.0}, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, true);
  for (const double inside_m : {0.0, 1e-10, 0.1, 0.5}) {
    CAPTURE(inside_m);
    check_pair(disc_at({4.0 - inside_m, 2.25}, 0.25), block, -0.25 - inside_m, {1.0, 0.0});
  }
}

TEST_CASE("polygons overlap as deep as their closed form says, parallel faces too") {
  toolkit::Stream stream(3, "test.collision_shapes");
  for (int i = 0; i < dmrp::test::draws(2000); ++i) {
    const ConvexPart a = polygon_at(draw_pose(stream, i % 2 == 0), draw_polygon(stream), i % 4 < 2);
    for (const double gap_m : gaps_m) {
      if (gap_m < 0.0 && gap_m > -1e-3) continue;  // not deep enough to be a contact: MPR may miss them
      // b lies with a corner, or with a whole edge, on a line beside an edge of a
      const BorderPoint border = draw_border_point(stream, a.polygon, false);
      const ConvexPolygon local = toolkit::polygon_of_circle({0.0, 0.0}, stream.uniform(0.3, 0.6), 3 + stream.below(6));
      const double half_angle = toolkit::pi / static_cast<double>(local.size());
      const double theta = std::atan2(-border.outward.y, -border.outward.x) +
                           half_angle * (stream.chance(0.5) ? 1.0 : stream.uniform(-0.8, 0.8));
      const ConvexPolygon turned = toolkit::to_world({0.0, 0.0, theta}, local);
      const dmrp_vec2 corner = *std::min_element(turned.begin(), turned.end(), [&](dmrp_vec2 one, dmrp_vec2 other) {
        return toolkit::dot(one, border.outward) < toolkit::dot(other, border.outward);
      });
      const dmrp_vec2 place = border.point + border.outward * gap_m - corner;
      check_pair(a, polygon_at({place.x, place.y, theta}, local, false), gap_m, -border.outward);
    }
  }
}

TEST_CASE("half-planes overlap as deep as their closed form says") {
  toolkit::Stream stream(4, "test.collision_shapes");
  for (int i = 0; i < dmrp::test::draws(500); ++i) {
    const dmrp_vec2 outward = toolkit::from_angle(draw_pose(stream, i % 2 == 0).theta);
    const double offset_m = stream.uniform(-10.0, 10.0);
    for (const double gap_m : gaps_m) {
      const double radius_m = stream.uniform(0.1, 0.5);
      const dmrp_vec2 along = toolkit::perpendicular(outward) * stream.uniform(-10.0, 10.0);
      const dmrp_pose pose = draw_pose(stream, false);
      const ConvexPolygon local = draw_polygon(stream);
      const double reach_m = extent(toolkit::to_world({0.0, 0.0, pose.theta}, local), {0.0, 0.0}, -outward);
      const dmrp_vec2 disc = along + outward * (offset_m + radius_m + gap_m);
      const dmrp_vec2 polygon = along + outward * (offset_m + reach_m + gap_m);
      for (const ConvexPart& part :
           {disc_at(disc, radius_m), polygon_at({polygon.x, polygon.y, pose.theta}, local, false)}) {
        const auto found = overlap_with_half_plane(part, outward, offset_m);
        REQUIRE(found.has_value() == (gap_m < 0.0));
        if (!found) continue;
        REQUIRE(found->depth_m == Approx(-gap_m).margin(1e-9));
        REQUIRE(toolkit::distance(found->normal, outward) < 1e-12);
        REQUIRE(toolkit::dot(found->point, outward) == Approx(offset_m + 0.5 * gap_m).margin(1e-9));
      }
    }
  }
}

TEST_CASE("libccd decides whether a disc touches a prism") {
  const ConvexPart block = polygon_at({3.0, 2.0, 0.5}, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, false);
  const ConvexPart disc = disc_at({3.0 + 1.2 * std::cos(0.5), 2.0 + 1.2 * std::sin(0.5)}, 0.25);
  ccd_calls = 0;
  CHECK(overlap(disc, block).has_value());
  CHECK(ccd_calls > 0);
  ccd_is_stubbed = true;
  const auto without = overlap(disc, block);
  ccd_is_stubbed = false;
  CHECK_FALSE(without.has_value());
}

}  // namespace collision_shapes_test
