// SPDX-License-Identifier: MIT
// Shortest ways: cases computed by hand, and a visibility graph of many points among random shapes.
#include "metrics/outcome/shortest_way.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <deque>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/disc_sweep.hpp>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/shape_distance.hpp>
#include <vector>

#include "tests/support/draws.hpp"

namespace shortest_way_test {

using namespace dmrp;
using Catch::Matchers::WithinAbs;
using toolkit::pi;

constexpr double radius_m = 0.25;

// A world of 10 m x 10 m from (0, 0).
class Scene {
 public:
  Scene& size(double width_m, double depth_m) {
    upper_ = {width_m, depth_m};
    return *this;
  }
  Scene& circle(Vec2 center, double circle_radius_m) {
    Shape shape{};
    shape.kind = DMRP_SHAPE_CIRCLE;
    shape.center = center;
    shape.radius_m = circle_radius_m;
    shapes_.push_back(shape);
    return *this;
  }
  Scene& polygon(std::vector<Vec2> vertices) {
    outlines_.push_back(std::move(vertices));
    Shape shape{};
    shape.kind = DMRP_SHAPE_POLYGON;
    shape.vertices = outlines_.back().data();
    shape.vertex_count = static_cast<std::uint32_t>(outlines_.back().size());
    shapes_.push_back(shape);
    return *this;
  }
  Scene& box(Vec2 lower, Vec2 upper) { return polygon({lower, {upper.x, lower.y}, upper, {lower.x, upper.y}}); }

  const std::vector<Shape>& shapes() const { return shapes_; }
  double clearance(Vec2 point) const { return toolkit::clearance(shapes_, {{0.0, 0.0}, upper_}, point); }
  bool is_clear(const Segment& leg) const {
    return toolkit::disc_sweep_is_clear(leg, radius_m - 1e-9, shapes_, {{0.0, 0.0}, upper_});
  }

  // Of a robot of this radius through all places.
  double length(const std::vector<Vec2>& places, double radius = radius_m) const {
    metrics::ShortestTours tours;
    return length(tours, places, radius);
  }
  double length(metrics::ShortestTours& tours, const std::vector<Vec2>& places, double radius = radius_m) const {
    dmrp_world world{};
    world.upper = upper_;
    world.shapes = shapes_.data();
    world.shape_count = static_cast<std::uint32_t>(shapes_.size());
    world.shape_stride = sizeof(Shape);
    tours.begin(World(world));
    dmrp_footprint footprint{};
    footprint.radius_m = radius;
    std::vector<Goal> goals;
    for (std::size_t place = 1; place < places.size(); ++place) {
      Goal goal{};
      goal.pose = {places[place].x, places[place].y, 0.0};
      goals.push_back(goal);
    }
    Robot robot{};
    robot.footprint = &footprint;
    robot.start = {places[0].x, places[0].y, 0.0};
    robot.dmrp_robot::goals = goals.data();
    robot.goal_count = static_cast<std::uint32_t>(goals.size());
    robot.goal_stride = sizeof(Goal);
    return tours.length_m(robot);
  }

