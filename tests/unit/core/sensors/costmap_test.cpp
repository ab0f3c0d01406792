// SPDX-License-Identifier: MIT
#include "core/sensors/costmap.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "core/sensors/lidar.hpp"
#include "core/sensors/sensor_noise.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

namespace costmap_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

constexpr double pi = std::numbers::pi;

// A costmap, driven by a lidar in a world.
struct Mapping {
  Scenario scenario;
  RobotSettings settings;
  std::unique_ptr<Lidar> lidar;
  LocalCostmap map;
  std::vector<float> ranges;

  explicit Mapping(const Scenario& world, const LidarSettings& lidar_settings = {})
      : scenario(world),
        lidar(std::make_unique<Lidar>(lidar_settings, geometry_of(world))),
        map(settings.costmap, settings.radius_m, lidar_settings.dropout_share),
        ranges(lidar->beams()) {
    settings.lidar = lidar_settings;
  }

  void look_from(const dmrp_pose& sensor, const std::vector<Disc>& bodies = {}) {
    lidar->scan(sensor, bodies, {}, ranges);
    map.update(sensor, lidar->describe(5, ranges));
  }

  // With noise, as at this time.
  void look_dimly(const dmrp_pose& sensor, std::int64_t t_ns, const std::vector<Disc>& bodies = {}) {
    lidar->scan(sensor, bodies, {}, ranges);
    disturb_scan(settings.lidar, {9, 0, t_ns}, ranges);
    map.update(sensor, lidar->describe(t_ns, ranges));
  }

  // The cost of the cell at a point; -1 outside the window.
  int cost_at(dmrp_vec2 point) const {
    const dmrp_costmap& costs = map.costmap();
    const dmrp_vec2 cells = (point - costs.origin) / costs.resolution_m;
    if (cells.x < 0.0 || cells.y < 0.0 || cells.x >= costs.width || cells.y >= costs.height) return -1;
    return costs.costs[static_cast<std::size_t>(cells.y) * costs.width + static_cast<std::size_t>(cells.x)];
  }
};

TEST_CASE("hits are lethal, and the cost decreases around them") {
  Scenario scenario = empty_scenario(20, 20);
  scenario.shapes = {box("wall", {11.5, 5}, {12.5, 15})};
  Mapping mapping(scenario);
  mapping.look_from({10, 10, 0.3});
  CHECK(mapping.map.costmap().t_ns == 5);
  CHECK(mapping.map.costmap().width == 120);
  CHECK(mapping.cost_at({11.52, 10.02}) == DMRP_COST_LETHAL);
  CHECK(mapping.cost_at({11.42, 10.02}) == DMRP_COST_INSCRIBED);  // 0.1 m away
  CHECK(mapping.cost_at({11.22, 10.02}) == static_cast<int>(252.0 * std::exp(-5.0 * (0.30 - 0.25))));
  CHECK(mapping.cost_at({10.92, 10.02}) == DMRP_COST_FREE);  // 0.6 m away
  CHECK(mapping.cost_at({9.0, 10.0}) == DMRP_COST_FREE);
  CHECK(mapping.cost_at({16.0, 10.0}) == -1);
}

TEST_CASE("a walking person leaves no trail, and hidden cells are remembered") {
  const Scenario scenario = empty_scenario(20, 20);
  Mapping mapping(scenario);
  mapping.look_from({10, 10, 0}, {{{11.5, 10}, 0.3}});
  CHECK(mapping.cost_at({11.22, 10.0}) == DMRP_COST_LETHAL);
  mapping.look_from({10, 10, 0}, {{{11.5, 12}, 0.3}});
  CHECK(mapping.cost_at({11.22, 10.0}) == DMRP_COST_FREE);

  // hidden behind somebody nearer: not seen, so kept
  mapping.map.reset();
  CHECK(mapping.cost_at({11.22, 10.0}) == DMRP_COST_FREE);
  mapping.look_from({10, 10, 0}, {{{12.0, 10}, 0.3}});
  mapping.look_from({10, 10, 0}, {{{11.0, 10}, 0.35}});
  CHECK(mapping.cost_at({10.68, 10.0}) == DMRP_COST_LETHAL);
  CHECK(mapping.cost_at({11.72, 10.0}) == DMRP_COST_LETHAL);
}

