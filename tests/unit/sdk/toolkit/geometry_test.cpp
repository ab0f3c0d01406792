// SPDX-License-Identifier: MIT
// Angles, vectors, segments, polygons, polylines, shapes, sweeps and rays: hand-computed cases, and random ones against
// slow ways that cannot err in the same place.
#include <dmrp/path.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/disc_sweep.hpp>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/polyline.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/ray_cast.hpp>
#include <dmrp/toolkit/rectangle.hpp>
#include <dmrp/toolkit/segment.hpp>
#include <dmrp/toolkit/shape_distance.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>
#include <vector>

namespace geometry_test {

using namespace dmrp::toolkit;

const double infinity = std::numeric_limits<double>::infinity();

dmrp_vec2 random_point(Stream& stream, double half = 5.0) {
  const double x = stream.uniform(-half, half);
  return {x, stream.uniform(-half, half)};
}

dmrp_segment random_segment(Stream& stream) {
  const dmrp_vec2 from = random_point(stream);
  return {from, random_point(stream)};
}

// A convex polygon: points of a turned ellipse.
std::vector<dmrp_vec2> random_polygon(Stream& stream) {
  const dmrp_vec2 center = random_point(stream, 3.0);
  const dmrp_vec2 radii = {stream.uniform(0.3, 2.0), stream.uniform(0.3, 2.0)};
  const double turn = stream.uniform(-pi, pi);
  std::vector<dmrp_vec2> vertices = polygon_of_circle({0.0, 0.0}, 1.0, 3 + stream.below(6));
  for (dmrp_vec2& v : vertices) v = center + rotate({radii.x * v.x, radii.y * v.y}, turn);
  return vertices;
}

dmrp_shape circle_shape(dmrp_vec2 center, double radius_m) {
  dmrp_shape shape = {};
  shape.kind = DMRP_SHAPE_CIRCLE;
  shape.center = center;
  shape.radius_m = radius_m;
  return shape;
}

dmrp_shape random_circle(Stream& stream, double radius_max_m) {
  const dmrp_vec2 center = random_point(stream);
  return circle_shape(center, stream.uniform(0.1, radius_max_m));
}

dmrp_shape polygon_shape(const std::vector<dmrp_vec2>& vertices) {
  dmrp_shape shape = {};
  shape.kind = DMRP_SHAPE_POLYGON;
  shape.vertices = vertices.data();
  shape.vertex_count = static_cast<std::uint32_t>(vertices.size());
  return shape;
}

// The least of `measure` over a segment, by many samples: too large by at most half a sample's spacing.
template <class Measure>
double least_along(const dmrp_segment& segment, const Measure& measure) {
  double least = infinity;
  for (int i = 0; i <= 400; ++i) least = std::min(least, measure(lerp(segment.from, segment.to, i / 400.0)));
  return least;
}

const std::vector<dmrp_vec2> unit_square = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};

TEST_CASE("wrap keeps the direction and gives more than -pi, at most pi", "[toolkit]") {
  CHECK(wrap(0.0) == 0.0);
  CHECK(wrap(pi) == pi);
  CHECK(wrap(-pi) == pi);
  CHECK(wrap(3.0 * pi) == Approx(pi));
  CHECK(wrap(-0.5 * pi) == -0.5 * pi);
  CHECK(wrap(1.5 * pi) == Approx(-0.5 * pi));
  CHECK(wrap(2.0 * pi) == 0.0);
  CHECK(std::isnan(wrap(std::nan(""))));
  CHECK(std::isnan(wrap(infinity)));
  Stream stream(1, "wrap");
  for (int i = 0; i < 2000; ++i) {
    const double angle = stream.uniform(-100.0, 100.0);
    const double wrapped = wrap(angle);
    REQUIRE(wrapped > -pi);
    REQUIRE(wrapped <= pi);
    REQUIRE(std::cos(wrapped) == Approx(std::cos(angle)).margin(1e-12));
    REQUIRE(std::sin(wrapped) == Approx(std::sin(angle)).margin(1e-12));
  }
}