 private:
  Vec2 upper_ = {10.0, 10.0};
  std::vector<Shape> shapes_;
  std::deque<std::vector<Vec2>> outlines_;
};

// From a point, tangent to a circle, along it, and by the mirror image to the other side.
double round_circle(double from_center_m, double circle_radius_m) {
  const double leg_m = std::sqrt(from_center_m * from_center_m - circle_radius_m * circle_radius_m);
  const double free_angle = std::acos(circle_radius_m / from_center_m);
  return 2.0 * leg_m + circle_radius_m * (pi - 2.0 * free_angle);
}

TEST_CASE("the shortest way past nothing is straight") {
  CHECK(Scene().length({{1, 1}, {4, 5}}) == 5.0);
  CHECK(Scene().length({{1, 1}, {4, 5}, {1, 1}}) == 10.0);
  CHECK(Scene().length({{1, 1}, {1, 1}}) == 0.0);
  CHECK(Scene().box({2, 3.3}, {3, 4}).length({{1, 3}, {4, 3}}) == 3.0);
}

TEST_CASE("the shortest way round a circle is two tangents and an arc") {
  CHECK_THAT(Scene().circle({5, 5}, 1).length({{2, 5}, {8, 5}}), WithinAbs(round_circle(3, 1.25), 1e-9));
  // more than half around: the arc is in several pieces
  const double out_m = std::sqrt(9.0 - 2.25 * 2.25), in_m = std::sqrt(13.0 - 2.25 * 2.25);
  const double out_at = pi + std::acos(2.25 / 3.0);
  const double in_at = 3.0 * pi - std::atan2(2.0, 3.0) - std::acos(2.25 / std::sqrt(13.0));
  CHECK_THAT(Scene().circle({5, 5}, 2).box({0, 5.5}, {4, 6}).length({{2, 5}, {2, 7}}),
             WithinAbs(out_m + 2.25 * (in_at - out_at) + in_m, 1e-9));
}

TEST_CASE("the shortest way round the end of a wall is two tangents and an arc of the disc's radius") {
  // the wall's end has two corners, 0.5 m apart
  const double leg_m = std::sqrt(4.0 + 1.0 - radius_m * radius_m);
  const double length = Scene().box({4.75, 0}, {5.25, 4}).length({{2.75, 3}, {7.25, 3}});
  // tangent from (2.75, 3) to the disc about (4.75, 4), over it, 0.5 m along the end, and down again
  const double bend = std::atan2(1.0, 2.0) + std::asin(radius_m / std::sqrt(5.0));
  CHECK_THAT(length, WithinAbs(2.0 * (leg_m + radius_m * bend) + 0.5, 1e-9));
}

TEST_CASE("walls made of several boxes are one wall") {
  const double whole = Scene().box({4, 0}, {5, 7}).length({{2, 2}, {8, 2}});
  Scene parts;
  for (int i = 0; i < 14; ++i) parts.box({4, 0.5 * i}, {5, 0.5 * (i + 1)});
  CHECK_THAT(parts.length({{2, 2}, {8, 2}}), WithinAbs(whole, 1e-9));
  CHECK_THAT(Scene().box({4, 0}, {4.5, 7}).box({4.3, 3}, {5, 7}).box({4.4, 0}, {5, 7}).length({{2, 2}, {8, 2}}),
             WithinAbs(whole, 1e-9));
}

TEST_CASE("among racks many ways are equally short") {
  Scene racks;
  racks.size(60, 60);
  for (int column = 0; column < 18; ++column)
    for (int row = 0; row < 18; ++row) {
      const Vec2 lower = {2.0 + 3.0 * column, 2.0 + 3.0 * row};
      racks.box(lower, lower + Vec2{2.0, 2.0});
    }
  const double there = racks.length({{1, 1}, {59, 58}});
  CHECK_THAT(racks.length({{59, 58}, {1, 1}}), WithinAbs(there, 1e-9));
  CHECK(there > std::hypot(58.0, 57.0));
  CHECK(there < 58.0 + 57.0);
}

TEST_CASE("a gap as wide as the robot is a way, a narrower one is none") {
  const auto through = [](double gap_m) {
    return Scene().box({4, 0}, {5, 5 - gap_m / 2}).box({4, 5 + gap_m / 2}, {5, 10}).length({{1, 5}, {9, 5}});
  };
  CHECK(through(0.5) == 8.0);
  CHECK(std::isnan(through(0.499)));
  // a corridor with two bends, as wide as the robot
  Scene bent;
  bent.box({0, 0.5}, {4, 10}).box({4.5, 0}, {10, 4}).box({4, 4.5}, {9.5, 10});
  CHECK_THAT(bent.length({{0.25, 0.25}, {4.25, 0.25}, {4.25, 4.25}, {9.75, 4.25}, {9.75, 9.75}}),
             WithinAbs(4.0 + 4.0 + 5.5 + 5.5, 1e-9));
}

TEST_CASE("the border is a wall") {
  CHECK(std::isnan(Scene().box({4, 0}, {5, 9.6}).length({{1, 5}, {9, 5}})));
  CHECK_FALSE(std::isnan(Scene().box({4, 0}, {5, 9.4}).length({{1, 5}, {9, 5}})));
  CHECK(std::isnan(Scene().length({{1, 5}, {11, 5}})));
}

TEST_CASE("a start too near to a wall counts as moved away from it, and the move counts") {
  Scene wall;
  wall.box({0, 0}, {10, 1}).box({4, 3}, {6, 10});
  const double free = wall.length({{2, 1.25}, {2, 5}, {8, 5}});
  CHECK(wall.length({{2, 1.15}, {2, 5}}) == 3.85);
  CHECK_THAT(wall.length({{2, 1.15}, {2, 5}, {8, 5}}), WithinAbs(free + 0.1, 1e-9));
  CHECK_THAT(wall.length({{2, 1.1}, {8, 1.1}}), WithinAbs(6.0, 1e-9));  // no nearer than both ends
  CHECK_THAT(wall.length({{2, 1.1}, {8, 1.25}}), WithinAbs(std::hypot(6.0, 0.15), 1e-9));
  CHECK_THAT(wall.length({{2, 0.9}, {2, 5}}), WithinAbs(0.35 + 3.75, 1e-9));  // within the wall
  CHECK_FALSE(std::isnan(wall.length({{3.8, 5}, {8, 5}})));
}

TEST_CASE("lengths are kept while the shapes stay, and only then") {
  metrics::ShortestTours tours;
  Scene scene;
  scene.box({4, 0}, {5, 7});
  const double alone = scene.length(tours, {{2, 2}, {8, 2}});
  CHECK(scene.length(tours, {{2, 2}, {8, 2}}) == alone);
  CHECK(scene.length(tours, {{2, 2}, {8, 2}}, 0.5) > alone);
  scene.box({4, 7}, {5, 8});
  CHECK(scene.length(tours, {{2, 2}, {8, 2}}) > alone + 1.0);
}

Scene random_scene(toolkit::Stream& random) {
  const auto within = [&](double lower, double upper) { return lower + (upper - lower) * random.uniform(); };
  Scene scene;
  for (int shape = 0; shape < 14; ++shape) {
    const Vec2 center = {within(0, 10), within(0, 10)};
    if (shape % 3 == 0) {
      scene.circle(center, within(0.1, 1.0));
    } else if (shape % 3 == 1) {
      const Vec2 half = {within(0.05, 1.5), within(0.05, 1.0)};
      scene.box(center - half, center + half);
    } else {
      std::vector<Vec2> vertices = toolkit::polygon_of_circle(center, within(0.2, 1.2), 3 + shape % 4);
      const double angle = within(0, pi);
      for (Vec2& vertex : vertices) vertex = center + toolkit::rotate(vertex - center, angle);
      scene.polygon(std::move(vertices));
    }
  }
  return scene;
}

// The visibility graph of polygons around the disc's places about corners and circles.
class ManyPoints {
 public:
  explicit ManyPoints(const Scene& scene) : scene_(scene) {
    for (const Shape& shape : scene.shapes()) {
      if (shape.kind == DMRP_SHAPE_CIRCLE) {
        add(shape.center, shape.radius_m + radius_m, 72);
      } else {
        for (const Vec2 vertex : toolkit::polygon_of(shape)) add(vertex, radius_m, 32);
      }
    }
  }

