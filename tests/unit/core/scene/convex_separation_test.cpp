// SPDX-License-Identifier: MIT
#include "core/scene/convex_separation.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>

namespace convex_separation_test {

using namespace dmrp;
using namespace dmrp::core;

// Corners on an ellipse in counter-clockwise order, so convex.
ConvexPolygon random_polygon(toolkit::Stream& stream, dmrp_vec2 center) {
  const auto corners = 3 + stream.below(5);
  std::vector<double> angles;
  for (std::size_t i = 0; i < corners; ++i) angles.push_back(stream.uniform(0.0, 2.0 * toolkit::pi));
  std::sort(angles.begin(), angles.end());
  const dmrp_vec2 half = {stream.uniform(0.2, 0.8), stream.uniform(0.2, 0.8)};
  const dmrp_pose frame = {center.x, center.y, stream.uniform(-toolkit::pi, toolkit::pi)};
  ConvexPolygon polygon;
  for (const double angle : angles)
    polygon.push_back(toolkit::to_world(frame, {half.x * std::cos(angle), half.y * std::sin(angle)}));
  return polygon;
}

ConvexPolygon shifted(ConvexPolygon polygon, dmrp_vec2 way) {
  for (dmrp_vec2& corner : polygon) corner += way;
  return polygon;
}

// By crossing sides and contained corners.
bool meet(const ConvexPolygon& a, const ConvexPolygon& b) {
  const toolkit::PolygonView one(a);
  const toolkit::PolygonView two(b);
  if (toolkit::contains(one, b[0]) || toolkit::contains(two, a[0])) return true;
  for (std::size_t i = 0; i < one.size(); ++i)
    for (std::size_t k = 0; k < two.size(); ++k)
      if (toolkit::intersects(one.edge(i), two.edge(k))) return true;
  return false;
}

double least_side_distance(const ConvexPolygon& a, const ConvexPolygon& b) {
  const toolkit::PolygonView one(a);
  const toolkit::PolygonView two(b);
  double least_m = 1e9;
  for (std::size_t i = 0; i < one.size(); ++i)
    for (std::size_t k = 0; k < two.size(); ++k)
      least_m = std::min(least_m, toolkit::distance(one.edge(i), two.edge(k)));
  return least_m;
}

TEST_CASE("distances and overlaps of 10,000 random pairs agree with brute force") {
  toolkit::Stream stream(5, "test.separation");
  int overlapping = 0;
  for (int i = 0; i < 10'000; ++i) {
    const ConvexPolygon a = random_polygon(stream, {0.0, 0.0});
    const ConvexPolygon b = random_polygon(stream, {stream.uniform(-1.5, 1.5), stream.uniform(-1.5, 1.5)});
    if (!toolkit::is_convex_ccw(a) || !toolkit::is_convex_ccw(b)) continue;
    const Separation apart = separation(a, b);
    CAPTURE(i, apart.distance_m);
    REQUIRE(toolkit::norm(apart.normal) == Approx(1.0));
    REQUIRE(separation(b, a).distance_m == Approx(apart.distance_m).margin(1e-9));
    if (!meet(a, b)) {
      REQUIRE(apart.distance_m == Approx(least_side_distance(a, b)).margin(1e-9));
      // the projections on the normal are as far apart
      REQUIRE(-extent(a, b[0], -apart.normal) - extent(b, b[0], apart.normal) == Approx(apart.distance_m).margin(1e-9));
      continue;
    }
    ++overlapping;
    REQUIRE(apart.distance_m <= 0.0);
    const double depth_m = -apart.distance_m;
    REQUIRE_FALSE(meet(shifted(a, apart.normal * (depth_m + 1e-6)), b));
    // no shorter way ends the overlap
    for (int k = 0; k < 36 && depth_m > 1e-3; ++k)
      REQUIRE(meet(shifted(a, (0.99 * depth_m) * toolkit::from_angle(k * toolkit::pi / 18.0)), b));
    const dmrp_vec2 middle = middle_of_overlap(a, b);
    REQUIRE(toolkit::signed_distance(a, middle) < 1e-9);
    REQUIRE(toolkit::signed_distance(b, middle) < 1e-9);
  }
  CHECK(overlapping > 1'000);
}

TEST_CASE("a disc's distance from a polygon is that of its centre less its radius") {
  toolkit::Stream stream(6, "test.separation");
  for (int i = 0; i < 10'000; ++i) {
    const ConvexPolygon a = random_polygon(stream, {0.0, 0.0});
    if (!toolkit::is_convex_ccw(a)) continue;
    const dmrp_vec2 center = {stream.uniform(-1.5, 1.5), stream.uniform(-1.5, 1.5)};
    const double radius_m = stream.uniform(0.1, 0.4);
    const Separation apart = separation(a, center, radius_m);
    CAPTURE(i);
    REQUIRE(apart.distance_m == Approx(toolkit::signed_distance(a, center) - radius_m).margin(1e-9));
    // moved by its overlap, the polygon touches the disc
    const ConvexPolygon away = shifted(a, apart.normal * -apart.distance_m);
    if (apart.distance_m < 0.0) REQUIRE(separation(away, center, radius_m).distance_m == Approx(0.0).margin(1e-9));
  }
}

TEST_CASE("a centre on the outline is pushed out") {
  const ConvexPolygon square = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const Separation apart = separation(square, {1.0, 0.0}, 0.25);
  CHECK(apart.distance_m == Approx(-0.25));
  CHECK(apart.normal.x == Approx(-1.0));
}

}  // namespace convex_separation_test