TEST_CASE("difference turns by the shorter way", "[toolkit]") {
  CHECK(difference(3.0, -3.0) == Approx(2.0 * pi - 6.0));
  CHECK(difference(-3.0, 3.0) == Approx(6.0 - 2.0 * pi));
  CHECK(difference(0.0, pi) == pi);
  CHECK(difference(1.0, 1.5) == 0.5);
}

TEST_CASE("bearing takes poses, points and waypoints", "[toolkit]") {
  const dmrp_pose pose = {1.0, 1.0, 2.0};
  dmrp_waypoint waypoint = {};
  waypoint.x = 1.0;
  waypoint.y = 3.0;
  CHECK(bearing(pose, waypoint) == Approx(0.5 * pi));
  CHECK(bearing(pose, dmrp_vec2{0.0, 1.0}) == pi);
  CHECK(bearing(dmrp_vec2{0.0, -0.0}, dmrp_vec2{-1.0, -0.0}) == pi);  // atan2 alone gives -pi here
  CHECK(bearing(pose, pose) == 0.0);
}

TEST_CASE("vectors follow the rules of the plane", "[toolkit]") {
  const dmrp_vec2 a = {3.0, 4.0};
  const dmrp_vec2 b = {-1.0, 2.0};
  CHECK(a + b == dmrp_vec2{2.0, 6.0});
  CHECK(a - b == dmrp_vec2{4.0, 2.0});
  CHECK(-a == dmrp_vec2{-3.0, -4.0});
  CHECK(2.0 * a == a / 0.5);
  CHECK(dot(a, b) == 5.0);
  CHECK(cross(a, b) == 10.0);
  CHECK(norm(a) == 5.0);
  CHECK(distance(a, b) == Approx(std::sqrt(20.0)));
  CHECK(normalized(a) == dmrp_vec2{0.6, 0.8});
  CHECK(normalized({0.0, 0.0}) == dmrp_vec2{0.0, 0.0});
  CHECK(perpendicular(a) == dmrp_vec2{-4.0, 3.0});
  CHECK(distance(rotate(a, 0.5 * pi), perpendicular(a)) < 1e-15);
  CHECK(lerp(a, b, 0.0) == a);
  CHECK(lerp(a, b, 1.0) == b);
  dmrp_vec2 c = a;
  c += b;
  c -= a;
  c *= 4.0;
  c /= 2.0;
  CHECK(c == 2.0 * b);
  const dmrp_pose frame = {1.0, 2.0, 0.5 * pi};
  CHECK(distance(to_world(frame, {2.0, 0.0}), {1.0, 4.0}) < 1e-15);
  CHECK(distance(to_local(frame, to_world(frame, b)), b) < 1e-15);
}

