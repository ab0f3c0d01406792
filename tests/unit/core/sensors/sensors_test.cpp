// SPDX-License-Identifier: MIT
// Lidar, visible agents, local costmap and its distance field.
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/ray_cast.hpp>
#include <limits>
#include <numbers>

#include "core/sensors/costmap.hpp"
#include "core/sensors/lidar.hpp"
#include "core/sensors/sensor_noise.hpp"
#include "core/sensors/visibility.hpp"
#include "core/world/world.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

namespace {

constexpr double pi = std::numbers::pi;
constexpr float nothing = std::numeric_limits<float>::infinity();

std::vector<float> scan_once(const LidarSettings& settings, const Scenario& scenario, const dmrp_pose& sensor,
                             const std::vector<Disc>& bodies = {}) {
  Lidar lidar(settings, geometry_of(scenario));
  std::vector<float> ranges(lidar.beams());
  lidar.scan(sensor, bodies, ranges);
  return ranges;
}

}  // namespace

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

TEST_CASE("out of range is infinite, and what is too near reads as the least range") {
  Scenario scenario = empty_scenario(50, 50);
  scenario.shapes = {box("post", {25.1, 24.9}, {25.3, 25.1})};
  LidarSettings settings;
  settings.beams = 4;
  settings.range_min_m = 0.2;
  const std::vector<float> ranges = scan_once(settings, scenario, {25, 25, 0});
  CHECK(ranges[0] == nothing);
  CHECK(ranges[2] == Approx(0.2));
}

