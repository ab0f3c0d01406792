// SPDX-License-Identifier: MIT
#include "core/sensors/obstacle_clusters.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/segment.hpp>
#include <vector>

namespace obstacle_clusters_test {

using namespace dmrp;
using namespace dmrp::core;

constexpr double resolution_m = 0.05;
constexpr double tolerance_m = 0.075;

// A costmap to draw lethal cells into.
struct Sketch {
  int width;
  int height;
  dmrp_vec2 origin = {-1.35, 2.4};
  std::vector<std::uint8_t> costs;

  Sketch(int columns, int rows) : width(columns), height(rows), costs(static_cast<std::size_t>(columns * rows)) {}

  void set(int column, int row, int cost = DMRP_COST_LETHAL) {
    if (column < 0 || row < 0 || column >= width || row >= height) return;
    costs[static_cast<std::size_t>(row * width + column)] = static_cast<std::uint8_t>(cost);
  }
  void line(double column, double row, double to_column, double to_row) {
    const double steps = std::ceil(4.0 * std::hypot(to_column - column, to_row - row)) + 1.0;
    for (double i = 0.0; i <= steps; ++i)
      set(static_cast<int>(std::floor(column + i / steps * (to_column - column))),
          static_cast<int>(std::floor(row + i / steps * (to_row - row))));
  }
  void arc(double column, double row, double radius, double from, double to) {
    for (double angle = from; angle <= to; angle += 0.2 / radius)
      set(static_cast<int>(std::floor(column + radius * std::cos(angle))),
          static_cast<int>(std::floor(row + radius * std::sin(angle))));
  }
  void block(int column, int row, int columns, int rows) {
    for (int r = row; r < row + rows; ++r)
      for (int c = column; c < column + columns; ++c) set(c, r);
  }