TEST_CASE("segments: points and crossings by hand", "[toolkit]") {
  const dmrp_segment flat = {{0.0, 0.0}, {4.0, 0.0}};
  CHECK(closest_point(flat, {1.0, 3.0}) == dmrp_vec2{1.0, 0.0});
  CHECK(closest_point(flat, {-2.0, 3.0}) == flat.from);
  CHECK(distance(flat, dmrp_vec2{7.0, 4.0}) == 5.0);
  const dmrp_segment dot_at_origin = {{0.0, 0.0}, {0.0, 0.0}};
  CHECK(distance(dot_at_origin, dmrp_vec2{3.0, 4.0}) == 5.0);

  CHECK(*intersection(flat, {{1.0, -1.0}, {1.0, 1.0}}) == dmrp_vec2{1.0, 0.0});
  CHECK(*intersection(flat, {{4.0, 0.0}, {5.0, 1.0}}) == dmrp_vec2{4.0, 0.0});  // touches at an end
  CHECK_FALSE(intersection(flat, {{1.0, 0.5}, {1.0, 1.0}}));
  CHECK_FALSE(intersection(flat, {{0.0, 1.0}, {4.0, 1.0}}));  // parallel
  CHECK_FALSE(intersection(flat, {{5.0, 0.0}, {6.0, 0.0}}));  // along one line, apart
  CHECK(*intersection(flat, {{6.0, 0.0}, {3.0, 0.0}}) == dmrp_vec2{3.0, 0.0});
  CHECK(*intersection(flat, {{4.0, 0.0}, {6.0, 0.0}}) == dmrp_vec2{4.0, 0.0});
  CHECK(*intersection(flat, {{-1.0, 0.0}, {9.0, 0.0}}) == flat.from);
  CHECK(*intersection(flat, {{2.0, 0.0}, {2.0, 0.0}}) == dmrp_vec2{2.0, 0.0});
  CHECK(intersects(dot_at_origin, flat));
  CHECK_FALSE(intersects(dot_at_origin, {{1.0, 0.0}, {2.0, 0.0}}));

  CHECK(distance(flat, dmrp_segment{{0.0, 2.0}, {4.0, 3.0}}) == 2.0);
  CHECK(distance(flat, dmrp_segment{{7.0, 4.0}, {9.0, 9.0}}) == 5.0);
  CHECK(distance(flat, dmrp_segment{{2.0, -1.0}, {2.0, 1.0}}) == 0.0);
}

TEST_CASE("segments: distances agree with sampling", "[toolkit]") {
  Stream stream(2, "segments");
  int crossing = 0;
  for (int i = 0; i < 500; ++i) {
    const dmrp_segment a = random_segment(stream);
    const dmrp_segment b = random_segment(stream);
    const double sampled = least_along(a, [&](dmrp_vec2 p) { return distance(b, p); });
    const double exact = distance(a, b);
    REQUIRE(exact <= sampled + 1e-12);
    REQUIRE(exact >= sampled - length(a) / 800.0 - 1e-12);
    REQUIRE(exact == distance(b, a));
    const auto common = intersection(a, b);
    REQUIRE(common.has_value() == (exact == 0.0));
    if (!common) continue;
    ++crossing;
    REQUIRE(distance(a, *common) < 1e-12);
    REQUIRE(distance(b, *common) < 1e-12);
  }
  CHECK(crossing > 50);
}

TEST_CASE("polygons: area, convexity, distance by hand", "[toolkit]") {
  CHECK(signed_area(unit_square) == 1.0);
  const std::vector<dmrp_vec2> clockwise(unit_square.rbegin(), unit_square.rend());
  CHECK(signed_area(clockwise) == -1.0);
  CHECK(is_convex_ccw(unit_square));
  CHECK_FALSE(is_convex_ccw(clockwise));
  CHECK(is_convex_ccw(std::vector<dmrp_vec2>{{0, 0}, {0.5, 0}, {1, 0}, {1, 1}}));        // a vertex along a side
  CHECK_FALSE(is_convex_ccw(std::vector<dmrp_vec2>{{0, 0}, {2, 0}, {2, 2}, {1, 0.5}}));  // a dent
  CHECK_FALSE(is_convex_ccw(std::vector<dmrp_vec2>{{0, 0}, {1, 0}, {1, 0}, {0, 1}}));    // a vertex twice
  CHECK_FALSE(is_convex_ccw(std::vector<dmrp_vec2>{{0, 0}, {1, 0}, {2, 0}}));            // no area
  CHECK_FALSE(is_convex_ccw(std::vector<dmrp_vec2>{{0, 0}, {1, 0}}));
  std::vector<dmrp_vec2> star = polygon_of_circle({0.0, 0.0}, 1.0, 5);
  star = {star[0], star[2], star[4], star[1], star[3]};  // turns left at every corner, but goes round twice
  CHECK_FALSE(is_convex_ccw(star));

  CHECK(contains(unit_square, {0.5, 0.5}));
  CHECK(contains(unit_square, {1.0, 0.3}));  // the border belongs to it
  CHECK_FALSE(contains(unit_square, {1.0001, 0.3}));
  CHECK(signed_distance(unit_square, {0.5, 0.9}) == Approx(-0.1));
  CHECK(signed_distance(unit_square, {4.0, 5.0}) == 5.0);
  CHECK(distance(unit_square, dmrp_vec2{0.5, 0.9}) == 0.0);
  CHECK(closest_point(unit_square, {0.4, 3.0}) == dmrp_vec2{0.4, 1.0});
  CHECK(closest_border_point(unit_square, {0.4, 0.9}) == dmrp_vec2{0.4, 1.0});
  CHECK(distance(unit_square, dmrp_segment{{0.2, 0.2}, {0.3, 0.3}}) == 0.0);   // inside
  CHECK(distance(unit_square, dmrp_segment{{-1.0, 0.5}, {2.0, 0.5}}) == 0.0);  // right through
  CHECK(distance(unit_square, dmrp_segment{{2.0, 0.0}, {2.0, 1.0}}) == 1.0);
  CHECK(distance(to_world({1.0, 1.0, 0.5 * pi}, unit_square)[1], {1.0, 2.0}) < 1e-15);
}

