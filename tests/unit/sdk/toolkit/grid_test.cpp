// SPDX-License-Identifier: MIT
// Grid views, lines on grids, the distance transform, navigation fields, snapping and what SVG needs.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/distance_transform.hpp>
#include <dmrp/toolkit/grid_line.hpp>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/navigation_field.hpp>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/snap.hpp>
#include <dmrp/toolkit/svg.hpp>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace grid_test {

using namespace dmrp::toolkit;

const double infinity = std::numeric_limits<double>::infinity();

// A dmrp_grid with its arrays. `rows` are drawn as on paper, the top row first; '.' is free.
struct TestGrid {
  std::vector<std::uint8_t> free;
  std::vector<std::uint8_t> edges;
  std::vector<float> clearance;
  dmrp_grid c = {};

  explicit TestGrid(const std::vector<std::string>& rows, double resolution_m = 1.0, dmrp_vec2 origin = {0.0, 0.0}) {
    c.struct_size = sizeof(c);
    c.width = static_cast<std::uint32_t>(rows[0].size());
    c.height = static_cast<std::uint32_t>(rows.size());
    c.resolution_m = resolution_m;
    c.origin = origin;
    for (auto row = rows.rbegin(); row != rows.rend(); ++row)
      for (const char cell : *row) free.push_back(cell == '.');
    c.free = free.data();
    const GridView cells(c);
    edges.assign(free.size(), 0);
    for (std::uint32_t cell = 0; cell < cells.size(); ++cell)
      for (int d = 0; d < direction_count; ++d) {
        const auto open = [&](int direction) {
          const std::uint32_t next = cells.neighbour(cell, direction & 7);
          return next != no_cell && free[next] != 0;
        };
        const bool passable = free[cell] && open(d) && (!is_diagonal(d) || (open(d + 1) && open(d + 7)));
        if (passable) edges[cell] |= static_cast<std::uint8_t>(1u << d);
      }
    clearance =
        DistanceTransform().compute(c.width, c.height, resolution_m, [this](std::size_t i) { return free[i] == 0; });
    c.edges = edges.data();
    c.clearance = clearance.data();
  }
  TestGrid(const TestGrid&) = delete;

  GridView view() const { return GridView(c); }
};

std::vector<std::string> random_rows(Stream& stream, std::size_t width, std::size_t height, double density) {
  std::vector<std::string> rows(height, std::string(width, '.'));
  for (std::string& row : rows)
    for (char& cell : row)
      if (stream.chance(density)) cell = '#';
  return rows;
}

std::vector<std::string> empty_rows(std::size_t width, std::size_t height) {
  return std::vector<std::string>(height, std::string(width, '.'));
}

Rectangle point_target(dmrp_vec2 at) {
  return {at, at};
}

// Length of the shortest way along E, N, W, S edges, by relaxing until nothing changes.
std::vector<double> manhattan_lengths(const GridView& grid, std::uint32_t target) {
  std::vector<double> lengths(grid.size(), infinity);
  if (grid.free(target)) lengths[target] = 0.0;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t cell = 0; cell < grid.size(); ++cell)
      for (int d = 0; d < direction_count; d += 2) {
        if (!grid.edge(cell, d)) continue;
        const double through = lengths[grid.neighbour(cell, d)] + grid.resolution_m();
        if (through < lengths[cell]) {
          lengths[cell] = through;
          changed = true;
        }
      }
  }
  return lengths;
}

// Walks along the field's directions in short steps; the way's length, or infinity if it does not arrive.
double walk(const NavigationField& field, dmrp_vec2 from, const Rectangle& target, double give_up_m) {
  const double step_m = 0.1 * field.grid().resolution_m();
  double walked = 0.0;
  while (distance(target, from) > step_m) {
    from += step_m * field.direction(from);
    walked += step_m;
    if (walked > give_up_m) return infinity;
  }
  return walked + distance(target, from);
}

