// SPDX-License-Identifier: MIT
#include "core/scene/footprint.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/random.hpp>

namespace footprint_test {

using namespace dmrp;
using namespace dmrp::core;

ConvexPolygon rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

bool is_inside(const std::vector<ConvexPolygon>& parts, dmrp_vec2 point) {
  return std::any_of(parts.begin(), parts.end(), [&](const auto& part) { return toolkit::contains(part, point); });
}

// The least distance, over many directions, at which a ray from the origin leaves the union.
double sampled_inscribed_radius(const std::vector<ConvexPolygon>& parts) {
  constexpr double step_m = 0.001;
  double least_m = 1e9;
  for (int i = 0; i < 720; ++i) {
    const dmrp_vec2 direction = toolkit::from_angle(i * toolkit::pi / 360.0);
    double reached_m = 0.0;
    while (is_inside(parts, direction * (reached_m + step_m))) reached_m += step_m;
    least_m = std::min(least_m, reached_m);
  }
  return least_m;
}

TEST_CASE("a rectangle's radii are half its width and half its diagonal") {
  const std::vector<ConvexPolygon> parts = {rectangle(-0.6, -0.3, 0.6, 0.3)};
  CHECK(inscribed_radius(parts) == Approx(0.3));
  CHECK(circumscribed_radius(parts) == Approx(std::hypot(0.6, 0.3)));
}

TEST_CASE("the edge that two parts share is no outline") {
  // the same rectangle in two halves, whose seam runs through the origin
  CHECK(inscribed_radius(std::vector<ConvexPolygon>{rectangle(-0.6, -0.3, 0.0, 0.3), rectangle(0.0, -0.3, 0.6, 0.3)}) ==
        Approx(0.3));
  // an L: the inner corner is the nearest outline
  CHECK(inscribed_radius(std::vector<ConvexPolygon>{rectangle(-0.5, -0.5, 0.5, 0.1), rectangle(-0.5, 0.1, 0.1, 0.5)}) ==
        Approx(std::hypot(0.1, 0.1)));
  // two parts with a common outer side: it remains outline
  CHECK(inscribed_radius(std::vector<ConvexPolygon>{rectangle(-0.5, -0.2, 0.3, 0.5),
                                                    rectangle(-0.3, -0.2, 0.5, 0.4)}) == Approx(0.2));
}

TEST_CASE("the origin outside all parts has no disc") {
  CHECK(inscribed_radius(std::vector<ConvexPolygon>{rectangle(0.1, 0.1, 0.5, 0.5)}) == 0.0);
}

TEST_CASE("inscribed radii of random unions agree with sampled rays") {
  toolkit::Stream stream(3, "test.footprint");
  for (int i = 0; i < 60; ++i) {
    std::vector<ConvexPolygon> parts;
    for (int k = 0; k < 3; ++k) {
      const dmrp_pose frame = {stream.uniform(-0.2, 0.2), stream.uniform(-0.2, 0.2), stream.uniform(-3.0, 3.0)};
      const double length_m = stream.uniform(0.3, 0.8);
      parts.push_back(toolkit::to_world(frame, rectangle(-length_m, -0.25, length_m, 0.25)));
    }
    if (!is_inside(parts, {0.0, 0.0})) continue;
    CAPTURE(i);
    CHECK(inscribed_radius(parts) == Approx(sampled_inscribed_radius(parts)).margin(0.004));
  }
}

}  // namespace footprint_test
