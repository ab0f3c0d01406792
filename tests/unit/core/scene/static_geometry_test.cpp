// SPDX-License-Identifier: MIT
#include "core/scene/static_geometry.hpp"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/shape_distance.hpp>

#include "tests/unit/core/sample_scenarios.hpp"
#include "tests/unit/core/scene/sampled_clearance.hpp"

namespace static_geometry_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

TEST_CASE("the nearest shape is found and named") {
  Scenario scenario = empty_scenario(10, 8);
  scenario.shapes = {box("shelf A", {2, 2}, {3, 6}), circle("pillar", {7, 4}, 0.5)};
  const StaticGeometry geometry(scenario);
  CHECK(geometry.clearance({4, 4}) == Approx(1.0));
  CHECK(geometry.shape_name(geometry.nearest({4, 4}).shape) == "shelf A");
  CHECK(geometry.clearance({6, 4}) == Approx(0.5));
  CHECK(geometry.shape_name(geometry.nearest({6, 4}).shape) == "pillar");
  CHECK(geometry.clearance({9.7, 4}) == Approx(0.3));
  CHECK(geometry.shape_name(geometry.nearest({9.7, 4}).shape) == "the border");
  CHECK(geometry.clearance({2.5, 4}) == 0.0);
  CHECK(geometry.shape_name(geometry.nearest({2.5, 4}).shape) == "shelf A");
  CHECK(geometry.clearance({-1, 4}) == 0.0);
  CHECK(geometry.disc_is_free({1, 4}, 1.0));  // touches both sides
  CHECK_FALSE(geometry.disc_is_free({1, 4}, 1.001));
  CHECK(geometry.line_of_sight({1, 1}, {9, 1}));
  CHECK_FALSE(geometry.line_of_sight({1, 4}, {4, 4}));
  CHECK_FALSE(geometry.line_of_sight({4, 4}, {9, 4}));
  CHECK(StaticGeometry(empty_scenario(4, 4)).nearest({1, 2}).clearance_m == 1.0);
}

TEST_CASE("outlines surround every shape and the world") {
  Scenario scenario = empty_scenario(10, 8);
  scenario.shapes = {box("shelf", {2, 2}, {3, 6}), circle("pillar", {7, 4}, 0.5)};
  const StaticGeometry geometry(scenario);
  REQUIRE(geometry.segments().size() == 4 + 24 + 4);
  double nearest_to_pillar = 10.0;
  for (std::size_t i = 4; i < 28; ++i)
    nearest_to_pillar = std::min(nearest_to_pillar, toolkit::distance(geometry.segments()[i], dmrp_vec2{7, 4}));
  CHECK(nearest_to_pillar == Approx(0.5));
}

TEST_CASE("distances, sweeps and sight agree with a check of every shape") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Scenario scenario = random_scenario(seed, 20.0, 60);
    const StaticGeometry geometry(scenario);
    toolkit::Stream stream(seed, "test.geometry");
    for (int i = 0; i < 200; ++i) {
      const dmrp_vec2 from = {stream.uniform(-1, 21), stream.uniform(-1, 21)};
      const dmrp_vec2 to = from + dmrp_vec2{stream.uniform(-2, 2), stream.uniform(-2, 2)};
      const double radius = stream.uniform(0.05, 0.6);
      const NearestShape nearest = geometry.nearest(from);
      CHECK(nearest.clearance_m == clearance_by_looking(geometry, from));
      if (nearest.clearance_m > 0.0 && nearest.shape != geometry.border()) {
        const SurfaceDistance surface = geometry.distance_to(nearest.shape, from);
        CHECK(surface.distance_m == Approx(nearest.clearance_m));
        CHECK(toolkit::norm(surface.outward) == Approx(1.0));
        // the surface lies that far against the normal
        const dmrp_vec2 foot = from - surface.distance_m * surface.outward;
        CHECK(std::abs(toolkit::signed_distance(geometry.sdk_shapes()[nearest.shape], foot)) < 1e-9);
      }
      const double least = clearance_along(geometry, from, to);
      if (std::abs(least - radius) > 0.01) CHECK(geometry.sweep_is_free(from, to, radius) == (least > radius));

      bool in_sight = true;
      for (const dmrp_shape& shape : geometry.sdk_shapes())
        in_sight = in_sight && toolkit::distance(shape, dmrp_segment{from, to}) > 0.0;
      CHECK(geometry.line_of_sight(from, to) == in_sight);
    }
  }
}