TEST_CASE("a lidar with a partial field of view clears and marks only inside it") {
  LidarSettings forward;
  forward.beams = 181;
  forward.field_of_view_rad = pi;
  Mapping mapping(empty_scenario(20, 20), forward);
  mapping.look_from({10, 10, pi}, {{{8.5, 10}, 0.3}});
  CHECK(mapping.cost_at({8.78, 10.0}) == DMRP_COST_LETHAL);
  mapping.look_from({10, 10, 0}, {{{11.5, 10}, 0.3}});  // turned away: the one behind is gone, unseen
  CHECK(mapping.cost_at({11.22, 10.0}) == DMRP_COST_LETHAL);
  CHECK(mapping.cost_at({8.78, 10.0}) == DMRP_COST_LETHAL);
  mapping.look_from({10, 10, pi}, {{{11.5, 10}, 0.3}});
  CHECK(mapping.cost_at({8.78, 10.0}) == DMRP_COST_FREE);
  CHECK(mapping.cost_at({11.22, 10.0}) == DMRP_COST_LETHAL);
}

TEST_CASE("beams without return clear, so a person in front of an open hall leaves no trail") {
  Mapping mapping(empty_scenario(60, 60));
  mapping.look_from({30, 30, 0}, {{{31.5, 30}, 0.3}});
  CHECK(mapping.cost_at({31.22, 30.0}) == DMRP_COST_LETHAL);
  mapping.look_from({30, 30, 0});
  REQUIRE(std::isinf(mapping.ranges[180]));
  CHECK(mapping.cost_at({31.22, 30.0}) == DMRP_COST_FREE);
}

TEST_CASE("drop-outs erase no obstacle, visible or hidden, and trails still vanish") {
  LidarSettings patchy;
  patchy.dropout_share = 0.2;
  Scenario scenario = empty_scenario(60, 60);
  scenario.shapes = {box("wall", {31.5, 20}, {31.7, 40})};
  Mapping mapping(scenario, patchy);
  mapping.look_dimly({30, 30, 0}, 0);
  for (int i = 1; i < 20; ++i) mapping.look_dimly({30, 30, 0}, i);
  const dmrp_costmap costs = mapping.map.costmap();
  const std::vector<std::uint8_t> before(costs.costs, costs.costs + std::size_t{costs.width} * costs.height);
  int lost = 0;
  for (int i = 20; i < 520; ++i) {
    mapping.look_dimly({30, 30, 0}, i);
    for (std::size_t cell = 0; cell < before.size(); ++cell)
      if (before[cell] == DMRP_COST_LETHAL && costs.costs[cell] != DMRP_COST_LETHAL) ++lost;
  }
  CHECK(lost == 0);

  // somebody hides the one behind for long: only drop-outs pass
  for (int i = 520; i < 525; ++i) mapping.look_dimly({30, 30, 0}, i, {{{28.0, 30}, 0.3}});
  CHECK(mapping.cost_at({28.28, 30.0}) == DMRP_COST_LETHAL);
  for (int i = 525; i < 1025; ++i) mapping.look_dimly({30, 30, 0}, i, {{{29.0, 30}, 0.35}});
  CHECK(mapping.cost_at({28.28, 30.0}) == DMRP_COST_LETHAL);
  // both are gone; nothing is there to be hit behind them
  for (int i = 1025; i < 1075; ++i) mapping.look_dimly({30, 30, 0}, i);
  CHECK(mapping.cost_at({29.32, 30.0}) == DMRP_COST_FREE);
  CHECK(mapping.cost_at({28.28, 30.0}) == DMRP_COST_FREE);
}