  // By Dijkstra's algorithm; NaN if there is no way.
  double length(Vec2 from, Vec2 to) {
    std::vector<Vec2> places = points_;
    places.push_back(to);
    std::vector<double> lengths(places.size(), std::numeric_limits<double>::infinity());
    std::vector<char> settled(places.size(), 0);
    Vec2 at = from;
    double length = 0.0;
    for (;;) {
      std::size_t next = 0;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < places.size(); ++i) {
        if (settled[i]) continue;
        const double direct = length + toolkit::distance(at, places[i]);
        if (direct < lengths[i] && scene_.is_clear({at, places[i]})) lengths[i] = direct;
        if (lengths[i] < least) least = lengths[next = i];
      }
      if (std::isinf(least)) return undefined;
      if (next + 1 == places.size()) return least;
      settled[next] = 1;
      at = places[next];
      length = least;
    }
  }

 private:
  // The corners of a polygon that contains the circle.
  void add(Vec2 center, double circle_radius_m, std::size_t count) {
    const double corner_m = circle_radius_m / std::cos(pi / static_cast<double>(count));
    for (const Vec2 point : toolkit::polygon_of_circle(center, corner_m, count))
      if (scene_.is_clear({point, point})) points_.push_back(point);
  }

  const Scene& scene_;
  std::vector<Vec2> points_;
};

TEST_CASE("the shortest way is at most that over many points, which is at most that of a disc 2 mm larger") {
  toolkit::Stream random(5, "shortest_way_test");
  int ways = 0, bent = 0;
  for (int scene_index = 0; scene_index < test::draws(40); ++scene_index) {
    const Scene scene = random_scene(random);
    ManyPoints many_points(scene);
    for (int pair = 0; pair < 3; ++pair) {
      const Vec2 from = {10 * random.uniform(), 10 * random.uniform()};
      const Vec2 to = {10 * random.uniform(), 10 * random.uniform()};
      if (scene.clearance(from) < radius_m + 0.002 || scene.clearance(to) < radius_m + 0.002) continue;
      CAPTURE(scene_index, from.x, from.y, to.x, to.y);
      const double found = scene.length({from, to});
      const double over_points = many_points.length(from, to);
      const double larger = scene.length({from, to}, radius_m + 0.002);
      if (!std::isnan(over_points)) CHECK(found <= over_points + 1e-6);
      if (!std::isnan(larger)) CHECK(over_points <= larger + 1e-6);
      if (!std::isnan(found)) CHECK_THAT(scene.length({to, from}), WithinAbs(found, 1e-6));
      ways += !std::isnan(found);
      bent += found > toolkit::distance(from, to) + 0.01;
    }
  }
  CHECK(ways >= test::draws(40));
  CHECK(bent >= test::draws(10));
}

}  // namespace shortest_way_test
