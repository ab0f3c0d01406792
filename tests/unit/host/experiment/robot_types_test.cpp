// SPDX-License-Identifier: MIT
// Types of robot in experiment and scenario files.
#include <catch2/catch.hpp>

#include "core/scene/footprint.hpp"
#include "host/errors/input_error.hpp"
#include "host/world/variant_world.hpp"
#include "tests/unit/host/experiment/experiment_example.hpp"

namespace robot_types_test {

using namespace dmrp::test;
using namespace dmrp::host;
using dmrp::core::Drive;
using dmrp::core::RobotSettings;

const std::string transporter = R"(
[robot_type.transporter]
footprint = { vertices_m = [[-0.6, -0.3], [0.6, -0.3], [0.6, 0.3], [-0.6, 0.3]] }
v_max = 0.5
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

std::string message_of(const std::string& more_experiment, const std::string& scenario = scenario_text) {
  const ExperimentFolder folder;
  write_file("hall/scenario.toml", scenario);
  try {
    load(experiment_text + more_experiment);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string with_type(const std::string& type) {
  return replaced(scenario_text, "start = [0.5, 0.5]\ngoal = [9.5, 0.5]",
                  "type = \"" + type + "\"\nstart = [1.5, 1.5]\ngoal = [8.5, 1.5]");
}

TEST_CASE("a type takes what it does not say from [robot]") {
  const ExperimentFolder folder;
  const Experiment e = load(experiment_text + std::string("\n[robot]\na_max = 2.0\n") + transporter);
  REQUIRE(e.robot_types.size() == 1);
  const RobotSettings& type = e.robot_types[0];
  CHECK(type.type == "transporter");
  CHECK(type.v_max == 0.5);
  CHECK(type.a_max == 2.0);
  CHECK(type.radius_m == Approx(std::hypot(0.6, 0.3)));
  CHECK(dmrp::core::inscribed_radius(type) == Approx(0.3));
}

TEST_CASE("a scenario's robots name types of the scenario or of the experiment, which wins") {
  const ExperimentFolder folder;
  const std::string scenario = with_type("cleaner") + "\n[robot_type.cleaner]\nfootprint = { radius_m = 0.3 }\n";
  write_file("hall/scenario.toml", scenario);
  const Experiment own = load(experiment_text);
  CHECK(own.scenarios[0].types.of(own.scenarios[0].scenario.robots[0]).radius_m == 0.3);
  CHECK(own.scenarios[0].types.of(own.scenarios[0].scenario.robots[1]).radius_m == 0.25);
  const Experiment other =
      load(experiment_text + std::string("\n[robot_type.cleaner]\nfootprint = { radius_m = 0.35 }\n"));
  CHECK(other.scenarios[0].types.of(other.scenarios[0].scenario.robots[0]).radius_m == 0.35);
}

TEST_CASE("the world and the planner see each robot's type") {
  const ExperimentFolder folder;
  write_file("hall/scenario.toml", with_type("transporter"));
  const Experiment e = load(experiment_text + transporter);
  const VariantWorld variant(e, e.scenarios[0]);
  const dmrp_world& world = variant.view.world();
  const dmrp_robot& robot = *DMRP_AT(dmrp_robot, world.robots, world.robot_stride, 0);
  CHECK(std::string(robot.type) == "transporter");
  CHECK(robot.limits->v_max == 0.5);
  REQUIRE(robot.footprint->part_count == 1);
  CHECK(robot.footprint->parts[0].vertex_count == 4);
  CHECK(robot.footprint->inscribed_radius_m == Approx(0.3));
  CHECK(variant.planning_grids->of("transporter").free != variant.planning_grids->standard().free);
}

TEST_CASE("the effective experiment has the types") {
  const ExperimentFolder folder;
  const Experiment e = load(experiment_text + transporter + "[robot_type.\"my car\"]\ndrive = \"differential\"\n");
  const std::string text = effective_toml(e);
  write_file("effective.toml", text);
  const Experiment again = load(text);
  REQUIRE(again.robot_types.size() == 2);
  CHECK(again.robot_types[0].parts == e.robot_types[0].parts);
  CHECK(again.robot_types[1].type == "my car");
  CHECK(effective_toml(again) == text);
}

TEST_CASE("drawn robots get types by their shares") {
  const ExperimentFolder folder;
  const std::string text = replaced(experiment_text + transporter, "use = \"./hall/scenario.toml\"",
                                    "use = \"./hall/scenario.toml\"\nrobots = 3\ntasks = \"drawn\"\n"
                                    "types = { transporter = 1, default = 2 }");
  write_file("hall/scenario.toml", replaced(scenario_text, "size_m = [10.0, 8.0]", "size_m = [20.0, 18.0]"));
  const Experiment e = load(text);
  const VariantWorld shared(e, e.scenarios[0]);
  const VariantWorld drawn(e, e.scenarios[0], shared, 5);
  REQUIRE(drawn.scenario.robots.size() == 3);
  CHECK(drawn.scenario.robots[0].type == "");
  CHECK(drawn.scenario.robots[1].type == "transporter");
  CHECK(drawn.scenario.robots[2].type == "");
  CHECK(effective_toml(e).find("types  = { transporter = 1.0, default = 2.0 }") != std::string::npos);
}

TEST_CASE("a bad type gets one line") {
  using Catch::EndsWith;
  const auto footprint = [](const std::string& value) {
    return message_of("\n[robot_type.t]\nfootprint = " + value + "\n");
  };
  CHECK_THAT(footprint("{ vertices_m = [[-1, -1], [1, 1], [1, -1], [-1, 1]] }"),
             EndsWith("21:28: the footprint's polygon crosses itself: its sides 1 and 3 meet"));
  CHECK_THAT(footprint("{ vertices_m = [[-1, -1], [1, -1], [0.1, 0], [1, 1], [-1, 1]] }"),
             EndsWith("the footprint's polygon must be convex (a concave footprint is a list of convex 'parts_m')"));
  CHECK_THAT(footprint("{ vertices_m = [[1, 1], [2, 1], [2, 2]] }"),
             EndsWith("the footprint must contain the robot's origin (0, 0), about which it turns"));
  CHECK_THAT(footprint("{ radius_m = 0.2, vertices_m = [[-1, -1], [1, -1], [0, 1]] }"),
             EndsWith("'footprint' must have one of radius_m, vertices_m and parts_m"));
  CHECK_THAT(footprint("{ vertices = [] }"), EndsWith("did you mean 'vertices_m'?)"));
  CHECK_THAT(message_of("\n[robot]\nvertices_m = [[0, 0]]\n"),
             EndsWith("unknown key 'vertices_m' in [robot] (it is a key of [robot.footprint])"));
  CHECK_THAT(message_of("", replaced(scenario_text, "start = [0.5, 0.5]", "footprint = 1\nstart = [0.5, 0.5]")),
             EndsWith("unknown key 'footprint' in [[robot]] (it is a key of [robot_type.NAME])"));
  CHECK_THAT(message_of("\n[robot_type.car]\ndrive = \"ackermann\"\n"),
             EndsWith("drive = 'ackermann' needs 'wheelbase_m'"));
  CHECK_THAT(message_of("\n[robot_type.car]\ndrive = \"ackermann\"\nwheelbase_m = 0\n"),
             EndsWith("'wheelbase_m' must be positive, not 0"));
  CHECK_THAT(message_of("\n[robot_type.car]\nwheelbase_m = 0.5\n"),
             EndsWith("'wheelbase_m' belongs to drive = 'ackermann', but the drive is 'differential'"));
  CHECK_THAT(message_of(transporter, with_type("transprter")),
             EndsWith("robot 0 has the unknown type 'transprter' (did you mean 'transporter'? there: transporter)"));
  CHECK_THAT(message_of("", with_type("x")),
             EndsWith("robot 0 has the unknown type 'x' (there: no [robot_type.NAME])"));
  CHECK_THAT(message_of("\n[robot_type.t]\ndrive = \"holonomic\"\n", with_type("t")),
             EndsWith("test.controller cannot drive robots with a holonomic drive (type 't' in scenario 'hall')"));
  // wider than the way round the wall at the border: 2 m
  CHECK_THAT(message_of("\n[robot_type.wide]\nfootprint = { vertices_m = [[-0.1, -1.1], [0.1, -1.1], [0.1, 1.1], "
                        "[-0.1, 1.1]] }\n",
                        with_type("wide")),
             Catch::Contains("robot 0 "));
}

}  // namespace robot_types_test
