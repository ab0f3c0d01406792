// SPDX-License-Identifier: MIT
// The neighbour grid against looking at all points.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/neighbour_grid.hpp>
#include <dmrp/toolkit/random.hpp>
#include <limits>
#include <vector>

#include "tests/support/draws.hpp"

namespace neighbour_grid_test {

using namespace dmrp::toolkit;

using Points = std::vector<dmrp_vec2>;
using Indices = std::vector<std::uint32_t>;

void build(NeighbourGrid& grid, const Points& points, double cell_m) {
  grid.build(points.size(), cell_m, [&](std::size_t index) { return points[index]; });
}

// Some at one place, some on the corners of cells, a few very far away.
Points random_points(Stream& stream) {
  Points points(stream.below(120));
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = {stream.uniform(-20.0, 20.0), stream.uniform(-20.0, 20.0)};
    if (stream.chance(0.2)) points[i] = points[stream.below(i + 1)];
    if (stream.chance(0.2)) points[i] = {std::round(points[i].x), std::round(points[i].y)};
    if (stream.chance(0.03)) points[i] = 1e9 * points[i];
    if (stream.chance(0.01)) points[i] = {1e300, points[i].y};
  }
  return points;
}

Indices within(const Points& points, dmrp_vec2 center, double distance_m) {
  Indices indices;
  for (std::uint32_t i = 0; i < points.size(); ++i)
    if (squared_distance(center, points[i]) <= distance_m * distance_m) indices.push_back(i);
  return indices;
}

TEST_CASE("a neighbour grid misses none of the points within a distance") {
  NeighbourGrid grid;
  for (std::uint64_t seed = 0; seed < dmrp::test::draws(2000u); ++seed) {
    Stream stream(seed, "points");
    const Points points = random_points(stream);
    build(grid, points, stream.chance(0.3) ? 1.0 : stream.uniform(0.05, 10.0));
    REQUIRE(grid.size() == points.size());
    for (int question = 0; question < 10; ++question) {
      const dmrp_vec2 anywhere = {stream.uniform(-25.0, 25.0), stream.uniform(-25.0, 25.0)};
      const dmrp_vec2 center = points.empty() || stream.chance(0.3) ? anywhere : points[stream.below(points.size())];
      const double distance_m = stream.chance(0.3) ? static_cast<double>(stream.below(4)) : stream.uniform(0.0, 30.0);
      INFO("seed " << seed << ", question " << question);

      const Indices near = grid.near(center, distance_m);
      CHECK(std::is_sorted(near.begin(), near.end()));
      CHECK(std::adjacent_find(near.begin(), near.end()) == near.end());
      const Indices must = within(points, center, distance_m);
      CHECK(std::includes(near.begin(), near.end(), must.begin(), must.end()));

      Indices visited;
      CHECK(grid.visit(center, distance_m, [&](std::uint32_t index) { visited.push_back(index); }) == near.size());
      std::sort(visited.begin(), visited.end());
      CHECK(visited == near);
    }
    CHECK(grid.near({0.0, 0.0}, std::numeric_limits<double>::infinity()).size() == points.size());
  }
}

TEST_CASE("a neighbour grid finds a point that only rounding puts within the distance") {
  Points points(20, {0.5, 0.0});
  points[7] = {-1e-17, 0.0};  // in the cell before that of 0
  REQUIRE(squared_distance(dmrp_vec2{1.0, 0.0}, points[7]) == 1.0);
  NeighbourGrid grid;
  build(grid, points, 1.0);
  CHECK(grid.near({1.0, 0.0}, 1.0).size() == 20);
}

TEST_CASE("a neighbour grid looks at few of many points, whatever lies far away") {
  Points points;
  for (int x = 0; x < 50; ++x)
    for (int y = 0; y < 50; ++y) points.push_back({static_cast<double>(x), static_cast<double>(y)});
  points.push_back({1e12, -1e12});
  points.push_back({-1e300, 3.0});
  NeighbourGrid grid;
  build(grid, points, 1.0);
  for (const dmrp_vec2 center : points) CHECK(grid.near(center, 1.0).size() <= 18);
}

TEST_CASE("a neighbour grid has the answers of its last points alone") {
  NeighbourGrid grid;
  CHECK(grid.near({0.0, 0.0}, 1.0).empty());
  build(grid, Points(100, {3.0, 3.0}), 1.0);
  CHECK(grid.near({3.0, 3.0}, 0.0).size() == 100);
  build(grid, Points(1, {4.0, 3.0}), 1.0);
  CHECK(grid.near({4.0, 3.0}, 0.0) == Indices{0});
  build(grid, {}, 1.0);
  CHECK(grid.near({4.0, 3.0}, 10.0).empty());
}

}  // namespace neighbour_grid_test