TEST_CASE("directions are the bits of an edge mask", "[toolkit]") {
  CHECK(direction_of(1, 0) == 0);
  CHECK(1u << direction_of(1, 1) == DMRP_EDGE_NE);
  CHECK(1u << direction_of(0, 1) == DMRP_EDGE_N);
  CHECK(1u << direction_of(-1, 1) == DMRP_EDGE_NW);
  CHECK(1u << direction_of(-1, 0) == DMRP_EDGE_W);
  CHECK(1u << direction_of(-1, -1) == DMRP_EDGE_SW);
  CHECK(1u << direction_of(0, -1) == DMRP_EDGE_S);
  CHECK(1u << direction_of(1, -1) == DMRP_EDGE_SE);
  CHECK(direction_of(0, 0) == -1);
  CHECK(direction_of(2, 0) == -1);
  for (int d = 0; d < direction_count; ++d) {
    const auto i = static_cast<std::size_t>(d);
    const auto o = static_cast<std::size_t>(opposite_direction(d));
    CHECK(direction_dx[i] == -direction_dx[o]);
    CHECK(direction_dy[i] == -direction_dy[o]);
    CHECK(direction_length[i] == Approx(std::hypot(direction_dx[i], direction_dy[i])));
    CHECK(is_diagonal(d) == (direction_dx[i] != 0 && direction_dy[i] != 0));
  }
}

TEST_CASE("a grid view knows cells, points and edges", "[toolkit]") {
  const TestGrid grid({"...",  //
                       ".#."},
                      0.5, {10.0, -1.0});
  const GridView view = grid.view();
  CHECK(view.size() == 6);
  CHECK(view.center(Cell{0, 0}) == dmrp_vec2{10.25, -0.75});
  CHECK(view.center(std::uint32_t{5}) == dmrp_vec2{11.25, -0.25});
  CHECK(view.upper() == dmrp_vec2{11.5, 0.0});
  CHECK(view.cell(4) == Cell{1, 1});
  CHECK(view.cell_of({10.5, -0.5}) == Cell{1, 1});  // a common corner belongs to the upper right cell
  CHECK(view.cell_of({9.9, -1.6}) == Cell{-1, -2});
  CHECK(view.index_of({10.1, -0.1}) == 3);
  CHECK(view.index_of({11.5, -0.1}) == no_cell);
  CHECK(view.index_of({std::nan(""), 0.0}) == no_cell);
  CHECK(view.index_of({1e300, -1e300}) == no_cell);
  CHECK(view.index_of({infinity, -infinity}) == no_cell);
  CHECK(view.contains(dmrp_vec2{10.0, -1.0}));
  CHECK_FALSE(view.contains(dmrp_vec2{9.9999, -1.0}));
  CHECK(view.free(Cell{0, 0}));
  CHECK_FALSE(view.free(Cell{1, 0}));
  CHECK_FALSE(view.free(Cell{-1, 0}));
  CHECK(view.neighbour(0, 2) == 3);
  CHECK(view.neighbour(0, 1) == 4);
  CHECK(view.neighbour(0, 4) == no_cell);
  CHECK(view.neighbour(5, 0) == no_cell);  // no running over into the next row
  CHECK(view.edges(0) == DMRP_EDGE_N);
  CHECK(view.edge(4, 0));
  CHECK_FALSE(view.edge(4, 6));
  CHECK(view.clearance(3) == Approx(0.5f * std::sqrt(2.0f)));
  for (std::uint32_t cell = 0; cell < view.size(); ++cell) CHECK(view.index_of(view.center(cell)) == cell);
}

TEST_CASE("a line visits the cells that it crosses, in order", "[toolkit]") {
  const TestGrid grid(empty_rows(8, 8));
  const GridView view = grid.view();
  const auto cells_on = [&](dmrp_vec2 from, dmrp_vec2 to) {
    std::vector<std::pair<int, int>> cells;
    for_each_cell_on_line(view, from, to, [&](Cell cell) {
      cells.emplace_back(cell.column, cell.row);
      return true;
    });
    return cells;
  };
  using Cells = std::vector<std::pair<int, int>>;
  CHECK(cells_on({0.5, 0.5}, {0.6, 0.7}) == Cells{{0, 0}});
  CHECK(cells_on({0.5, 0.5}, {3.5, 0.5}) == Cells{{0, 0}, {1, 0}, {2, 0}, {3, 0}});
  CHECK(cells_on({0.5, 2.5}, {0.5, 0.5}) == Cells{{0, 2}, {0, 1}, {0, 0}});
  CHECK(cells_on({0.5, 0.5}, {2.5, 1.5}) == Cells{{0, 0}, {1, 0}, {1, 1}, {2, 1}});
  CHECK(cells_on({0.5, 0.5}, {1.5, 1.5}) == Cells{{0, 0}, {1, 0}, {0, 1}, {1, 1}});  // through the corner
  CHECK(cells_on({-0.5, 0.5}, {0.5, 0.5}) == Cells{{-1, 0}, {0, 0}});

  Stream stream(1, "lines");
  for (int i = 0; i < 300; ++i) {
    const dmrp_vec2 from = {stream.uniform(0.0, 8.0), stream.uniform(0.0, 8.0)};
    const dmrp_vec2 to = {stream.uniform(0.0, 8.0), stream.uniform(0.0, 8.0)};
    const Cells cells = cells_on(from, to);
    const std::set<std::pair<int, int>> visited(cells.begin(), cells.end());
    REQUIRE(visited.size() == cells.size());
    const Cell last = view.cell_of(to);
    REQUIRE(cells.back() == std::make_pair(int{last.column}, int{last.row}));
    for (int k = 0; k <= 500; ++k) {
      const Cell at = view.cell_of(lerp(from, to, k / 500.0));
      REQUIRE(visited.count({at.column, at.row}) == 1);
    }
    for (std::size_t k = 1; k < cells.size(); ++k)
      REQUIRE(std::abs(cells[k].first - cells[k - 1].first) + std::abs(cells[k].second - cells[k - 1].second) == 1);
  }
}

