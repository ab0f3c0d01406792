// SPDX-License-Identifier: MIT
#include "core/sensors/lidar.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/ray_cast.hpp>
#include <limits>
#include <numbers>

#include "tests/unit/core/sample_scenarios.hpp"

namespace lidar_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

constexpr double pi = std::numbers::pi;
constexpr float nothing = std::numeric_limits<float>::infinity();

std::vector<float> scan_once(const LidarSettings& settings, const Scenario& scenario, const dmrp_pose& sensor,
                             const std::vector<Disc>& bodies = {}) {
  Lidar lidar(settings, geometry_of(scenario));
  std::vector<float> ranges(lidar.beams());
  lidar.scan(sensor, bodies, {}, ranges);
  return ranges;
}

TEST_CASE("a scan measures walls, discs and the border") {
  Scenario scenario = empty_scenario(30, 12);
  scenario.shapes = {box("wall", {8, 0}, {9, 12}), circle("pillar", {5, 9}, 0.5)};
  LidarSettings settings;
  settings.beams = 8;  // from straight behind, counter-clockwise: W, SW, S, SE, E, NE, N, NW
  const std::vector<float> ranges = scan_once(settings, scenario, {5, 6, 0}, {{{5, 4}, 0.3}});
  CHECK(ranges[0] == Approx(5.0));
  CHECK(ranges[1] == Approx(5.0 * std::sqrt(2.0)));
  CHECK(ranges[2] == Approx(1.7));
  CHECK(ranges[4] == Approx(3.0));
  CHECK(ranges[6] == Approx(2.5));
  // turned by a quarter the first beam points south
  CHECK(scan_once(settings, scenario, {5, 6, 0.5 * pi}, {{{5, 4}, 0.3}})[0] == Approx(1.7));
}

TEST_CASE("hits out of range are infinite, and nearer hits get the least range") {
  Scenario scenario = empty_scenario(50, 50);
  scenario.shapes = {box("post", {25.1, 24.9}, {25.3, 25.1})};
  LidarSettings settings;
  settings.beams = 4;
  settings.range_min_m = 0.2;
  const std::vector<float> ranges = scan_once(settings, scenario, {25, 25, 0});
  CHECK(ranges[0] == nothing);
  CHECK(ranges[2] == Approx(0.2));
}

TEST_CASE("a partial field of view has a beam at both ends") {
  LidarSettings settings;
  settings.beams = 3;
  settings.field_of_view_rad = pi;
  Scenario scenario = empty_scenario(12, 8);
  Lidar lidar(settings, geometry_of(scenario));
  std::vector<float> ranges(3);
  lidar.scan({4, 3, 0}, {}, {}, ranges);
  CHECK(ranges[0] == Approx(3.0));
  CHECK(ranges[1] == Approx(8.0));
  CHECK(ranges[2] == Approx(5.0));
  const dmrp_scan scan = lidar.describe(77, ranges);
  CHECK(scan.t_ns == 77);
  CHECK(scan.count == 3);
  CHECK(scan.angle_min == Approx(-0.5 * pi));
  CHECK(scan.angle_increment == Approx(0.5 * pi));
  CHECK(scan.ranges == ranges.data());
}