TEST_CASE("overlaps of discs with rotated boxes and discs agree with FCL") {
  toolkit::Stream stream(11, "test.fcl");
  int overlapping = 0;
  for (int i = 0; i < 1000; ++i) {
    Scenario scenario = empty_scenario(20, 20);
    const double angle = stream.uniform(-3.0, 3.0);
    const dmrp_vec2 half = {stream.uniform(0.1, 1.0), stream.uniform(0.1, 1.0)};
    Shape turned = box("box", -half, half);
    turned.vertices = toolkit::to_world(dmrp_pose{10, 10, angle}, turned.vertices);
    scenario.shapes = {turned, circle("disc", {10, 10}, half.x)};
    const StaticGeometry geometry(scenario);
    const dmrp_vec2 center = {10 + stream.uniform(-2, 2), 10 + stream.uniform(-2, 2)};
    const double radius = 0.25;

    fcl::Transform3d place = fcl::Transform3d::Identity();
    place.linear() = fcl::AngleAxisd(angle, fcl::Vector3d::UnitZ()).toRotationMatrix();
    place.translation() = fcl::Vector3d(10, 10, 0);
    fcl::Transform3d disc_place = fcl::Transform3d::Identity();
    disc_place.translation() = fcl::Vector3d(center.x, center.y, 0);
    const fcl::Sphered disc(radius);
    const fcl::Boxd solid_box(2 * half.x, 2 * half.y, 2.0);
    const fcl::Sphered solid_disc(half.x);
    const fcl::CollisionRequestd request;
    fcl::CollisionResultd box_result;
    fcl::CollisionResultd disc_result;
    const bool meets_box = fcl::collide(&disc, disc_place, &solid_box, place, request, box_result) > 0;
    const bool meets_disc = fcl::collide(&disc, disc_place, &solid_disc, place, request, disc_result) > 0;

    const double box_gap = geometry.distance_to(0, center).distance_m - radius;
    const double disc_gap = geometry.distance_to(1, center).distance_m - radius;
    if (std::abs(box_gap) > 1e-5) CHECK(meets_box == (box_gap < 0.0));
    if (std::abs(disc_gap) > 1e-9) CHECK(meets_disc == (disc_gap < 0.0));
    overlapping += box_gap < 0.0 ? 1 : 0;
  }
  CHECK(overlapping > 100);
  CHECK(overlapping < 900);
}

TEST_CASE("the geometry of a stored world needs shapes that it knows") {
  const std::vector<dmrp_vec2> corners = {{1, 1}, {2, 1}, {2, 2}};
  dmrp_shape shape{"arch", DMRP_SHAPE_POLYGON, 3, {}, 0.0, corners.data(), 2.0};
  dmrp_world world{};
  world.struct_size = sizeof(world);
  world.upper = {4, 4};
  world.shapes = &shape;
  world.shape_count = 1;
  world.shape_stride = sizeof(shape);
  CHECK(StaticGeometry(world).clearance({3.0, 1.5}) == 1.0);
  shape.vertex_count = 0;
  CHECK_THROWS_WITH(StaticGeometry(world), "the shape arch is neither a circle nor a polygon");
  shape.kind = 99;
  CHECK_THROWS_AS(StaticGeometry(world), std::invalid_argument);
}

}  // namespace static_geometry_test