TEST_CASE("a line is free when all its cells are", "[toolkit]") {
  const TestGrid grid({"....",  //
                       ".#..",  //
                       "...."});
  const GridView view = grid.view();
  CHECK(line_is_free(view, {0.5, 0.5}, {3.5, 0.5}));
  CHECK_FALSE(line_is_free(view, {0.5, 1.5}, {3.5, 1.5}));
  CHECK_FALSE(line_is_free(view, {0.5, 1.5}, {1.5, 2.5}));  // past the corner of the blocked cell
  CHECK_FALSE(line_is_free(view, {0.5, 0.5}, {-0.5, 0.5}));
  CHECK(line_is_free(view, {2.5, 0.5}, {2.5, 2.5}));
}

TEST_CASE("the distance transform agrees with all pairs", "[toolkit]") {
  Stream stream(2, "transform");
  DistanceTransform transform;
  struct Size {
    std::uint32_t width, height;
  };
  for (const Size size : {Size{1, 1}, {1, 9}, {9, 1}, {13, 7}, {31, 40}, {40, 31}})
    for (const double density : {0.0, 0.01, 0.2, 0.9, 1.0}) {
      const double resolution_m = stream.uniform(0.03, 1.0);
      const double cap_m = stream.chance(0.5) ? infinity : stream.uniform(0.1, 5.0);
      std::vector<std::uint8_t> mask(size.width * size.height);
      for (std::uint8_t& cell : mask) cell = stream.chance(density) ? 255 : 0;
      const std::vector<float>& distances =
          transform.compute(size.width, size.height, resolution_m, mask.data(), cap_m);
      REQUIRE(distances.size() == mask.size());
      for (std::uint32_t i = 0; i < mask.size(); ++i) {
        double squared = infinity;
        for (std::uint32_t k = 0; k < mask.size(); ++k) {
          const double dx = static_cast<double>(i % size.width) - k % size.width;
          const double dy = static_cast<double>(i / size.width) - k / size.width;
          if (mask[k]) squared = std::min(squared, dx * dx + dy * dy);
        }
        REQUIRE(distances[i] == static_cast<float>(std::min(std::sqrt(squared) * resolution_m, cap_m)));
      }
    }
}

TEST_CASE("the distance transform keeps its buffers", "[toolkit]") {
  DistanceTransform transform;
  const std::vector<std::uint8_t> mask(50 * 60, 1);
  const float* first = transform.compute(50, 60, 0.05, mask.data()).data();
  CHECK(transform.compute(60, 40, 0.05, mask.data()).data() == first);
  CHECK(transform.compute(50, 60, 0.05, mask.data()).data() == first);
  CHECK(transform.compute(0, 0, 0.05, mask.data()).empty());
}