TEST_CASE("scans agree with casting every beam at every body") {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Scenario scenario = random_scenario(seed, 16.0, 40);
    const auto geometry = geometry_of(scenario);
    toolkit::Stream stream(seed, "test.lidar");
    LidarSettings settings;
    settings.beams = seed % 2 == 0 ? 360 : 97;
    settings.field_of_view_rad = seed % 3 == 0 ? 4.0 : 2.0 * pi;
    settings.range_max_m = stream.uniform(2.0, 12.0);
    Lidar lidar(settings, geometry);
    std::vector<float> ranges(lidar.beams());
    for (int i = 0; i < 20; ++i) {
      // now and then inside a shape or outside the world
      const dmrp_pose sensor = {stream.uniform(-0.5, 16), stream.uniform(-0.5, 16), stream.uniform(-pi, pi)};
      std::vector<Disc> bodies;
      for (int body = 0; body < 5; ++body)
        bodies.push_back({{stream.uniform(0, 16), stream.uniform(0, 16)}, stream.uniform(0.2, 0.5)});
      lidar.scan(sensor, bodies, {}, ranges);
      const dmrp_scan scan = lidar.describe(0, ranges);
      int wrong = 0;
      for (std::uint32_t beam = 0; beam < scan.count; ++beam) {
        const double heading = sensor.theta + scan.angle_min + beam * scan.angle_increment;
        const toolkit::Ray ray = {toolkit::position(sensor), toolkit::from_angle(heading)};
        double nearest = toolkit::ray_to_border(ray, geometry->rectangle());
        for (const dmrp_shape& shape : geometry->sdk_shapes())
          nearest = std::min(nearest, toolkit::ray_to_shape(ray, shape));
        for (const Disc& body : bodies)
          nearest = std::min(nearest, toolkit::ray_to_circle(ray, body.center, body.radius_m));
        const double measured = static_cast<double>(ranges[beam]);
        const bool agrees = nearest > settings.range_max_m ? std::isinf(measured)
                                                           : std::abs(measured - nearest) < 1e-5 * (1.0 + nearest);
        if (!agrees) ++wrong;
      }
      INFO("seed " << seed << " scan " << i);
      // a beam that grazes a corner may pass on either side of it
      CHECK(wrong <= 1);
    }
  }
}

TEST_CASE("scans of polygons agree with brute-force rays, 10,000 beams") {
  toolkit::Stream stream(11, "test.lidar");
  LidarSettings settings;
  settings.beams = 100;
  Scenario scenario = empty_scenario(20, 20);
  scenario.shapes = {box("block", {4, 4}, {6, 5}), circle("pillar", {14, 13}, 0.7)};
  Lidar lidar(settings, geometry_of(scenario));
  std::vector<float> ranges(lidar.beams());
  for (int scan = 0; scan < 100; ++scan) {
    const dmrp_pose sensor = {stream.uniform(7.0, 12.0), stream.uniform(6.0, 12.0), stream.uniform(-pi, pi)};
    std::vector<ConvexPolygon> polygons;
    for (int i = 0; i < 6; ++i) {
      const dmrp_pose frame = {stream.uniform(1.0, 19.0), stream.uniform(1.0, 19.0), stream.uniform(-pi, pi)};
      polygons.push_back(
          toolkit::to_world(frame, std::vector<dmrp_vec2>{{-0.6, -0.3}, {0.6, -0.3}, {0.5, 0.3}, {-0.2, 0.5}}));
    }
    lidar.scan(sensor, {}, polygons, ranges);
    std::vector<float> without(lidar.beams());
    lidar.scan(sensor, {}, {}, without);
    for (std::uint32_t beam = 0; beam < lidar.beams(); ++beam) {
      const double angle = sensor.theta - pi + beam * 2.0 * pi / lidar.beams();
      const dmrp_segment ray = {{sensor.x, sensor.y},
                                dmrp_vec2{sensor.x, sensor.y} + 10.0 * toolkit::from_angle(angle)};
      double nearest_m = without[beam];
      for (const ConvexPolygon& polygon : polygons) {
        if (toolkit::contains(polygon, ray.from)) nearest_m = 0.0;
        for (std::size_t side = 0; side < polygon.size(); ++side)
          if (const auto hit = toolkit::intersection(ray, toolkit::PolygonView(polygon).edge(side)))
            nearest_m = std::min(nearest_m, toolkit::distance(*hit, ray.from));
      }
      CAPTURE(scan, beam);
      if (nearest_m > 0.0 && std::isfinite(nearest_m)) REQUIRE(ranges[beam] == Approx(nearest_m).margin(1e-5));
    }
  }
}

}  // namespace lidar_test
