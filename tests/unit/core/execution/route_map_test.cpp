// SPDX-License-Identifier: MIT
#include "core/execution/route_map.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <utility>
#include <vector>

namespace route_map_test {

using namespace dmrp::core;
namespace toolkit = dmrp::toolkit;

// A costmap of 6 m around the origin with discs of obstacles, inflated as a LocalCostmap does.
struct Surroundings {
  static constexpr std::uint32_t side = 120;
  static constexpr double cell_m = 0.05;
  RobotSettings robot;
  double inscribed_radius_m = 0.25;
  std::vector<dmrp_agent> agents;
  std::vector<std::pair<dmrp_vec2, double>> discs;
  std::vector<std::uint8_t> costs = std::vector<std::uint8_t>(side * side, DMRP_COST_FREE);
  dmrp_costmap costmap{};

  Surroundings() {
    costmap = {sizeof(costmap), side, side, 0, 0, cell_m, {-3.0, -3.0}, inscribed_radius_m, 0.55, 5.0, costs.data()};
  }

  void add_disc(dmrp_vec2 center, double radius_m) {
    discs.push_back({center, radius_m});
    for (std::uint32_t i = 0; i < costs.size(); ++i) {
      const dmrp_vec2 point = {-3.0 + (i % side + 0.5) * cell_m, -3.0 + (i / side + 0.5) * cell_m};
      costs[i] = std::max(costs[i], cost_at(toolkit::distance(point, center) - radius_m));
    }
  }

  std::uint8_t cost_at(double distance_m) const {
    if (distance_m <= 0.0) return DMRP_COST_LETHAL;
    if (distance_m <= inscribed_radius_m) return DMRP_COST_INSCRIBED;
    if (distance_m > 0.55) return DMRP_COST_FREE;
    return static_cast<std::uint8_t>(252.0 * std::exp(-5.0 * (distance_m - inscribed_radius_m)));
  }

  double gap_m(dmrp_vec2 point) const {
    double gap_m = 10.0;
    for (const auto& [center, radius_m] : discs) gap_m = std::min(gap_m, toolkit::distance(point, center) - radius_m);
    return gap_m;
  }

  RouteMap map(bool yields_to_robots = false) const {
    return RouteMap({costmap, agents, {-1.3, 0.0, 0.0}, {1.0, 0.0}, yields_to_robots}, robot);
  }
};

const dmrp_vec2 from = {-1.3, 0.0};
const dmrp_vec2 to = {1.3, 0.0};

double height_at(const std::vector<dmrp_vec2>& way, double x) {
  for (std::size_t i = 1; i < way.size(); ++i)
    if (way[i].x >= x) return way[i - 1].y + (way[i].y - way[i - 1].y) * (x - way[i - 1].x) / (way[i].x - way[i - 1].x);
  return way.back().y;
}

TEST_CASE("where nothing stands the way is straight", "[route]") {
  const auto way = Surroundings().map().way(from, to, {});
  REQUIRE(way);
  CHECK(*way == std::vector<dmrp_vec2>{from, to});
}

TEST_CASE("a way leads past what stands, to within a cell", "[route]") {
  toolkit::Stream random(5, "route map");
  int found = 0;
  for (int world = 0; world < 60; ++world) {
    Surroundings around;
    for (int i = 0; i < 12; ++i)
      around.add_disc({random.uniform(-0.7, 0.7), random.uniform(-2.5, 2.5)}, random.uniform(0.05, 0.3));
    const RouteMap map = around.map();
    const auto way = map.way(from, to, {});
    if (!way) continue;
    ++found;
    CHECK(way->front() == from);
    CHECK(way->back() == to);
    for (std::size_t i = 1; i < way->size(); ++i)
      for (double share = 0.0; share <= 1.0; share += 0.02)
        CHECK(around.gap_m(toolkit::lerp((*way)[i - 1], (*way)[i], share)) > around.inscribed_radius_m - 0.05);
    CHECK(*map.way(from, to, {}) == *way);
  }
  CHECK(found > 20);
}

TEST_CASE("there is no way through a wall, nor out of the cells that are allowed", "[route]") {
  Surroundings around;
  for (double y = -3.0; y <= 3.0; y += 0.1) around.add_disc({0.0, y}, 0.1);
  CHECK_FALSE(around.map().way(from, to, {}));
  Surroundings post;
  post.add_disc({0.0, 0.0}, 0.2);
  CHECK(post.map().way(from, to, {}));
  CHECK_FALSE(post.map().way(from, to, [](dmrp_vec2 point) { return std::abs(point.y) < 0.4; }));
}

TEST_CASE("a robot that does not fit where it is leaves that place", "[route]") {
  Surroundings around;
  around.add_disc({-1.55, 0.0}, 0.1);
  CHECK_FALSE(around.map().fits(from, 0.0));
  CHECK(around.map().way(from, to, {}));
}

TEST_CASE("the robot passes oncoming robots on the right, and leaves the others that move to its controller",
          "[route]") {
  Surroundings around;
  around.add_disc({0.5, 0.0}, 0.2);
  dmrp_agent agent{};
  agent.kind = DMRP_AGENT_ROBOT;
  agent.radius_m = 0.2;
  agent.pose = {0.5, 0.0, 0.0};
  agent.velocity = {-1.0, 0.0};
  around.agents = {agent};
  const auto right = around.map().way(from, to, {});
  REQUIRE(right);
  CHECK(height_at(*right, 0.0) < -0.2);  // it makes half of the room
  CHECK(around.map().of_what_stands().way(from, to, {})->size() == 2);

  around.agents[0].velocity = {0.0, 1.0};
  CHECK(around.map().way(from, to, {})->size() == 2);

  around.agents[0].velocity = {0.0, 0.0};
  CHECK(around.map().way(from, to, {})->size() > 2);
  CHECK(around.map(true).way(from, to, {})->size() == 2);

  around.agents[0].kind = DMRP_AGENT_PERSON;
  CHECK(around.map(true).way(from, to, {})->size() > 2);
  around.agents[0].velocity = {-1.0, 0.0};
  CHECK(around.map().way(from, to, {})->size() == 2);
}

TEST_CASE("a long robot fits where its outline is free", "[route]") {
  Surroundings around;
  around.inscribed_radius_m = 0.2;
  around.robot.radius_m = std::hypot(0.6, 0.2);
  around.robot.parts = {{{-0.6, -0.2}, {0.6, -0.2}, {0.6, 0.2}, {-0.6, 0.2}}};
  around.add_disc({0.0, 0.5}, 0.1);
  CHECK(around.map().fits({0.0, 0.0}, 0.0));
  CHECK_FALSE(around.map().fits({0.0, 0.0}, 1.57));
}

}  // namespace route_map_test