TEST_CASE("the polygon of a circle lies in the circle and nearly fills it", "[toolkit]") {
  const std::vector<dmrp_vec2> vertices = polygon_of_circle({2.0, -1.0}, 3.0, 16);
  CHECK(is_convex_ccw(vertices));
  for (const dmrp_vec2 v : vertices) CHECK(distance(v, {2.0, -1.0}) == Approx(3.0));
  CHECK(signed_distance(vertices, {2.0, -1.0}) == Approx(-3.0 * std::cos(pi / 16)));
  CHECK(signed_area(vertices) == Approx(0.5 * 16 * 9.0 * std::sin(2.0 * pi / 16)));
}

TEST_CASE("polygons: distances agree with sampling", "[toolkit]") {
  Stream stream(3, "polygons");
  for (int i = 0; i < 200; ++i) {
    const std::vector<dmrp_vec2> polygon = random_polygon(stream);
    REQUIRE(is_convex_ccw(polygon));
    const dmrp_vec2 point = random_point(stream);
    double border = infinity;
    bool left_of_all = true;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const dmrp_segment edge = PolygonView(polygon).edge(k);
      border = std::min(border, least_along(edge, [&](dmrp_vec2 p) { return distance(p, point); }));
      left_of_all = left_of_all && cross(edge.to - edge.from, point - edge.from) >= 0.0;
    }
    REQUIRE(contains(polygon, point) == left_of_all);
    REQUIRE(std::abs(signed_distance(polygon, point)) == Approx(border).margin(0.01));
    REQUIRE((signed_distance(polygon, point) <= 0.0) == left_of_all);

    const dmrp_segment segment = random_segment(stream);
    const double sampled = least_along(segment, [&](dmrp_vec2 p) { return distance(polygon, p); });
    REQUIRE(distance(polygon, segment) <= sampled + 1e-12);
    REQUIRE(distance(polygon, segment) >= sampled - length(segment) / 800.0 - 1e-12);
  }
}

TEST_CASE("rectangles: containment and depth", "[toolkit]") {
  const Rectangle box = {{0.0, 0.0}, {4.0, 2.0}};
  CHECK(contains(box, {4.0, 2.0}));
  CHECK_FALSE(contains(box, {4.1, 1.0}));
  CHECK(distance(box, {7.0, 6.0}) == 5.0);
  CHECK(distance(box, {1.0, 1.0}) == 0.0);
  CHECK(depth(box, {1.0, 1.5}) == 0.5);
  CHECK(depth(box, {5.0, 1.0}) == -1.0);
}

