// SPDX-License-Identifier: MIT
// All mistakes of an experiment and of the files that it names are told in one go, and nothing that only follows from
// one of them.
#include <catch2/catch.hpp>
#include <vector>

#include "host/errors/mistakes.hpp"
#include "tests/unit/host/experiment/experiment_example.hpp"

namespace all_mistakes_test {

using namespace dmrp::test;

using Lines = std::vector<std::string>;

Lines mistakes_of(const std::string& experiment, const std::string& scenario = scenario_text) {
  write_file("hall/scenario.toml", scenario);
  try {
    load(experiment);
  } catch (const dmrp::host::InputErrors& errors) {
    Lines lines;
    for (const auto& mistake : errors.mistakes()) lines.emplace_back(mistake.what());
    return lines;
  } catch (const dmrp::host::InputError& error) {
    return {error.what()};
  }
  return {};
}

TEST_CASE("one of each table's mistakes") {
  const ExperimentFolder folder;
  const char* const experiment = R"([experiment]
naem = "test"
seed = -1
trials = "three"
plugins = ["./libfake.so"]

[[scenario]]
use = "./hall/scenario.toml"
robots = 0.5
start_jitter = { position = 0.1 }

[[global_planner]]
use = "test.planer"
label = 3

[[global_planner]]
use = "test.planner"
params = { weight = "heavy", wieght = 1.5 }

[[local_controller]]
use = "test.controller"
control_latency_s = -1

[[pedestrian_model]]
us = "test.model"

[simulation]
step_s = "slow"
tracking = "some"

[robot]
v_max = -1
lidar = { beams = 0, range_max_m = -2 }

[record]
traces = "maybe"
)";
  CHECK(mistakes_of(experiment) ==
        Lines{
            "experiment.toml:2:1: unknown key 'naem' in [experiment] (did you mean 'name'?)",
            "experiment.toml:3:8: 'seed' must be at least 0, not -1",
            "experiment.toml:4:10: 'trials' must be an integer, not a string",
            "experiment.toml:9:10: 'robots' must be an integer, not a float",
            "experiment.toml:10:18: unknown key 'position' in 'start_jitter' (did you mean 'position_m'?)",
            "experiment.toml:13:7: no global_planner 'test.planer' in the loaded libraries (did you mean "
            "'test.planner'? there: test.planner)",
            "experiment.toml:14:9: 'label' must be a string, not an integer",
            "experiment.toml:18:21: 'weight' must be a number, not a string",
            "experiment.toml:18:30: unknown key 'wieght' for test.planner (did you mean 'weight'?)",
            "experiment.toml:22:21: 'control_latency_s' must be at least 0, not -1",
            "experiment.toml:25:1: unknown key 'us' in [[pedestrian_model]] (did you mean 'use'?)",
            "experiment.toml:28:10: 'step_s' must be a number, not a string",
            "experiment.toml:29:12: 'tracking' must be one of none, visible, all, not 'some' (did you mean 'none'?)",
            "experiment.toml:32:9: 'v_max' must be positive, not -1",
            "experiment.toml:33:19: 'beams' must be at least 1, not 0",
            "experiment.toml:33:36: 'range_max_m' must be positive, not -2",
            "experiment.toml:36:10: 'traces' must be one of all, some, failed, none, not 'maybe'",
        });
}

TEST_CASE("the mistakes of a scenario beside those of the experiment") {
  const ExperimentFolder folder;
  const char* const scenario = R"([scenario]
name = "hall"
titel = "Hall"
description = "a wall in the middle, open at both ends"
size_m = [10.0, -8.0]

[[box]]
name = "wall"
center_m = [5.0]
size_m = "wide"

[[circle]]
name = "wall"
radius_m = 0

[[robot]]
start = [0.5]
gaol = [9.5, 0.5]

[[region]]
name = "west"
lower_m = [0.5, 1.0]

[[region]]
name = "east"
lower_m = [8.0, 1.0]
upper_m = [9.5, 3.0]

[[flow]]
name = "across"
from = "west"
to = "eats"
people = -2
respawn = "yes"
)";
  const std::string experiment = with(experiment_text, "trials = 3", "trials = 0");
  CHECK(mistakes_of(experiment, scenario) ==
        Lines{
            "experiment.toml:4:10: 'trials' must be at least 1, not 0",
            "hall/scenario.toml:3:1: unknown key 'titel' in [scenario] (did you mean 'title'?)",
            "hall/scenario.toml:5:10: 'size_m' must be positive, not [10, -8]",
            "hall/scenario.toml:9:12: 'center_m' must be [x, y], not 1 number",
            "hall/scenario.toml:10:10: 'size_m' must be an array, not a string",
            "hall/scenario.toml:12:1: [[circle]] needs 'center_m'",
            "hall/scenario.toml:14:12: 'radius_m' must be positive, not 0",
            "hall/scenario.toml:17:9: 'start' must be [x, y] or [x, y, theta], not 1 number",
            "hall/scenario.toml:18:1: unknown key 'gaol' in [[robot]] (did you mean 'goal'?)",
            "hall/scenario.toml:20:1: [[region]] needs 'upper_m'",
            "hall/scenario.toml:32:6: no region 'eats' (did you mean 'east'? there: west, east)",
            "hall/scenario.toml:33:10: 'people' must be at least 0, not -2",
            "hall/scenario.toml:34:11: 'respawn' must be true or false, not a string",
        });
}

