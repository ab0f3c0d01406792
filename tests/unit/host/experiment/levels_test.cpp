// SPDX-License-Identifier: MIT
// Scenarios with levels and jittered starts.
#include <catch2/catch.hpp>
#include <cmath>

#include "host/errors/input_error.hpp"
#include "host/toml/expression.hpp"
#include "host/world/variant_world.hpp"
#include "tests/unit/host/experiment/experiment_example.hpp"

namespace levels_test {

using namespace dmrp::test;
using namespace dmrp::host;

const std::string graded_hall = R"([scenario]
name = "hall"
title = "Hall"
description = "a door"
size_m = [10.0, 5.0]

[grade]
quantity = "width of the door"
unit = "m"
harder = "lower"
levels = [1.0, 2.0]
robots = "level"

[[box]]
name = "south"
center_m = [5.0, "(2.5 - level / 2) / 2"]
size_m = [0.2, "2.5 - level / 2"]

[[robot]]
start = [1.5, 2.5]
goal = [8.5, 2.5]

[[robot]]
start = [1.5, 4.5]
goal = [8.5, 4.5]
)";

std::string alone(const std::string& lines) {
  const std::string experiment = with(experiment_text, "[[pedestrian_model]]\nuse = \"test.model\"\n", "");
  return with(experiment, "scenario.toml\"\n", "scenario.toml\"\n" + lines);
}

std::string message_of(const std::string& experiment) {
  try {
    load(experiment);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST_CASE("formulas of a level") {
  CHECK(evaluate_expression("5 - level / 2", 3.0) == 3.5);
  CHECK(evaluate_expression("-(1 + 2) * 3 - -level", 4.0) == -5.0);
  CHECK(evaluate_expression("8 / 2 / 2", 0.0) == 2.0);
  CHECK(evaluate_expression("round(10 * level) + floor(1.9) + sqrt(4)", 0.16) == 5.0);
  CHECK(evaluate_expression("cos(pi)", 0.0) == -1.0);
  for (const char* wrong : {"", "1 +", "(1", "1 2", "width", "sin 1", "1 / 0", "level level"})
    CHECK_THROWS_AS(evaluate_expression(wrong, 1.0), std::invalid_argument);
  CHECK_THROWS_AS(evaluate_expression(std::string(100'000, '('), 1.0), std::invalid_argument);
  CHECK_THROWS_AS(evaluate_expression(std::string(100'000, '-') + "1", 1.0), std::invalid_argument);
}

TEST_CASE("a scenario with levels is a scenario for each") {
  const ExperimentFolder folder;
  write_file("hall/scenario.toml", graded_hall);
  const Experiment all = load(alone(""));
  REQUIRE(all.scenarios.size() == 2);
  CHECK(all.scenarios[0].scenario.name == "hall 1");
  CHECK(all.scenarios[0].grade.series == "hall");
  CHECK(all.scenarios[0].grade.level == 1.0);
  CHECK_FALSE(all.scenarios[0].grade.harder_when_higher);
  CHECK(all.scenarios[0].scenario.shapes[0].vertices[2].y == Approx(2.0));
  CHECK(all.scenarios[1].scenario.shapes[0].vertices[2].y == Approx(1.5));
  CHECK(all.scenarios[0].scenario.robots.size() == 1);
  CHECK(all.scenarios[1].scenario.robots.size() == 2);
  const Experiment one = load(alone("levels = [2]\n"));
  REQUIRE(one.scenarios.size() == 1);
  CHECK(one.scenarios[0].scenario.shapes[0].vertices[2].y == Approx(1.5));
  CHECK(message_of(alone("levels = [1.5]\n")) == "hall/scenario.toml:12:10: 'robots' must be an integer, not 1.5");

  write_file("elsewhere/effective.toml", effective_toml(all));
  const Experiment again = load_experiment("elsewhere/effective.toml", 0, &fake_probe);
  CHECK(effective_toml(again) == effective_toml(all));
  CHECK(identity_digest(again) == identity_digest(all));

  CHECK(message_of(alone("levels = []\n")) == "experiment.toml:9:10: 'levels' must have at least one number");
  write_file("hall/scenario.toml", with(graded_hall, "\"2.5 - level / 2\"]", "\"2.5 - with / 2\"]"));
  CHECK_THAT(message_of(alone("")), Catch::EndsWith("scenario.toml:17:16: 'size_m' is no formula: expected a number, "
                                                    "'level', 'pi', sin, cos, sqrt, floor or round before 'with / 2'"));
  write_file("hall/scenario.toml", scenario_text);
  CHECK(message_of(alone("levels = [1]\n")) == "experiment.toml:9:1: 'levels' are those of a scenario with [grade]");
}

TEST_CASE("starts are displaced within the jitter, each repetition anew, and stay on their cells") {
  const ExperimentFolder folder;
  write_file("hall/scenario.toml", graded_hall);
  const Experiment e = load(alone("levels = [2]\nstart_jitter = { position_m = 0.1, heading_rad = 0.2 }\n"));
  const ScenarioVariant& variant = e.scenarios[0];
  REQUIRE(is_drawn(variant));
  const VariantWorld shared(e, variant);
  double farthest_m = 0.0;
  double most_turned = 0.0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const VariantWorld world(e, variant, shared, seed);
    const VariantWorld same(e, variant, shared, seed);
    REQUIRE(world.scenario.robots.size() == 2);
    const dmrp_pose start = world.scenario.robots[1].start;
    CHECK(start.x == same.scenario.robots[1].start.x);
    const double off_m = std::hypot(start.x - 1.5, start.y - 4.5);
    CHECK(off_m <= 0.1);
    CHECK(std::abs(start.theta) <= 0.2);
    CHECK(world.scenario.robots[1].goals[0].x == 8.5);
    farthest_m = std::max(farthest_m, off_m);
    most_turned = std::max(most_turned, std::abs(start.theta));
  }
  CHECK(farthest_m > 0.08);
  CHECK(most_turned > 0.15);
  CHECK(message_of(alone("start_jitter = { position = 0.1 }\n")) ==
        "experiment.toml:9:18: unknown key 'position' in 'start_jitter' (did you mean 'position_m'?)");
}

}  // namespace levels_test