TEST_CASE("a field of view that is no full circle ends with a beam on either side") {
  LidarSettings settings;
  settings.beams = 3;
  settings.field_of_view_rad = pi;
  Scenario scenario = empty_scenario(12, 8);
  Lidar lidar(settings, geometry_of(scenario));
  std::vector<float> ranges(3);
  lidar.scan({4, 3, 0}, {}, ranges);
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

TEST_CASE("scans agree with casting every beam at everything") {
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
      lidar.scan(sensor, bodies, ranges);
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

TEST_CASE("robots scan and see others as the tracking allows") {
  Scenario scenario = empty_scenario(40, 10);
  scenario.shapes = {box("wall", {9, 0}, {9.2, 4})};
  scenario.robots = {robot({5, 2, 0}, dmrp_vec2{38, 2}), robot({12, 2, 0}, dmrp_vec2{38, 2}),
                     robot({5, 8, 0}, dmrp_vec2{38, 8}), robot({25, 8, 0}, dmrp_vec2{38, 8})};
  scenario.regions = {{"south", {6, 5}, {7, 6}}, {"far", {38, 5}, {39, 9}}};
  scenario.flows = {{"east", {0, 1}, 1}};
  SimulationSettings settings;
  settings.tracking = Tracking::visible;
  const auto geometry = geometry_of(scenario);
  World world(scenario, RobotSettings{}, settings, geometry, 1);
  Lidar lidar(RobotSettings{}.lidar, geometry);
  std::vector<float> ranges(lidar.beams());
  scan_from(world, 0, lidar, ranges);
  CHECK(ranges[180] == Approx(4.0));                // straight ahead: the wall hides the second robot
  CHECK(ranges[270] == Approx(5.75).margin(0.01));  // to the left: the third

  std::vector<dmrp_agent> agents;
  visible_agents(world, 0, agents);
  REQUIRE_FALSE(agents.empty());
  CHECK(agents[0].kind == DMRP_AGENT_ROBOT);
  CHECK(agents[0].id == 2);
  for (const dmrp_agent& agent : agents) CHECK((agent.kind == DMRP_AGENT_PERSON || agent.id == 2));

  settings.tracking = Tracking::all;
  visible_agents(World(scenario, RobotSettings{}, settings, geometry, 1), 1, agents);
  REQUIRE(agents.size() == 4);
  CHECK(agents[0].id == 0);
  CHECK(agents[2].id == 3);
  CHECK(agents[3].kind == DMRP_AGENT_PERSON);

  settings.tracking = Tracking::none;
  visible_agents(World(scenario, RobotSettings{}, settings, geometry, 1), 1, agents);
  CHECK(agents.empty());
}

TEST_CASE("ranges get normal noise within the lidar's range, and beams drop out") {
  LidarSettings settings;
  settings.beams = 20000;
  settings.range_min_m = 0.5;
  settings.noise_sd_m = 0.1;
  const std::vector<float> exact(settings.beams, 4.0f);
  std::vector<float> ranges = exact;
  disturb_scan(settings, {3, 1, 700}, ranges);
  double sum = 0.0;
  double squares = 0.0;
  for (const float range : ranges) {
    const double error = static_cast<double>(range) - 4.0;
    sum += error;
    squares += error * error;
  }
  CHECK(std::abs(sum / settings.beams) < 0.003);
  CHECK(std::sqrt(squares / settings.beams) == Approx(0.1).margin(0.003));

  // drop-outs change no other beam
  const std::vector<float> noisy = ranges;
  settings.dropout_share = 0.25;
  ranges = exact;
  disturb_scan(settings, {3, 1, 700}, ranges);
  int dropped = 0;
  int changed = 0;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (std::isinf(ranges[i])) {
      ++dropped;
    } else if (ranges[i] != noisy[i]) {
      ++changed;
    }
  }
  CHECK(dropped == Approx(5000).margin(250));
  CHECK(changed == 0);

  // another time, another robot: other noise
  settings.dropout_share = 0.0;
  for (const Reading& other : {Reading{3, 1, 701}, Reading{3, 2, 700}, Reading{4, 1, 700}}) {
    ranges = exact;
    disturb_scan(settings, other, ranges);
    CHECK(ranges != noisy);
  }

  // hits stay hits, misses misses
  ranges = {0.5f, 10.0f, nothing};
  settings.noise_sd_m = 5.0;
  disturb_scan(settings, {3, 1, 700}, ranges);
  for (int i : {0, 1}) CHECK((ranges[i] >= 0.5f && ranges[i] <= 10.0f));
  CHECK(ranges[2] == nothing);

  ranges = exact;
  disturb_scan(LidarSettings{}, {3, 1, 700}, ranges);
  CHECK(ranges == exact);
}

TEST_CASE("an agent's velocity noise is its own, whoever else is seen") {
  const auto agent = [](std::uint64_t id, std::uint32_t kind) {
    dmrp_agent made{};
    made.id = id;
    made.kind = kind;
    made.velocity = {1.0, -0.5};
    return made;
  };
  std::vector<dmrp_agent> few = {agent(2, DMRP_AGENT_PERSON)};
  std::vector<dmrp_agent> many = {agent(2, DMRP_AGENT_ROBOT), agent(1, DMRP_AGENT_PERSON), agent(2, DMRP_AGENT_PERSON)};
  disturb_agents(0.1, {1, 0, 50}, few);
  disturb_agents(0.1, {1, 0, 50}, many);
  CHECK(few[0].velocity == many[2].velocity);
  CHECK(few[0].velocity != dmrp_vec2{1.0, -0.5});
  CHECK(many[0].velocity != many[2].velocity);
  CHECK(many[1].velocity != many[2].velocity);

  double squares = 0.0;
  for (std::int64_t t = 0; t < 5000; ++t) {
    std::vector<dmrp_agent> one = {agent(1, DMRP_AGENT_PERSON)};
    disturb_agents(0.1, {1, 0, t}, one);
    squares += toolkit::squared_distance(one[0].velocity, {1.0, -0.5});
  }
  CHECK(std::sqrt(squares / 10000.0) == Approx(0.1).margin(0.004));
  disturb_agents(0.0, {1, 0, 50}, few);
  CHECK(few[0].velocity == many[2].velocity);
}

namespace {

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
    lidar->scan(sensor, bodies, ranges);
    map.update(sensor, lidar->describe(5, ranges));
  }

  // With noise, as at this time.
  void look_dimly(const dmrp_pose& sensor, std::int64_t t_ns, const std::vector<Disc>& bodies = {}) {
    lidar->scan(sensor, bodies, ranges);
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

}  // namespace

TEST_CASE("what a scan hits is lethal, the rest falls off around it") {
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

TEST_CASE("somebody who walks on leaves no trail, and what is out of sight is remembered") {
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

TEST_CASE("a lidar that looks ahead clears and marks what is ahead, the rest is remembered") {
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

TEST_CASE("beams without return clear, so that nobody leaves a trail before an open hall") {
  Mapping mapping(empty_scenario(60, 60));
  mapping.look_from({30, 30, 0}, {{{31.5, 30}, 0.3}});
  CHECK(mapping.cost_at({31.22, 30.0}) == DMRP_COST_LETHAL);
  mapping.look_from({30, 30, 0});
  REQUIRE(std::isinf(mapping.ranges[180]));
  CHECK(mapping.cost_at({31.22, 30.0}) == DMRP_COST_FREE);
}

TEST_CASE("drop-outs erase no obstacle, seen or hidden, and trails still vanish") {
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

TEST_CASE("the window rolls on the world's lattice and keeps what it holds") {
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