TEST_CASE("robots in walls and a misspelt key are told together") {
  const ExperimentFolder folder;
  std::string scenario = with(scenario_text, "start = [0.5, 0.5]", "start = [5.0, 4.0]");
  scenario = with(scenario, "goals = [[9.5, 3.5], [3.5, 7.5, 0.0]]", "goals = [[8.0, 6.0], [12.0, 0.5]]");
  const Lines lines = mistakes_of(with(experiment_text, "seed", "sed"), scenario);
  REQUIRE(lines.size() == 4);
  CHECK(lines[0] == "experiment.toml:3:1: unknown key 'sed' in [experiment] (did you mean 'seed'?)");
  CHECK(lines[1].find("robot 0 starts inside 'wall'") != std::string::npos);
  CHECK(lines[2].find("robot 1 has its goal inside 'pillar'") != std::string::npos);
  CHECK(lines[3].find("robot 1 has its goal outside the world") != std::string::npos);
}

TEST_CASE("a footprint of the experiment that is too large is the mistake, not the scenario") {
  const ExperimentFolder folder;
  const std::string robot = "[robot]\nfootprint = { radius_m = 3.0 }\n";
  const Lines lines = mistakes_of(experiment_text + robot);
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].starts_with("experiment.toml:20:13: robots of radius 3 m do not fit into scenario 'hall': "));
  CHECK(lines[0].find("hall/scenario.toml:21:1: robot 0 starts too near to ") != std::string::npos);
  // a start in a wall stays the scenario's mistake
  const std::string in_wall = with(scenario_text, "start = [0.5, 0.5]", "start = [5.0, 4.0]");
  CHECK(mistakes_of(experiment_text + with(robot, "3.0", "0.3"), in_wall).front().find("starts inside 'wall'") !=
        std::string::npos);
}

TEST_CASE("values that are rarely meant are warned about") {
  const ExperimentFolder folder;
  const auto warnings = [](const std::string& tables) {
    return load(std::string(experiment_text) + tables + "\n").warnings;
  };
  CHECK(warnings("[simulation]\ncontrol_period_s = 0.2\n[robot]\nomega_max = 3.1\nv_max = 2.0").empty());
  CHECK(warnings("[simulation]\ncontrol_period_s = 100") ==
        Lines{"experiment.toml:20:20: 'control_period_s' is 100 s: a robot drives on blindly until its next command; "
              "usual are 0.05 to 0.2 s"});
  CHECK(warnings("[robot_type.tug]\nomega_max = 57.3") ==
        Lines{"experiment.toml:20:13: 'omega_max' is 57.3 rad/s: are these degrees? 57.3 degrees are 1 rad"});
  CHECK(warnings("[robot]\nv_max = 36\na_max = 981").size() == 2);
  // 9 m; the second robot's tour is longer, and one line is enough
  CHECK(warnings("[simulation]\ntime_limit_s = 10\n[robot]\nv_max = 0.5") ==
        Lines{"hall/scenario.toml:21:1: robot 0 cannot arrive: 9.0 m as the crow flies take 18 s at 0.5 m/s, and "
              "time_limit_s = 10"});
}

TEST_CASE("what follows from a mistake is not told") {
  const ExperimentFolder folder;
  // plugins of a library that could not be read, and the other libraries' mistakes
  CHECK(mistakes_of(with(experiment_text, "\"./libfake.so\"", "\"./libnone.so\"")).size() == 1);
  CHECK(mistakes_of(with(experiment_text, "plugins =", "plugin =")) ==
        Lines{"experiment.toml:5:1: unknown key 'plugin' in [experiment] (did you mean 'plugins'?)"});
  // a table that is there under a wrong name
  CHECK(mistakes_of(with(experiment_text, "[[global_planner]]", "[[global_planer]]")) ==
        Lines{"experiment.toml:10:3: unknown key 'global_planer' (did you mean 'global_planner'?)"});
  // robots that do not fit where their size is not known
  CHECK(mistakes_of(std::string(experiment_text) + "[robot]\nfootprint = { radius_m = -1 }\n").size() == 1);
  // flows through a region with a mistake
  CHECK(mistakes_of(experiment_text, with(scenario_text, "lower_m = [0.5, 1.0]", "lower_m = [0.5]")).size() == 1);
  CHECK(mistakes_of(experiment_text, with(scenario_text, "name = \"west\"", "nam = \"west\"")).size() == 1);
}

}  // namespace all_mistakes_test