TEST_CASE("a navigation field in the open is nearly the true distance", "[toolkit]") {
  const TestGrid grid(empty_rows(60, 60), 0.5);
  NavigationField field;
  const dmrp_vec2 at = {15.25, 15.25};
  field.compute(grid.view(), point_target(at));
  double worst = 0.0;
  double worst_off = 0.0;
  for (std::uint32_t cell = 0; cell < grid.view().size(); ++cell) {
    const double true_m = distance(grid.view().center(cell), at);
    REQUIRE(field.value(cell) >= true_m - 1e-9);
    if (true_m < 2.0) continue;
    worst = std::max(worst, field.value(cell) / true_m - 1.0);
    const double off = difference(bearing(grid.view().center(cell), at), [&] {
      const dmrp_vec2 way = field.direction(cell);
      return std::atan2(way.y, way.x);
    }());
    worst_off = std::max(worst_off, std::abs(off));
  }
  CHECK(worst < 0.025);
  CHECK(worst_off < 0.06);
  CHECK(field.value(at) == 0.0);
  CHECK(field.direction(at) == dmrp_vec2{0.0, 0.0});
  // Toward a wide target across the whole world the first order is exact.
  field.compute(grid.view(), Rectangle{{0.0, 0.0}, {30.0, 0.1}});
  CHECK(field.value(dmrp_vec2{12.3, 20.25}) == Approx(20.15));
  CHECK(distance(field.direction(dmrp_vec2{12.3, 20.25}), dmrp_vec2{0.0, -1.0}) < 1e-12);
}

TEST_CASE("a navigation field reaches what can be reached, by no longer way than grid moves", "[toolkit]") {
  Stream stream(3, "fields");
  NavigationField field;
  for (int i = 0; i < 20; ++i) {
    const TestGrid grid(random_rows(stream, 25, 20, 0.3), 0.4, {-3.0, 2.0});
    const GridView view = grid.view();
    const auto target = static_cast<std::uint32_t>(stream.below(view.size()));
    const dmrp_vec2 at = view.center(target);
    field.compute(view, point_target(at));
    const std::vector<double> grid_moves = manhattan_lengths(view, target);
    for (std::uint32_t cell = 0; cell < view.size(); ++cell) {
      REQUIRE(field.reachable(cell) == (grid_moves[cell] < infinity));
      if (!field.reachable(cell)) continue;
      REQUIRE(field.value(cell) <= grid_moves[cell] + 1e-9);
      REQUIRE(field.value(cell) >= distance(view.center(cell), at) - 1e-9);
    }
  }
}

TEST_CASE("a navigation field from some starts is the whole field where it knows", "[toolkit]") {
  Stream stream(6, "starts");
  NavigationField whole, part;
  int known = 0, unknown = 0;
  for (int i = 0; i < 40; ++i) {
    const TestGrid grid(random_rows(stream, 60, 50, 0.25), 0.2);
    const GridView view = grid.view();
    const Rectangle target = {{6.0, 5.0}, {6.6, 5.4}};
    const std::vector<dmrp_vec2> starts = {view.center(static_cast<std::uint32_t>(stream.below(view.size()))),
                                           {5.1, 4.3}};
    whole.compute(view, target);
    part.compute_from(view, starts, target);
    for (const dmrp_vec2 start : starts) CHECK(part.knows(start));
    for (int k = 0; k < 300; ++k) {
      const dmrp_vec2 point = {stream.uniform(0.0, 12.0), stream.uniform(0.0, 10.0)};
      unknown += !part.knows(point);
      if (!part.knows(point)) continue;
      ++known;
      REQUIRE(part.direction(point) == whole.direction(point));
      REQUIRE(part.value(point) == whole.value(point));
    }
  }
  CHECK(known > 1000);
  CHECK(unknown > 1000);
}

TEST_CASE("following a navigation field takes about the length that it gives", "[toolkit]") {
  Stream stream(4, "walks");
  NavigationField field;
  int walks = 0;
  for (int i = 0; i < 10; ++i) {
    const TestGrid grid(random_rows(stream, 30, 30, 0.15), 0.2);
    const GridView view = grid.view();
    const Rectangle target = {{2.5, 2.5}, {3.1, 2.9}};
    field.compute(view, target, i % 2 == 0 ? NavigationCost{} : NavigationCost{0.4, 2.0});
    for (int k = 0; k < 20; ++k) {
      const dmrp_vec2 from = {stream.uniform(0.0, 6.0), stream.uniform(0.0, 6.0)};
      const std::uint32_t cell = view.index_of(from);
      if (!field.reachable(cell)) continue;
      const double promised = field.value(from);
      REQUIRE(walk(field, from, target, 50.0) <= 1.1 * promised + 0.4);
      ++walks;
    }
  }
  CHECK(walks > 100);
}