  dmrp_vec2 center(int column, int row) const { return origin + resolution_m * dmrp_vec2{column + 0.5, row + 0.5}; }
  dmrp_costmap view() const {
    dmrp_costmap map{};
    map.struct_size = sizeof(map);
    map.width = static_cast<std::uint32_t>(width);
    map.height = static_cast<std::uint32_t>(height);
    map.t_ns = 7;
    map.resolution_m = resolution_m;
    map.origin = origin;
    map.costs = costs.data();
    return map;
  }
};

using Cluster = std::vector<dmrp_vec2>;

std::vector<Cluster> clusters_of(const Sketch& sketch, const std::vector<dmrp_agent>& agents = {}) {
  ObstacleClusters clusters;
  const dmrp_obstacle_cluster_list& list = clusters.derive(sketch.view(), agents);
  CHECK(list.struct_size == sizeof(list));
  CHECK(list.t_ns == 7);
  CHECK(list.tolerance_m == Approx(tolerance_m));
  std::vector<Cluster> copies;
  for (std::uint32_t i = 0; i < list.count; ++i) {
    const dmrp_obstacle_cluster& cluster = *DMRP_AT(dmrp_obstacle_cluster, list.clusters, list.stride, i);
    copies.emplace_back(cluster.vertices, cluster.vertices + cluster.vertex_count);
  }
  return copies;
}

double distance_to(const Cluster& cluster, dmrp_vec2 point) {
  if (cluster.size() == 1) return toolkit::distance(cluster[0], point);
  if (cluster.size() == 2) return toolkit::distance(dmrp_segment{cluster[0], cluster[1]}, point);
  return toolkit::distance(toolkit::PolygonView(cluster), point);
}

// Its points: along a segment and a polygon's border every millimetre or so, inside a polygon on a lattice.
std::vector<dmrp_vec2> points_of(const Cluster& cluster) {
  std::vector<dmrp_vec2> points = cluster;
  for (std::size_t i = 0; i < cluster.size(); ++i) {
    const dmrp_vec2 next = cluster[(i + 1) % cluster.size()];
    for (double share = 0.0; share < 1.0; share += 0.001 / (0.001 + toolkit::distance(cluster[i], next)))
      points.push_back(toolkit::lerp(cluster[i], next, share));
  }
  if (cluster.size() < 3) return points;
  dmrp_vec2 lower = cluster[0];
  dmrp_vec2 upper = cluster[0];
  for (const dmrp_vec2 vertex : cluster) {
    lower = {std::min(lower.x, vertex.x), std::min(lower.y, vertex.y)};
    upper = {std::max(upper.x, vertex.x), std::max(upper.y, vertex.y)};
  }
  for (double y = lower.y; y < upper.y; y += 0.007)
    for (double x = lower.x; x < upper.x; x += 0.007)
      if (toolkit::contains(toolkit::PolygonView(cluster), {x, y})) points.push_back({x, y});
  return points;
}

dmrp_agent person_at(dmrp_vec2 place, double radius_m) {
  dmrp_agent agent{};
  agent.kind = DMRP_AGENT_PERSON;
  agent.pose = {place.x, place.y, 0.0};
  agent.radius_m = radius_m;
  return agent;
}

// Both promises of the header, by brute force over all lethal cells that no agent accounts for.
void check_promises(const Sketch& sketch, const std::vector<dmrp_agent>& agents = {}) {
  std::vector<dmrp_vec2> cells;
  for (int row = 0; row < sketch.height; ++row) {
    for (int column = 0; column < sketch.width; ++column) {
      if (sketch.costs[static_cast<std::size_t>(row * sketch.width + column)] != DMRP_COST_LETHAL) continue;
      const dmrp_vec2 center = sketch.center(column, row);
      const bool is_agent = std::any_of(agents.begin(), agents.end(), [&](const dmrp_agent& agent) {
        return toolkit::distance(center, toolkit::position(agent.pose)) <= agent.radius_m + 0.1;
      });
      if (!is_agent) cells.push_back(center);
    }
  }
  const auto distance_to_cells = [&](dmrp_vec2 point) {
    double squared = 1e18;
    for (const dmrp_vec2 cell : cells) squared = std::min(squared, toolkit::squared_distance(cell, point));
    return std::sqrt(squared);
  };

  const std::vector<Cluster> clusters = clusters_of(sketch, agents);
  CHECK(clusters == clusters_of(sketch, agents));
  double farthest_cell_m = 0.0;
  for (const dmrp_vec2 cell : cells) {
    double nearest_m = 1e9;
    for (const Cluster& cluster : clusters) nearest_m = std::min(nearest_m, distance_to(cluster, cell));
    farthest_cell_m = std::max(farthest_cell_m, nearest_m);
  }
  CHECK(farthest_cell_m < tolerance_m + 1e-9);

  double farthest_point_m = 0.0;
  double farthest_vertex_m = 0.0;
  for (const Cluster& cluster : clusters) {
    REQUIRE_FALSE(cluster.empty());
    if (cluster.size() == 2) CHECK(toolkit::distance(cluster[0], cluster[1]) > 0.0);
    if (cluster.size() > 2) CHECK(toolkit::is_convex_ccw(toolkit::PolygonView(cluster)));
    for (const dmrp_vec2 vertex : cluster) farthest_vertex_m = std::max(farthest_vertex_m, distance_to_cells(vertex));
    for (const dmrp_vec2 point : points_of(cluster))
      farthest_point_m = std::max(farthest_point_m, distance_to_cells(point));
  }
  CHECK(farthest_vertex_m < 1e-9);
  CHECK(farthest_point_m < tolerance_m + 1e-9);
}

TEST_CASE("no lethal cells give no clusters, and single cells give points") {
  Sketch sketch(40, 30);
  sketch.set(3, 3, DMRP_COST_INSCRIBED);
  CHECK(clusters_of(sketch).empty());
  sketch.set(10, 20);
  sketch.set(35, 2);
  sketch.set(0, 0);
  sketch.set(39, 29);
  const std::vector<Cluster> clusters = clusters_of(sketch);
  REQUIRE(clusters.size() == 4);
  CHECK(clusters[0] == Cluster{sketch.center(0, 0)});
  CHECK(clusters[1] == Cluster{sketch.center(35, 2)});
  CHECK(clusters[2] == Cluster{sketch.center(10, 20)});
  CHECK(clusters[3] == Cluster{sketch.center(39, 29)});
}

TEST_CASE("a straight wall is one segment at any angle, its gaps of two cells included") {
  Sketch along(120, 120);
  for (int column = 0; column < 120; ++column)
    if (column % 3 == 0 || column == 119) along.set(column, 40);
  const std::vector<Cluster> wall = clusters_of(along);
  REQUIRE(wall.size() == 1);
  CHECK(wall[0] == Cluster{along.center(0, 40), along.center(119, 40)});
  for (int degrees = 0; degrees < 180; degrees += 3) {
    Sketch sketch(120, 120);
    const double angle = 0.0174532925 * degrees;
    sketch.line(60.3 - 55.0 * std::cos(angle), 60.8 - 55.0 * std::sin(angle), 60.3 + 55.0 * std::cos(angle),
                60.8 + 55.0 * std::sin(angle));
    INFO(degrees << " degrees");
    const std::vector<Cluster> clusters = clusters_of(sketch);
    CHECK(clusters.size() == 1);
    CHECK(clusters[0].size() <= 4);
    check_promises(sketch);
  }
}

TEST_CASE("a wall with a wider gap is two segments, and nothing spans the gap") {
  Sketch sketch(60, 10);
  sketch.block(5, 5, 20, 1);
  sketch.block(28, 5, 20, 1);  // three cells are missing
  const std::vector<Cluster> clusters = clusters_of(sketch);
  REQUIRE(clusters.size() == 2);
  CHECK(clusters[0] == Cluster{sketch.center(5, 5), sketch.center(24, 5)});
  CHECK(clusters[1] == Cluster{sketch.center(28, 5), sketch.center(47, 5)});
}

TEST_CASE("a room's corner is two segments, a room four") {
  Sketch corner(100, 100);
  corner.block(10, 10, 60, 1);
  corner.block(10, 10, 1, 50);
  const std::vector<Cluster> sides = clusters_of(corner);
  REQUIRE(sides.size() == 2);
  CHECK(sides[0].size() == 2);
  CHECK(sides[1].size() == 2);
  check_promises(corner);

  Sketch room(120, 120);
  room.block(10, 10, 80, 1);
  room.block(10, 79, 80, 1);
  room.block(10, 10, 1, 70);
  room.block(89, 10, 1, 70);
  CHECK(clusters_of(room).size() == 4);
  check_promises(room);
}

TEST_CASE("a solid block is one polygon, counter-clockwise") {
  Sketch sketch(60, 60);
  sketch.block(10, 20, 30, 12);
  const std::vector<Cluster> clusters = clusters_of(sketch);
  REQUIRE(clusters.size() == 1);
  CHECK(clusters[0] ==
        Cluster{sketch.center(10, 20), sketch.center(39, 20), sketch.center(39, 31), sketch.center(10, 31)});
  Sketch disc(60, 60);
  for (double radius = 0.5; radius < 9.0; radius += 0.4) disc.arc(30.2, 29.6, radius, 0.0, 6.3);
  CHECK(clusters_of(disc).size() == 1);
  check_promises(disc);
}

TEST_CASE("cells of an agent are excluded, and no shape covers its place") {
  Sketch sketch(100, 60);
  sketch.block(0, 40, 100, 1);
  sketch.arc(50.0, 20.0, 6.0, 0.0, 6.3);
  sketch.set(50, 30);
  const dmrp_vec2 center = sketch.origin + resolution_m * dmrp_vec2{50.0, 20.0};
  CHECK(clusters_of(sketch, {person_at(center, 0.3)}).size() == 2);  // the cell 0.5 m away stays

  // one who leans on the wall hides a part of it
  const std::vector<dmrp_agent> leaning = {person_at(sketch.center(50, 36), 0.2), person_at({500.0, 0.0}, 0.3)};
  const std::vector<Cluster> clusters = clusters_of(sketch, leaning);
  CHECK(std::count_if(clusters.begin(), clusters.end(),
                      [&](const Cluster& cluster) { return cluster[0].y == sketch.center(0, 40).y; }) == 2);
  check_promises(sketch, leaning);
}

TEST_CASE("both guarantees hold on random maps") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    toolkit::Stream stream(seed, "test.clusters");
    Sketch sketch(static_cast<int>(stream.below(70)) + 10, static_cast<int>(stream.below(70)) + 10);
    const auto somewhere = [&] { return stream.uniform(-5.0, 85.0); };
    for (std::uint64_t i = stream.below(5); i > 0; --i) sketch.line(somewhere(), somewhere(), somewhere(), somewhere());
    for (std::uint64_t i = stream.below(4); i > 0; --i) {
      const double from = stream.uniform(-3.0, 3.0);
      sketch.arc(somewhere(), somewhere(), stream.uniform(1.0, 20.0), from, from + stream.uniform(0.5, 6.0));
    }
    for (std::uint64_t i = stream.below(4); i > 0; --i)
      sketch.block(static_cast<int>(somewhere()), static_cast<int>(somewhere()), static_cast<int>(stream.below(15)),
                   static_cast<int>(stream.below(15)));
    // specks, from none to a dense fog, and holes
    const double specks = stream.chance(0.5) ? stream.uniform(0.0, 0.03) : stream.uniform(0.0, 0.6);
    const double holes = stream.chance(0.5) ? 0.0 : stream.uniform(0.0, 0.5);
    for (int row = 0; row < sketch.height; ++row) {
      for (int column = 0; column < sketch.width; ++column) {
        if (stream.chance(specks)) sketch.set(column, row);
        if (stream.chance(holes)) sketch.set(column, row, 0);
      }
    }
    std::vector<dmrp_agent> agents;
    for (std::uint64_t i = stream.below(4); i > 0; --i)
      agents.push_back(person_at(sketch.origin + resolution_m * dmrp_vec2{somewhere(), somewhere()}, 0.3));
    INFO("seed " << seed);
    check_promises(sketch, agents);
  }
}

TEST_CASE("clusters do not depend on what was clustered before") {
  Sketch one(90, 40);
  one.line(3, 3, 80, 37);
  one.arc(40, 20, 15, 0, 4);
  Sketch other(120, 120);
  other.block(3, 3, 100, 100);
  ObstacleClusters used;
  used.derive(other.view(), {});
  const dmrp_obstacle_cluster_list& list = used.derive(one.view(), {});
  const std::vector<Cluster> fresh = clusters_of(one);
  REQUIRE(list.count == fresh.size());
  for (std::uint32_t i = 0; i < list.count; ++i)
    CHECK(fresh[i] == Cluster(list.clusters[i].vertices, list.clusters[i].vertices + list.clusters[i].vertex_count));
}

}  // namespace obstacle_clusters_test