TEST_CASE("polylines: lengths and places", "[toolkit]") {
  // east 3, wait, north 4
  const std::vector<dmrp_vec2> path = {{0.0, 0.0}, {3.0, 0.0}, {3.0, 0.0}, {3.0, 4.0}};
  CHECK(length(path) == 7.0);
  const std::vector<double> arcs = arc_lengths(path);
  CHECK(arcs == std::vector<double>{0.0, 3.0, 3.0, 7.0});
  CHECK(point_at(path, arcs, 1.5) == dmrp_vec2{1.5, 0.0});
  CHECK(point_at(path, arcs, 5.0) == dmrp_vec2{3.0, 2.0});
  CHECK(point_at(path, arcs, -1.0) == path.front());
  CHECK(point_at(path, arcs, 99.0) == path.back());
  CHECK(place_at(path, arcs, 3.0).segment == 2);  // the end of the wait
  CHECK(place_at(path, arcs, 99.0).segment == 2);
  CHECK(place_at(path, arcs, 99.0).fraction == 1.0);
  CHECK(heading_at(path, arcs, 1.0, 9.0) == 0.0);
  CHECK(heading_at(path, arcs, 3.0, 9.0) == Approx(0.5 * pi));
  CHECK(heading_at(path, arcs, 7.0, 9.0) == Approx(0.5 * pi));

  const std::vector<dmrp_vec2> ends_waiting = {{0.0, 0.0}, {0.0, -2.0}, {0.0, -2.0}};
  CHECK(heading_at(ends_waiting, arc_lengths(ends_waiting), 2.0, 9.0) == Approx(-0.5 * pi));
  CHECK(point_at(ends_waiting, arc_lengths(ends_waiting), 2.0) == dmrp_vec2{0.0, -2.0});

  const std::vector<dmrp_vec2> standing = {{1.0, 2.0}, {1.0, 2.0}};
  CHECK(length(standing) == 0.0);
  CHECK(point_at(standing, arc_lengths(standing), 0.5) == dmrp_vec2{1.0, 2.0});
  CHECK(heading_at(standing, arc_lengths(standing), 0.0, 9.0) == 9.0);
  const std::vector<dmrp_vec2> single = {{1.0, 2.0}};
  CHECK(project(single, arc_lengths(single), {4.0, 6.0}).distance_m == 5.0);
  CHECK(heading_at(single, arc_lengths(single), 0.0, 9.0) == 9.0);
  CHECK(length(std::vector<dmrp_vec2>{}) == 0.0);
}

TEST_CASE("polylines: projection, windows and monotone progress", "[toolkit]") {
  const std::vector<dmrp_vec2> path = {{0.0, 0.0}, {3.0, 0.0}, {3.0, 0.0}, {3.0, 4.0}};
  const std::vector<double> arcs = arc_lengths(path);
  const PathPlace place = project(path, arcs, {5.0, 1.0});
  CHECK(place.point == dmrp_vec2{3.0, 1.0});
  CHECK(place.arc_m == 4.0);
  CHECK(place.segment == 2);
  CHECK(place.fraction == 0.25);
  CHECK(place.distance_m == 2.0);
  CHECK(project(path, arcs, {5.0, 1.0}, 0.0, 2.0).point == dmrp_vec2{2.0, 0.0});
  CHECK(project(path, arcs, {5.0, 1.0}, 6.0, 7.0).point == dmrp_vec2{3.0, 3.0});
  CHECK(project(path, arcs, {5.0, 1.0}, 5.0, 5.0).arc_m == 5.0);
  CHECK(project(path, arcs, {5.0, 1.0}, 50.0, 60.0).arc_m == 7.0);
  // On the bisector both arms are equally near: the first wins.
  CHECK(project(path, arcs, {2.0, 1.0}).arc_m == 2.0);

  // There and back again: a window keeps the robot on its own lap.
  const std::vector<dmrp_vec2> lap = {{0.0, 0.0}, {10.0, 0.0}, {0.0, 0.0}};
  const std::vector<double> lap_arcs = arc_lengths(lap);
  Stream stream(4, "progress");
  double progress_m = 0.0;
  for (int i = 0; i <= 200; ++i) {
    const double true_arc = i * 0.1;
    const double x = true_arc <= 10.0 ? true_arc : 20.0 - true_arc;
    const double before = progress_m;
    const dmrp_vec2 seen = {x + stream.uniform(-0.05, 0.05), stream.uniform(-0.2, 0.2)};
    progress_m = project(lap, lap_arcs, seen, progress_m, progress_m + 0.5).arc_m;
    REQUIRE(progress_m >= before);
    REQUIRE(progress_m == Approx(true_arc).margin(0.3));
  }
  CHECK(progress_m > 19.7);
}

