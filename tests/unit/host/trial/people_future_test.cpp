// SPDX-License-Identifier: MIT
// draft/dmrp.people_future/1: a controller that compares what it was told with what it sees (trial_plugins.cpp).
#include "host/trial/people_future.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/host/trial/stage.hpp"

namespace core = dmrp::core;
namespace test = dmrp::test;

namespace {

// Two robots, and people who walk beside their ways.
core::Scenario hall_with_people() {
  core::Scenario scenario = test::hall(2);
  scenario.people.radius_m = 0.2;
  scenario.regions = {{"west", {0.4, 4.4}, {3.0, 5.6}}, {"east", {7.0, 4.4}, {9.6, 5.6}}};
  scenario.flows = {{"eastward", {0, 1}, 3}};
  scenario.time_limit_s = 12.0;
  return scenario;
}

struct ToldStage : test::Stage {
  explicit ToldStage(bool shy)
      : Stage(DMRP_TRIAL_PLUGINS, {"test.planner.straight", "test.controller.told", "test.people.strolling", ""},
              hall_with_people()) {
    experiment.pedestrian_models[0].parameters[0].integer = shy;
    experiment.local_controllers[0].parameters[0].integer = shy;
  }
};

}  // namespace

TEST_CASE("people who take no notice of robots are where the controller was told they would be") {
  ToldStage stage(false);
  REQUIRE_NOTHROW(stage.run());
  REQUIRE_NOTHROW(stage.run());  // the same instances, from the start
  CHECK(stage.reader->end());
}

TEST_CASE("a controller is told of the crowd without robots") {
  ToldStage stage(true);
  REQUIRE_NOTHROW(stage.run());
  CHECK(stage.reader->end());
}