TEST_CASE("the window rolls on the world's lattice and keeps its cells") {
  Scenario scenario = empty_scenario(20, 20);
  scenario.shapes = {box("post", {11.0, 10.0}, {11.2, 10.2})};
  Mapping mapping(scenario);
  mapping.look_from({10, 10.1, 0});
  CHECK(mapping.cost_at({11.02, 10.1}) == DMRP_COST_LETHAL);

  // from behind a big body the post is not seen, wherever the window goes
  const auto look_blind = [&](dmrp_vec2 place) {
    std::fill(mapping.ranges.begin(), mapping.ranges.end(), 0.05f);
    mapping.map.update({place.x, place.y, 0}, mapping.lidar->describe(6, mapping.ranges));
  };
  for (const dmrp_vec2 place : {dmrp_vec2{9.13, 11.71}, dmrp_vec2{12.99, 8.02}, dmrp_vec2{8.51, 10.27}}) {
    look_blind(place);
    const dmrp_vec2 origin = mapping.map.costmap().origin;
    CHECK(std::abs(std::remainder(origin.x, 0.05)) < 1e-9);
    CHECK(std::abs(std::remainder(origin.y, 0.05)) < 1e-9);
    CHECK(std::abs(origin.x + 3.0 - place.x) <= 0.05);
    CHECK(mapping.cost_at({11.02, 10.1}) == DMRP_COST_LETHAL);
    CHECK(mapping.cost_at({10.82, 10.1}) == DMRP_COST_INSCRIBED);
  }
  // what has left the window is forgotten
  look_blind({4.0, 4.0});
  CHECK(mapping.cost_at({11.02, 10.1}) == -1);
  look_blind({10.0, 8.5});
  CHECK(mapping.cost_at({11.02, 10.1}) == DMRP_COST_FREE);
}

TEST_CASE("far hits clear but do not mark") {
  Scenario scenario = empty_scenario(20, 20);
  scenario.shapes = {box("wall", {12.95, 12.95}, {13.4, 13.4})};  // its corner is 4.17 m away
  Mapping mapping(scenario);
  mapping.look_from({10, 10, 0.25 * pi});
  CHECK(mapping.cost_at({12.97, 12.97}) == DMRP_COST_FREE);
  mapping.look_from({10.3, 10.3, 0.25 * pi});
  CHECK(mapping.cost_at({12.97, 12.97}) == DMRP_COST_LETHAL);
}

// The costmap of costmap_2d in the order of its words: rolls, clears one cell in every column (or row) that a beam's line
// crosses, then marks.
class PlainMap {
 public:
  explicit PlainMap(const CostmapSettings& settings) : settings_(settings), lethal_(side * side) {}

  void update(const dmrp_pose& sensor, const dmrp_scan& scan) {
    const double cell_m = settings_.resolution_m;
    roll_to(std::lround(std::floor(sensor.x / cell_m)) - side / 2,
            std::lround(std::floor(sensor.y / cell_m)) - side / 2);
    const dmrp_vec2 from = {sensor.x / cell_m - static_cast<double>(column_),
                            sensor.y / cell_m - static_cast<double>(row_)};
    for (const bool marks : {false, true})
      for (std::uint32_t beam = 0; beam < scan.count; ++beam) {
        const double range_m = static_cast<double>(scan.ranges[beam]);
        const dmrp_vec2 way =
            dmrp::toolkit::from_angle(sensor.theta + scan.angle_min + beam * scan.angle_increment) / cell_m;
        if (!marks)
          clear(from, from + std::min(range_m, settings_.raytrace_range_m) * way);
        else if (range_m < settings_.obstacle_range_m)
          at(from + (range_m + 1e-4) * way) = true;
      }
  }

  bool is_lethal(std::int64_t cell) const { return lethal_[static_cast<std::size_t>(cell)] != 0; }

  static constexpr std::int64_t side = 120;

 private:
  void roll_to(std::int64_t column, std::int64_t row) {
    std::vector<char> rolled(lethal_.size());
    for (std::int64_t y = 0; y < side; ++y)
      for (std::int64_t x = 0; x < side; ++x) {
        const std::int64_t old_x = x + column - column_, old_y = y + row - row_;
        if (old_x >= 0 && old_x < side && old_y >= 0 && old_y < side)
          rolled[static_cast<std::size_t>(y * side + x)] = lethal_[static_cast<std::size_t>(old_y * side + old_x)];
      }
    lethal_ = rolled;
    column_ = column;
    row_ = row;
  }

  char& at(dmrp_vec2 point) {
    const auto x = static_cast<std::int64_t>(std::floor(point.x)), y = static_cast<std::int64_t>(std::floor(point.y));
    const bool inside = x >= 0 && x < side && y >= 0 && y < side;
    return inside ? lethal_[static_cast<std::size_t>(y * side + x)] : outside_;
  }