TEST_CASE("polylines: projection agrees with sampling", "[toolkit]") {
  Stream stream(5, "projection");
  for (int i = 0; i < 100; ++i) {
    std::vector<dmrp_vec2> path = {random_point(stream)};
    while (path.size() < 8) path.push_back(stream.chance(0.2) ? path.back() : random_point(stream));
    const std::vector<double> arcs = arc_lengths(path);
    const dmrp_vec2 point = random_point(stream);
    const double from_m = stream.uniform(-1.0, arcs.back());
    const double to_m = from_m + stream.uniform(0.0, arcs.back());
    const PathPlace place = project(path, arcs, point, from_m, to_m);
    const double first = std::max(0.0, from_m);
    const double last = std::min(arcs.back(), to_m);
    double sampled = infinity;
    for (int k = 0; k <= 2000; ++k)
      sampled = std::min(sampled, distance(point_at(path, arcs, first + (last - first) * k / 2000.0), point));
    REQUIRE(place.distance_m <= sampled + 1e-9);
    REQUIRE(place.distance_m >= sampled - arcs.back() / 2000.0);
    REQUIRE(place.arc_m >= first);
    REQUIRE(place.arc_m <= last);
    REQUIRE(distance(point_at(path, arcs, place.arc_m), place.point) < 1e-9);
    REQUIRE(distance(place.point, point) == place.distance_m);
    const double look_ahead_m = stream.uniform(0.0, 5.0);
    const double carrot_m = project(path, arcs, point).arc_m + look_ahead_m;
    REQUIRE(distance(point_ahead(path, point, look_ahead_m), point_at(path, arcs, carrot_m)) < 1e-9);
  }
}

TEST_CASE("a carrot runs ahead on the path", "[toolkit]") {
  std::vector<dmrp_waypoint> path(3);
  path[1].x = path[2].x = 2.0;
  path[2].y = 2.0;
  CHECK(point_ahead(path, dmrp_pose{1.0, 0.5, 0.0}, 0.5) == dmrp_vec2{1.5, 0.0});
  CHECK(point_ahead(path, dmrp_pose{1.0, 0.5, 0.0}, 1.5) == dmrp_vec2{2.0, 0.5});
  CHECK(point_ahead(path, dmrp_pose{1.0, 0.5, 0.0}, 50.0) == dmrp_vec2{2.0, 2.0});
  CHECK(point_ahead(path, dmrp_pose{-1.0, 0.0, 0.0}, 0.0) == dmrp_vec2{0.0, 0.0});
  CHECK(point_ahead(std::vector<dmrp_waypoint>(1), dmrp_pose{1.0, 0.5, 0.0}, 1.0) == dmrp_vec2{0.0, 0.0});
  CHECK(point_ahead(std::vector<dmrp_waypoint>{}, dmrp_pose{1.0, 0.5, 0.0}, 1.0) == dmrp_vec2{1.0, 0.5});
}