TEST_CASE("a navigation field goes round a wall and through a door", "[toolkit]") {
  const TestGrid grid({".....#.....",  //
                       ".....#.....",  //
                       ".....#.....",  //
                       "...........",  //
                       ".....#....."});
  NavigationField field;
  field.compute(grid.view(), point_target({9.5, 4.5}));
  CHECK(field.direction(dmrp_vec2{4.5, 4.5}).y < -0.5);  // down toward the door
  const double through_door =
      distance(dmrp_vec2{1.5, 4.5}, dmrp_vec2{5.5, 1.5}) + distance(dmrp_vec2{5.5, 1.5}, dmrp_vec2{9.5, 4.5});
  CHECK(field.value(dmrp_vec2{1.5, 4.5}) > through_door - 0.5);
  CHECK(field.value(dmrp_vec2{1.5, 4.5}) < 1.2 * through_door);
  // From inside the wall: to the nearest cell that has a way, and on from there.
  const dmrp_vec2 in_wall = {5.2, 3.5};
  CHECK(distance(field.direction(in_wall), dmrp_vec2{-1.0, 0.0}) < 1e-12);
  CHECK(field.value(in_wall) == Approx(field.value(grid.view().index_of({4.5, 3.5})) + 0.7));
  CHECK(field.direction(dmrp_vec2{-3.0, 1.5}).x == Approx(1.0));  // from outside the grid
}

TEST_CASE("a wall between two free cells cuts a navigation field", "[toolkit]") {
  TestGrid grid(empty_rows(4, 1));
  grid.edges[1] &= static_cast<std::uint8_t>(~DMRP_EDGE_E);
  grid.edges[2] &= static_cast<std::uint8_t>(~DMRP_EDGE_W);
  grid.clearance = {1.5f, 0.5f, 0.5f, 1.5f};
  grid.c.clearance = grid.clearance.data();
  NavigationField field;
  field.compute(grid.view(), point_target({0.5, 0.5}));
  CHECK(field.reachable(1));
  CHECK_FALSE(field.reachable(2));
  CHECK_FALSE(field.reachable(3));
}

TEST_CASE("a navigation field without a way is unreachable", "[toolkit]") {
  const TestGrid grid({"..#.",  //
                       "..#."});
  NavigationField field;
  field.compute(grid.view(), point_target({2.5, 0.5}));  // touches no free cell
  CHECK(field.value(dmrp_vec2{0.5, 0.5}) == NavigationField::unreachable);
  CHECK(field.direction(dmrp_vec2{0.5, 0.5}) == dmrp_vec2{0.0, 0.0});
  field.compute(grid.view(), std::vector<Rectangle>{});
  CHECK_FALSE(field.reachable(0));
  field.compute(grid.view(), point_target({3.5, 0.5}));
  CHECK(field.reachable(3));
  CHECK_FALSE(field.reachable(0));
  // Of several targets the nearest counts.
  field.compute(grid.view(), {point_target({3.5, 0.5}), point_target({0.5, 0.5})});
  CHECK(field.value(dmrp_vec2{1.5, 0.5}) == Approx(1.0));
}

TEST_CASE("navigation fields of mirrored grids mirror each other, to the bit", "[toolkit]") {
  Stream stream(5, "mirror");
  const std::vector<std::string> rows = random_rows(stream, 20, 15, 0.2);
  std::vector<std::string> mirrored = rows;
  for (std::string& row : mirrored) std::reverse(row.begin(), row.end());
  const TestGrid grid(rows);
  const TestGrid mirror(mirrored);
  NavigationField field;
  NavigationField mirror_field;
  field.compute(grid.view(), Rectangle{{3.0, 3.0}, {6.0, 5.0}}, {2.0, 3.0});
  mirror_field.compute(mirror.view(), Rectangle{{14.0, 3.0}, {17.0, 5.0}}, {2.0, 3.0});
  for (std::int32_t row = 0; row < 15; ++row)
    for (std::int32_t column = 0; column < 20; ++column)
      REQUIRE(field.value(grid.view().index({column, row})) ==
              mirror_field.value(mirror.view().index({19 - column, row})));
}

TEST_CASE("wall costs keep ways away from walls", "[toolkit]") {
  // A block in the middle: the shortest way grazes it, the comfortable one keeps off.
  std::vector<std::string> rows = empty_rows(41, 41);
  for (std::size_t row = 10; row < 31; ++row) rows[row].replace(18, 5, "#####");
  const TestGrid grid(rows, 0.25);
  const auto least_clearance = [&](NavigationCost cost) {
    NavigationField field;
    field.compute(grid.view(), point_target({9.1, 4.6}), cost);
    dmrp_vec2 at = {1.1, 4.8};
    float least = std::numeric_limits<float>::infinity();
    for (int i = 0; i < 2000 && distance(at, dmrp_vec2{9.1, 4.6}) > 0.1; ++i) {
      at += 0.02 * field.direction(at);
      least = std::min(least, grid.view().clearance(grid.view().index_of(at)));
    }
    CHECK(distance(at, dmrp_vec2{9.1, 4.6}) <= 0.1);
    return least;
  };
  CHECK(least_clearance({}) < 0.3f);
  CHECK(least_clearance({1.5, 5.0}) > 0.7f);
}

