// SPDX-License-Identifier: MIT
#include "core/sensors/visibility.hpp"

#include <catch2/catch.hpp>
#include <vector>

#include "core/world/world.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

namespace visibility_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

TEST_CASE("robots scan the world and observe agents according to the tracking") {
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
  Sight sight(world);
  sight.scan_from(0, lidar, ranges);
  CHECK(ranges[180] == Approx(4.0));                // straight ahead: the wall hides the second robot
  CHECK(ranges[270] == Approx(5.75).margin(0.01));  // to the left: the third

  std::vector<dmrp_agent> agents;
  sight.visible_agents(0, agents);
  REQUIRE_FALSE(agents.empty());
  CHECK(agents[0].kind == DMRP_AGENT_ROBOT);
  CHECK(agents[0].id == 2);
  for (const dmrp_agent& agent : agents) CHECK((agent.kind == DMRP_AGENT_PERSON || agent.id == 2));

  settings.tracking = Tracking::all;
  const World all(scenario, RobotSettings{}, settings, geometry, 1);
  Sight(all).visible_agents(1, agents);
  REQUIRE(agents.size() == 4);
  CHECK(agents[0].id == 0);
  CHECK(agents[2].id == 3);
  CHECK(agents[3].kind == DMRP_AGENT_PERSON);

  settings.tracking = Tracking::none;
  const World none(scenario, RobotSettings{}, settings, geometry, 1);
  Sight(none).visible_agents(1, agents);
  CHECK(agents.empty());
}

}  // namespace visibility_test