TEST_CASE("shapes: distance, bounds, clearance", "[toolkit]") {
  const dmrp_shape pillar = circle_shape({5.0, 5.0}, 1.0);
  const dmrp_shape box = polygon_shape(unit_square);
  CHECK(signed_distance(pillar, {5.0, 5.5}) == -0.5);
  CHECK(distance(pillar, dmrp_vec2{5.0, 5.5}) == 0.0);
  CHECK(distance(pillar, dmrp_segment{{0.0, 7.0}, {9.0, 7.0}}) == 1.0);
  CHECK(distance(box, dmrp_vec2{2.0, 0.5}) == 1.0);
  CHECK(bounds(pillar).lower == dmrp_vec2{4.0, 4.0});
  CHECK(bounds(box).upper == dmrp_vec2{1.0, 1.0});
  const std::vector<dmrp_shape> shapes = {pillar, box};
  const Rectangle border = {{-2.0, -2.0}, {10.0, 10.0}};
  CHECK(clearance(shapes, border, {5.0, 8.0}) == 2.0);
  CHECK(clearance(shapes, border, {5.0, 9.0}) == 1.0);  // the border
  CHECK(clearance(shapes, border, {0.5, 1.25}) == 0.25);
  CHECK(clearance(shapes, border, {0.5, 0.5}) == 0.0);
  CHECK(clearance(shapes, border, {11.0, 0.5}) == 0.0);
}

TEST_CASE("a disc swept past a corner is judged exactly", "[toolkit]") {
  const std::vector<dmrp_shape> shapes = {polygon_shape(unit_square)};
  const Rectangle border = {{-5.0, -5.0}, {5.0, 5.0}};
  // The diagonal x + y = 3 passes the corner (1, 1) at 1 / sqrt(2).
  const dmrp_segment past = {{0.0, 3.0}, {3.0, 0.0}};
  CHECK(disc_sweep_is_clear(past, 0.7071, shapes, border));
  CHECK_FALSE(disc_sweep_is_clear(past, 0.7072, shapes, border));
  CHECK(disc_sweep_is_clear({{2.0, -1.0}, {2.0, 2.0}}, 1.0, shapes, border));        // touching is clear
  CHECK_FALSE(disc_sweep_is_clear({{4.5, 0.0}, {4.8, 0.0}}, 0.25, shapes, border));  // through the border
  CHECK(disc_sweep_is_clear({{4.5, 0.0}, {4.75, 0.0}}, 0.25, shapes, border));

  // Pressed against a side: it may leave, not go deeper, nor on to something else.
  const dmrp_vec2 pressed = {1.2, 0.5};
  CHECK_FALSE(disc_sweep_is_clear({pressed, {2.0, 0.5}}, 0.25, shapes, border));
  CHECK(disc_retreat_is_clear({pressed, {2.0, 0.5}}, 0.25, shapes, border));
  CHECK(disc_retreat_is_clear({pressed, {1.2, 3.0}}, 0.25, shapes, border));
  CHECK_FALSE(disc_retreat_is_clear({pressed, {1.1, 3.0}}, 0.25, shapes, border));
}

TEST_CASE("disc sweeps agree with stepping the disc", "[toolkit]") {
  Stream stream(6, "sweeps");
  const Rectangle border = {{-5.0, -5.0}, {5.0, 5.0}};
  int clear = 0;
  int blocked = 0;
  for (int i = 0; i < 400; ++i) {
    const std::vector<dmrp_vec2> polygon = random_polygon(stream);
    const std::vector<dmrp_shape> shapes = {polygon_shape(polygon), random_circle(stream, 1.0)};
    const dmrp_segment motion = random_segment(stream);
    const double sampled = least_along(motion, [&](dmrp_vec2 p) { return clearance(shapes, border, p); });
    const double spacing = length(motion) / 800.0 + 1e-12;
    const double radius_m = stream.uniform(0.05, 0.8);
    const bool is_clear = disc_sweep_is_clear(motion, radius_m, shapes, border);
    if (sampled >= radius_m + spacing) REQUIRE(is_clear);
    if (sampled < radius_m - 1e-12) REQUIRE_FALSE(is_clear);
    ++(is_clear ? clear : blocked);
  }
  CHECK(clear > 30);
  CHECK(blocked > 30);
}

