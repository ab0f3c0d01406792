// SPDX-License-Identifier: MIT
// Shortest ways: cases computed by hand, and Theta* on fine cells among random shapes.
#include "metrics/outcome/shortest_way.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <deque>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/shape_distance.hpp>
#include <vector>

#include "tests/support/draws.hpp"
#include "tests/unit/metrics/outcome/theta_star.hpp"

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

  double clearance(Vec2 point) const { return toolkit::clearance(shapes_, {{0.0, 0.0}, upper_}, point); }

  // Of a robot of this radius through all places.
  double length(const std::vector<Vec2>& places, double radius = radius_m) {
    metrics::ShortestTours tours;
    return length(tours, places, radius);
  }
  double length(metrics::ShortestTours& tours, const std::vector<Vec2>& places, double radius = radius_m) {
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

TEST_CASE("the shortest way lies between Theta*'s for a slightly thinner and a slightly thicker disc") {
  constexpr double cell_m = 0.05;
  constexpr std::uint32_t columns = 200;
  const double half_diagonal_m = cell_m * std::sqrt(0.5);
  toolkit::Stream random(5, "shortest_way_test");
  int ways = 0;
  for (int scene_index = 0; scene_index < test::draws(40); ++scene_index) {
    Scene scene = random_scene(random);
    std::vector<float> clearance;
    for (std::uint32_t cell = 0; cell < columns * columns; ++cell)
      clearance.push_back(
          static_cast<float>(scene.clearance({(cell % columns + 0.5) * cell_m, (cell / columns + 0.5) * cell_m})));
    Grid grid{};
    grid.width = grid.height = columns;
    grid.resolution_m = cell_m;
    grid.clearance = clearance.data();
    test::ThetaStar theta_star(grid);
    for (int pair = 0; pair < 4; ++pair) {
      const Vec2 from = {10 * random.uniform(), 10 * random.uniform()};
      const Vec2 to = {10 * random.uniform(), 10 * random.uniform()};
      if (scene.clearance(from) < radius_m + 0.1 || scene.clearance(to) < radius_m + 0.1) continue;
      const double found = theta_star.length(from, to, radius_m);
      const double thin = scene.length({from, to}, radius_m - half_diagonal_m);
      const double thick = scene.length({from, to}, radius_m + half_diagonal_m);
      CAPTURE(scene_index, from.x, from.y, to.x, to.y, found);
      if (!std::isnan(thick)) {
        ++ways;
        CHECK(found <= 1.02 * thick + cell_m);
        CHECK(scene.length({from, to}) <= thick + 1e-9);
      }
      if (!std::isnan(found)) CHECK(thin <= found + 1e-4);
      const double there = scene.length({from, to});
      const double back = scene.length({to, from});
      CHECK((std::isnan(there) ? std::isnan(back) : std::abs(there - back) < 1e-6));
    }
  }
  CHECK(ways >= test::draws(40));
}

}  // namespace shortest_way_test