  // Up to the edge of the window.
  void clear(dmrp_vec2 from, dmrp_vec2 to) {
    constexpr double least = 1e-9, most = static_cast<double>(side) - 1e-9;
    double share = 1.0;
    for (const auto& [begin, end] : {std::pair(from.x, to.x), std::pair(from.y, to.y)})
      if (end < least || end > most) share = std::min(share, ((end < least ? least : most) - begin) / (end - begin));
    to = from + share * (to - from);
    const dmrp_vec2 way = to - from;
    const bool by_columns = std::abs(way.x) >= std::abs(way.y);
    const double start = by_columns ? from.x : from.y, end = by_columns ? to.x : to.y;
    if (start == end) return void(at(from) = false);
    for (double major = std::floor(std::min(start, end)); major <= std::max(start, end); ++major) {
      const double middle = std::clamp(major + 0.5, std::min(start, end), std::max(start, end));
      at(from + (middle - start) / (end - start) * way) = false;
    }
    at(from) = at(to) = false;
  }

  CostmapSettings settings_;
  std::vector<char> lethal_;
  std::int64_t column_ = 0, row_ = 0;
  char outside_ = 0;
};

TEST_CASE("a scan clears along its beams, and then marks") {
  toolkit::Stream random(5, "scans");
  const CostmapSettings settings;
  LocalCostmap map(settings, 0.25);
  PlainMap plain(settings);
  constexpr std::uint32_t beams = 180;
  std::vector<float> ranges(beams);
  dmrp_pose robot = {0.013, -0.021, 0.3};
  int differing = 0, lethal = 0;
  for (int step = 0; step < 300; ++step) {
    robot = {robot.x + 0.07 * std::cos(robot.theta), robot.y + 0.07 * std::sin(robot.theta), robot.theta + 0.011};
    for (float& range : ranges)
      range = random.uniform(0.0, 1.0) < 0.2 ? std::numeric_limits<float>::infinity()
                                             : static_cast<float>(random.uniform(0.2, 6.0));
    dmrp_scan scan{};
    scan.struct_size = sizeof(scan);
    scan.count = beams;
    scan.angle_min = -pi;
    scan.angle_increment = 2.0 * pi / beams;
    scan.ranges = ranges.data();
    map.update(robot, scan);
    plain.update(robot, scan);
    for (std::int64_t cell = 0; cell < PlainMap::side * PlainMap::side; ++cell) {
      const bool is_lethal = map.costmap().costs[cell] == DMRP_COST_LETHAL;
      lethal += is_lethal;
      differing += is_lethal != plain.is_lethal(cell);
    }
  }
  CHECK(lethal > 10000);
  CHECK(differing == 0);
}

TEST_CASE("costs and distances are those of the nearest lethal cell, exactly") {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Scenario scenario = random_scenario(seed, 12.0, 12);
    Mapping mapping(scenario);
    toolkit::Stream stream(seed, "test.costmap");
    for (int i = 0; i < 5; ++i)
      mapping.look_from({stream.uniform(4, 8), stream.uniform(4, 8), stream.uniform(-pi, pi)});
    const dmrp_costmap costs = mapping.map.costmap();
    const dmrp_field& field = mapping.map.distance_field();
    REQUIRE(field.width == costs.width);
    CHECK(field.origin == costs.origin);
    CHECK(field.t_ns == costs.t_ns);
    std::vector<std::pair<int, int>> lethal;
    const int side = static_cast<int>(costs.width);
    for (int row = 0; row < side; ++row)
      for (int column = 0; column < side; ++column)
        if (costs.costs[row * side + column] == DMRP_COST_LETHAL) lethal.emplace_back(column, row);
    REQUIRE(lethal.size() > 50);
    int wrong_costs = 0;
    int wrong_distances = 0;
    for (int row = 0; row < side; ++row) {
      for (int column = 0; column < side; ++column) {
        int squared = 1 << 30;
        for (const auto& [c, r] : lethal)
          squared = std::min(squared, (c - column) * (c - column) + (r - row) * (r - row));
        const double distance = 0.05 * std::sqrt(squared);
        const int expected = squared == 0               ? 254
                             : distance <= 0.25 + 1e-12 ? 253
                             : distance > 0.55 + 1e-12  ? 0
                                                        : static_cast<int>(252.0 * std::exp(-5.0 * (distance - 0.25)));
        if (std::abs(costs.costs[row * side + column] - expected) > (expected == 0 || expected >= 253 ? 0 : 1))
          ++wrong_costs;
        if (std::abs(static_cast<double>(field.distances_m[row * side + column]) - std::min(distance, 6.0)) > 1e-6)
          ++wrong_distances;
      }
    }
    CHECK(wrong_costs == 0);
    CHECK(wrong_distances == 0);
  }
}

}  // namespace costmap_test