TEST_CASE("robots snap to the cell they were heading for, else to the nearest", "[toolkit]") {
  const TestGrid grid(empty_rows(6, 6));
  const GridView view = grid.view();
  const auto anywhere = [](dmrp_vec2, dmrp_vec2) { return true; };
  const auto snapped = [&](const std::vector<SnapRequest>& requests) {
    return snap_to_cells(view, requests, 1.5, anywhere);
  };
  using Cells = std::vector<std::uint32_t>;
  CHECK(*snapped({{{1.4, 0.5}, 2}}) == Cells{2});
  CHECK(*snapped({{{1.4, 0.5}, no_cell}}) == Cells{1});
  // Two head for one cell: each goes to its own nearest.
  CHECK(*snapped({{{1.4, 0.5}, 2}, {{3.6, 0.5}, 2}}) == Cells{1, 3});
  // Two would share one.
  CHECK_FALSE(snapped({{{1.4, 0.5}, no_cell}, {{1.6, 0.5}, no_cell}}));
  CHECK_FALSE(snapped({{{1.4, 0.5}, no_cell}, {{0.6, 0.5}, 1}}));
  // Equally near: the lowest index.
  CHECK(*snapped({{{2.0, 2.0}, no_cell}}) == Cells{7});
  CHECK_FALSE(snapped({{{-4.0, 2.0}, no_cell}}));  // too far off
  CHECK(snapped({})->empty());
}

TEST_CASE("snapping respects walls, and a robot that touches one can still leave", "[toolkit]") {
  // Cell 1 is nearer, but a thin wall stands between; cell 0 is not free.
  TestGrid grid({"#..",  //
                 "#.."});
  const std::vector<dmrp_vec2> wall = {{1.9, 0.0}, {2.0, 0.0}, {2.0, 1.2}, {1.9, 1.2}};
  dmrp_shape shape = {};
  shape.kind = DMRP_SHAPE_POLYGON;
  shape.vertices = wall.data();
  shape.vertex_count = 4;
  const std::vector<dmrp_shape> shapes = {shape};
  const Rectangle border = {{0.0, 0.0}, {3.0, 2.0}};
  const auto snapped = [&](SnapRequest request) {
    return snap_to_cells(grid.view(), {request}, 2.0, 0.25, shapes, border);
  };
  using Cells = std::vector<std::uint32_t>;
  const dmrp_vec2 right_of_wall = {2.2, 0.5};  // 0.2 m from the wall, its radius is 0.25 m
  CHECK(*snapped({right_of_wall, no_cell}) == Cells{2});
  CHECK(*snapped({right_of_wall, 1}) == Cells{2});
  CHECK(*snapped({{1.45, 0.5}, 2}) == Cells{1});
  grid.free[1] = 0;
  grid.free[2] = 0;
  CHECK(*snapped({{1.45, 0.5}, no_cell}) == Cells{4});
}

TEST_CASE("SVG numbers are short and well-formed", "[toolkit]") {
  CHECK(format_svg_number(0.0) == "0");
  CHECK(format_svg_number(-0.001) == "0");
  CHECK(format_svg_number(12.0) == "12");
  CHECK(format_svg_number(12.5) == "12.5");
  CHECK(format_svg_number(-12.345) == "-12.35");
  CHECK(format_svg_number(0.05) == "0.05");
  CHECK(format_svg_number(1e9) == "1000000000");
}

TEST_CASE("text for SVG is escaped", "[toolkit]") {
  CHECK(escape_xml("shops & <stalls>, \"R\x01\"") == "shops &amp; &lt;stalls&gt;, &quot;R &quot;");
}

TEST_CASE("neighbouring series have different colours", "[toolkit]") {
  std::set<std::string_view> colors;
  for (std::size_t i = 0; i < 8; ++i) colors.insert(series_color(i));
  CHECK(colors.size() == 8);
  CHECK(series_color(8) == series_color(0));
}

}  // namespace grid_test