TEST_CASE("rays: hits by hand", "[toolkit]") {
  const Ray east = {{0.0, 0.0}, {1.0, 0.0}};
  CHECK(ray_to_circle(east, {5.0, 0.0}, 2.0) == 3.0);
  CHECK(ray_to_circle(east, {5.0, 2.0}, 2.0) == 5.0);  // grazing
  CHECK(ray_to_circle(east, {5.0, 2.1}, 2.0) == infinity);
  CHECK(ray_to_circle(east, {-5.0, 0.0}, 2.0) == infinity);  // behind
  CHECK(ray_to_circle(east, {0.5, 0.0}, 2.0) == 0.0);        // from inside
  CHECK(ray_to_segment(east, {{2.0, -1.0}, {2.0, 3.0}}) == 2.0);
  CHECK(ray_to_segment(east, {{2.0, 0.0}, {3.0, 3.0}}) == 2.0);  // at its end
  CHECK(ray_to_segment(east, {{2.0, 1.0}, {2.0, 3.0}}) == infinity);
  CHECK(ray_to_segment(east, {{-2.0, -1.0}, {-2.0, 3.0}}) == infinity);
  CHECK(ray_to_segment(east, {{6.0, 0.0}, {4.0, 0.0}}) == 4.0);  // along the ray
  CHECK(ray_to_segment(east, {{-6.0, 0.0}, {4.0, 0.0}}) == 0.0);
  CHECK(ray_to_segment(east, {{-6.0, 0.0}, {-4.0, 0.0}}) == infinity);
  CHECK(ray_to_polygon({{-2.0, 0.5}, {1.0, 0.0}}, unit_square) == 2.0);
  CHECK(ray_to_polygon({{-2.0, 1.5}, {1.0, 0.0}}, unit_square) == infinity);
  CHECK(ray_to_polygon({{3.0, 0.5}, {1.0, 0.0}}, unit_square) == infinity);
  CHECK(ray_to_polygon({{0.5, 0.5}, {1.0, 0.0}}, unit_square) == 0.0);
  CHECK(ray_to_polygon({{-2.0, 0.5}, {-1.0, 0.0}}, unit_square) == infinity);
  const Rectangle border = {{-1.0, -2.0}, {3.0, 4.0}};
  CHECK(ray_to_border(east, border) == 3.0);
  CHECK(ray_to_border({{0.0, 0.0}, {0.0, -1.0}}, border) == 2.0);
  CHECK(ray_to_border({{0.0, 0.0}, {-0.6, 0.8}}, border) == Approx(1.0 / 0.6));
  CHECK(ray_to_border({{9.0, 0.0}, {1.0, 0.0}}, border) == 0.0);
}

// Sphere tracing: going on by the distance to the nearest thing never passes it.
TEST_CASE("rays agree with sphere tracing", "[toolkit]") {
  Stream stream(7, "rays");
  int hits = 0;
  for (int i = 0; i < 600; ++i) {
    const std::vector<dmrp_vec2> polygon = random_polygon(stream);
    const dmrp_segment segment = random_segment(stream);
    const dmrp_shape circle = random_circle(stream, 2.0);
    const dmrp_shape shape = i % 2 == 0 ? polygon_shape(polygon) : circle;
    const Ray ray = {random_point(stream), from_angle(stream.uniform(-pi, pi))};
    const auto trace = [&ray](const auto& body) {
      double along = 0.0;
      for (int step = 0; step < 5000 && along < 30.0; ++step) {
        const double free_way = distance(body, ray.origin + along * ray.direction);
        if (free_way < 1e-10) return along;
        along += free_way;
      }
      return infinity;
    };
    const double to_shape = ray_to_shape(ray, shape);
    const double to_segment = ray_to_segment(ray, segment);
    CAPTURE(i);
    REQUIRE(std::min(to_shape, 99.0) == Approx(std::min(trace(shape), 99.0)).margin(1e-6));
    REQUIRE(std::min(to_segment, 99.0) == Approx(std::min(trace(segment), 99.0)).margin(1e-6));
    if (to_shape < infinity) ++hits;
  }
  CHECK(hits > 50);
}

}  // namespace geometry_test
