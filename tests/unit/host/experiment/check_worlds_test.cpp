// SPDX-License-Identifier: MIT
// Worlds without robots, with robots that are drawn, of tiles, and with recorded people; settings of what is imperfect.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/tasks/task_difficulty.hpp"
#include "core/world/world.hpp"
#include "host/errors/input_error.hpp"
#include "host/experiment/adhoc_use.hpp"
#include "host/world/variant_world.hpp"
#include "tests/unit/host/experiment/experiment_example.hpp"

namespace check_worlds_test {

using namespace dmrp::test;
using namespace dmrp::host;
namespace core = dmrp::core;

// The example with this after the scenario's name.
std::string with_robots(const std::string& lines) {
  return with(experiment_text, "scenario.toml\"\n", "scenario.toml\"\n" + lines + "\n");
}

std::string message_of(const std::string& experiment) {
  try {
    load(experiment);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// Of the example scenario, so changed.
std::string message_of_scenario(const std::string& from, const std::string& to) {
  write_file("hall/scenario.toml", with(scenario_text, from, to));
  return message_of(experiment_text);
}

void write_hall_without_robots() {
  std::string text = scenario_text;
  const auto begin = text.find("[[robot]]");
  text.erase(begin, text.find("[[region]]") - begin);
  write_file("hall/scenario.toml", text);
}

void check_round_trip(const Experiment& original) {
  const std::string effective = effective_toml(original);
  write_file("elsewhere/effective.toml", effective);
  const Experiment again = load_experiment("elsewhere/effective.toml", 0, &fake_probe);
  CHECK(effective_toml(again) == effective);
  CHECK(identity_digest(again) == identity_digest(original));
  const Experiment unchecked = load_checked_experiment("elsewhere/effective.toml", 0, &fake_probe);
  CHECK(identity_digest(unchecked) == identity_digest(original));
  CHECK(combinations(again).size() == combinations(original).size());
}

TEST_CASE("worlds that somebody has checked are not checked again") {
  const ExperimentFolder folder;
  write_file("hall/scenario.toml", with(scenario_text, "start = [0.5, 0.5]", "start = [-0.5, 0.5]"));
  CHECK(message_of(experiment_text) != "no error");
  CHECK_NOTHROW(load_checked_experiment("experiment.toml", 0, &fake_probe));
}

TEST_CASE("without robots there is a combination for each model, and neither planner nor controller") {
  const ExperimentFolder folder;
  const Experiment e = load(with_robots("robots = [0, 2]"));
  REQUIRE(e.scenarios.size() == 2);
  CHECK(e.scenarios[0].label == "hall/0");
  CHECK(e.scenarios[0].scenario.robots.empty());
  CHECK(e.scenarios[0].scenario.other_starts.size() == 2);
  CHECK(e.scenarios[1].label == "hall");
  CHECK(e.scenarios[1].scenario.other_starts.empty());
  const auto all = combinations(e);
  REQUIRE(all.size() == 2);
  CHECK(all[0].global_planner == -1);
  CHECK(all[0].local_controller == -1);
  CHECK(all[0].pedestrian_model == 0);
  CHECK(all[1].global_planner == 0);
  CHECK(world_seed(e, "hall", 1) != world_seed(e, "hall", 2));
  check_round_trip(e);
}

TEST_CASE("an experiment without robots needs no planner and no controller") {
  const ExperimentFolder folder;
  const std::string alone =
      with(with(with_robots("robots = 0"), "[[local_controller]]\nuse = \"test.controller\"\n", ""),
           "[[global_planner]]\nuse = \"test.planner\"\nparams = { weight = 1.5 }\n", "");
  CHECK(combinations(load(alone)).size() == 1);
  check_round_trip(load(alone));
  // nor does a scenario that lists none have to be told so
  write_hall_without_robots();
  const Experiment e = load(with(alone, "robots = 0\n", ""));
  CHECK(e.scenarios[0].label == "hall");
  CHECK(robot_count(e.scenarios[0]) == 0);

  CHECK(message_of(with(with_robots("robots = [0, 1]"),
                        "[[global_planner]]\nuse = \"test.planner\"\nparams = { weight = "
                        "1.5 }\n",
                        "")) == "experiment.toml:1:1: the experiment needs a [[global_planner]]");
}

TEST_CASE("people_times multiplies the people of every flow, and changes neither seeds nor tasks") {
  const ExperimentFolder folder;
  write_file("hall/scenario.toml", with(scenario_text, "people = 2", "people = 2\ngroup_size = 2"));
  const auto times = [](const std::string& value) {
    return with(experiment_text, "scenario.toml\"\n",
                "scenario.toml\"\nrobots = 3\ntasks = \"drawn\"\npeople_times = " + value + "\n");
  };
  const Experiment once = load(times("1"));
  const Experiment thrice = load(times("3"));
  CHECK(once.scenarios[0].scenario.flows[0].people == 2);
  CHECK(thrice.scenarios[0].scenario.flows[0].people == 6);
  CHECK(thrice.scenarios[0].label == once.scenarios[0].label);
  CHECK(trial_seed(thrice, 1) == trial_seed(once, 1));
  CHECK(load(times("1.2")).scenarios[0].scenario.flows[0].people == 2);
  const core::Flow half = load(times("0.5")).scenarios[0].scenario.flows[0];
  CHECK(half.people == 1);
  CHECK(half.group_size == 1);

  write_file("elsewhere/effective.toml", effective_toml(thrice));
  CHECK(effective_toml(load_experiment("elsewhere/effective.toml", 0, &fake_probe)) == effective_toml(thrice));
  CHECK_THAT(message_of(times("-1")), Catch::StartsWith("experiment.toml:11:16: 'people_times' must be"));
  write_file("hall/scenario.toml", std::string(scenario_text).substr(0, std::string(scenario_text).find("[[flow]]")));
  CHECK(message_of(times("2")) == "experiment.toml:11:1: scenario 'hall' has no flows of people");
}

TEST_CASE("a scenario without robots and people is a mistake") {
  const ExperimentFolder folder;
  write_file("hall/scenario.toml", with(scenario_text, "people = 2", "people = 0"));
  CHECK(message_of(with_robots("robots = 0")) ==
        "experiment.toml:9:10: 'robots' must be at least 1: scenario 'hall' has no people");
  write_hall_without_robots();
  write_file("hall/scenario.toml", with(std::string("") + scenario_text, "people = 2", "people = 0"));
  std::string empty = with(scenario_text, "people = 2", "people = 0");
  const auto begin = empty.find("[[robot]]");
  empty.erase(begin, empty.find("[[region]]") - begin);
  write_file("hall/scenario.toml", empty);
  CHECK(message_of(experiment_text) == "experiment.toml:8:7: scenario 'hall' lists neither robots nor people");
}

TEST_CASE("more robots than listed get random tasks, different in each repetition") {
  const ExperimentFolder folder;
  const Experiment e = load(with_robots("robots = [0, 2, 3]"));
  REQUIRE(e.scenarios.size() == 3);
  CHECK(e.scenarios[1].scenario.robots.empty());  // other tasks than those of three robots would not compare
  CHECK(e.scenarios[1].drawn_robots == 2);
  CHECK(e.scenarios[1].label == "hall/2");
  REQUIRE(e.warnings.size() >= 1);
  CHECK(std::count(e.warnings.begin(), e.warnings.end(),
                   "experiment.toml:9:11: 'robots' goes beyond the 2 that scenario 'hall' lists: the tasks of all "
                   "numbers are drawn") == 1);
  CHECK(e.scenarios[2].scenario.robots.empty());
  CHECK(e.scenarios[2].drawn_robots == 3);
  CHECK(e.scenarios[2].label == "hall/3");
  for (const ScenarioVariant& variant : e.scenarios) {
    CHECK(is_drawn(variant));  // people keep clear of the same starts in all of them
    const VariantWorld shared(e, variant);
    const VariantWorld first(e, variant, shared, world_seed(e, "hall", 0));
    const VariantWorld second(e, variant, shared, world_seed(e, "hall", 1));
    CHECK(first.view.world().robot_count == robot_count(variant));
    CHECK(first.scenario.robots.size() + first.scenario.other_starts.size() == 5);
    if (variant.drawn_robots == 0) continue;
    CHECK(first.scenario.robots[0].name == "robot 0");
    CHECK_FALSE((first.scenario.robots[0].start.x == second.scenario.robots[0].start.x &&
                 first.scenario.robots[0].start.y == second.scenario.robots[0].start.y &&
                 first.scenario.robots[1].start.x == second.scenario.robots[1].start.x));
  }
  check_round_trip(e);

  const Experiment all = load(with_robots("robots = 2\ntasks = \"drawn\""));
  CHECK(all.scenarios[0].drawn_robots == 2);
  CHECK(all.scenarios[0].label == "hall/2");
  check_round_trip(all);
}

TEST_CASE("a sweep over the number of robots has the same first tasks at every number") {
  const ExperimentFolder folder;
  const Experiment e = load(with_robots("robots = [1, 2, 3]"));
  std::vector<core::RobotTask> first;
  for (const ScenarioVariant& variant : e.scenarios) {
    const VariantWorld shared(e, variant);
    first.push_back(VariantWorld(e, variant, shared, world_seed(e, "hall", 0)).scenario.robots.at(0));
  }
  CHECK(first[0].start.x == first[2].start.x);
  CHECK(first[1].goals[0].y == first[2].goals[0].y);
  // as long as the list is long enough, its tasks are the list's
  const Experiment listed = load(with_robots("robots = [1, 2]"));
  CHECK(listed.scenarios[0].drawn_robots == 0);
  CHECK(listed.scenarios[1].label == "hall");
}

TEST_CASE("a number of drawn tasks: repetition k has task k modulo it, and another crowd") {
  const ExperimentFolder folder;
  const Experiment e =
      load(with_robots("robots = 2\ntasks = { drawn = 2, conflicts_min = 1, conflicts_max = 1, crossing = \"any\" }"));
  const ScenarioVariant& variant = e.scenarios[0];
  CHECK(variant.wishes.drawn == 2);
  const auto seed = [&](std::uint32_t repetition) { return task_seed(e, "hall", variant.wishes, repetition); };
  CHECK(seed(0) == seed(2));
  CHECK(seed(0) != seed(1));
  CHECK(world_seed(e, "hall", 0) != world_seed(e, "hall", 2));
  const VariantWorld shared(e, variant);
  const VariantWorld world(e, variant, shared, seed(1));
  const core::TaskDifficulty difficulty = core::difficulty_of(world.planning_grid, world.scenario.robots);
  CHECK(difficulty.conflicts == 1);
  CHECK(difficulty.well_formed);
  check_round_trip(e);

  const auto at = [](const std::string& lines) { return message_of(with_robots("robots = 2\n" + lines)); };
  CHECK(at("tasks = { conflicts_min = 1 }") == "experiment.toml:10:9: 'tasks' needs 'drawn'");
  CHECK(at("tasks = { drawn = 1, conflict_min = 1 }") ==
        "experiment.toml:10:22: unknown key 'conflict_min' in 'tasks' (did you mean 'conflicts_min'?)");
  CHECK(at("tasks = { drawn = 1, conflicts_min = 3, conflicts_max = 2 }") ==
        "experiment.toml:10:57: 'conflicts_max' must be at least 'conflicts_min', 3");
  CHECK_THAT(at("tasks = { drawn = 1, conflicts_min = 2 }"),
             Catch::StartsWith("experiment.toml:9:10: scenario 'hall': none of 1000 draws of tasks for 2 robots has as "
                               "many conflicts as 'tasks' wishes (repetition 0; the last one has "));
}

TEST_CASE("robots are not drawn around a building") {
  const ExperimentFolder folder;
  // 30 m x 30 m around a house of 10 m x 10 m in which the listed robots begin
  const std::string house = R"([scenario]
name = "hall"
title = "Hall"
description = "a house on a meadow"
size_m = [30.0, 30.0]

[[box]]
name = "south wall"
center_m = [15.0, 10.0]
size_m = [10.2, 0.2]

[[box]]
name = "north wall"
center_m = [15.0, 20.0]
size_m = [10.2, 0.2]

[[box]]
name = "west wall"
center_m = [10.0, 15.0]
size_m = [0.2, 10.2]

[[box]]
name = "east wall"
center_m = [20.0, 15.0]
size_m = [0.2, 10.2]

)";
  const std::string listed = "[[robot]]\nstart = [11.5, 11.5]\ngoal = [18.5, 18.5]\n";
  const std::string alone = with(experiment_text, "[[pedestrian_model]]\nuse = \"test.model\"\n", "");
  const std::string experiment = with(alone, "scenario.toml\"\n", "scenario.toml\"\nrobots = 3\n");
  const auto drawn_inside = [&](const Experiment& e) {
    const VariantWorld shared(e, e.scenarios[0]);
    const VariantWorld world(e, e.scenarios[0], shared, world_seed(e, "hall", 0));
    return std::all_of(world.scenario.robots.begin(), world.scenario.robots.end(), [](const core::RobotTask& task) {
      return task.start.x > 10.0 && task.start.x < 20.0 && task.goals[0].y > 10.0 && task.goals[0].y < 20.0;
    });
  };
  write_file("hall/scenario.toml", house + listed);
  const Experiment by_list = load(experiment);
  CHECK(drawn_inside(by_list));
  REQUIRE(by_list.warnings.size() == 1);
  CHECK_THAT(by_list.warnings[0],
             Catch::EndsWith(": robots are drawn in the 100 m2 that the listed starts reach; larger "
                             "free space beyond, 800 m2, is left out"));
  write_file("hall/scenario.toml", with(house, "30.0]\n", "30.0]\ninside_m = [15.0, 15.0]\n"));
  CHECK(drawn_inside(load(experiment)));
  write_file("hall/scenario.toml", house);
  CHECK_FALSE(drawn_inside(load(experiment)));
  write_file("hall/scenario.toml", with(house, "30.0]\n", "30.0]\ninside_m = [31.0, 15.0]\n"));
  CHECK_THAT(message_of(experiment),
             Catch::EndsWith("scenario.toml:6:12: 'inside_m' must lie on a free planning cell"));
}

TEST_CASE("on a map whose edge is open, robots are drawn in the building, not outside its doors") {
  const ExperimentFolder folder;
  // 30 m x 30 m, 1 m a cell: a house from 8 to 22 m, with a gap in its southern wall or without
  const auto write_map = [](int gap) {
    std::string image = "P2\n30 30\n255\n";
    for (int row = 0; row < 30; ++row)
      for (int column = 0; column < 30; ++column) {
        const bool in_house = row >= 8 && row <= 21 && column >= 8 && column <= 21;
        const bool wall = in_house && (row == 8 || row == 21 || column == 8 || column == 21);
        image += wall && !(row == 21 && column >= 14 && column < 14 + gap) ? "0\n" : "254\n";
      }
    write_file("hall/map.pgm", image);
  };
  write_file("hall/map.yaml",
             "image: map.pgm\nresolution: 1.0\norigin: [0.0, 0.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: "
             "0.196\n");
  write_file("hall/scenario.toml",
             "[scenario]\nname = \"hall\"\ntitle = \"Hall\"\ndescription = \"a house\"\n[map]\nfile = "
             "\"map.yaml\"\n[[robot]]\nstart = [9.5, 9.5]\ngoal = [18.5, 18.5]\n");
  const std::string alone = with(experiment_text, "[[pedestrian_model]]\nuse = \"test.model\"\n", "");
  const std::string experiment = with(alone, "scenario.toml\"\n", "scenario.toml\"\nrobots = 3\n");
  const auto warning = [&] {
    const Experiment e = load(experiment);
    REQUIRE(e.warnings.size() == 1);
    return e.warnings[0];
  };
  write_map(0);
  CHECK_THAT(warning(), Catch::EndsWith(": robots are drawn in the 144 m2 that the listed starts reach; larger free "
                                        "space beyond, 704 m2, is left out"));
  write_map(3);
  CHECK_THAT(warning(), Catch::EndsWith(": drawn robots may begin outside the building: the way is open from its "
                                        "inside to the edge of the map (a [[box]] can close the gap)"));
  write_map(1);
  CHECK_THAT(warning(), Catch::EndsWith(": robots are drawn in the 145 m2 around the listed starts; the outside, 704 "
                                        "m2 beyond ways narrower than 2 m, is left out"));
  const Experiment e = load(experiment);
  const VariantWorld shared(e, e.scenarios[0]);
  for (std::uint32_t repetition = 0; repetition < 20; ++repetition) {
    const VariantWorld world(e, e.scenarios[0], shared, world_seed(e, "hall", repetition));
    REQUIRE(world.scenario.robots.size() == 3);
    for (const core::RobotTask& task : world.scenario.robots)
      for (const dmrp_pose& pose : {task.start, task.goals[0]}) {
        CHECK(std::abs(pose.x - 15.0) < 7.0);
        CHECK(std::abs(pose.y - 15.0) < 7.0);
      }
  }
  CHECK_THAT(
      message_of(experiment + "[simulation]\ngrid_resolution_m = 2.0\n"),
      Catch::EndsWith("scenario.toml:7:1: robots are drawn in what the listed starts reach, but none of these lies "
                      "on a free planning cell; grid_resolution_m = 1 would do"));
}

TEST_CASE("a start that cannot be reached says what would do") {
  const ExperimentFolder folder;
  // a door of 0.8 m whose middle lies between the centres of two cells
  const std::string wall = R"([[box]]
name = "wall"
center_m = [5.0, 4.0]
size_m = [0.2, 4.0]
)";
  const std::string door = R"([[box]]
name = "wall"
center_m = [5.0, 1.3]
size_m = [0.2, 2.6]

[[box]]
name = "other wall"
center_m = [5.0, 5.7]
size_m = [0.2, 4.6]
)";
  CHECK_THAT(message_of_scenario(wall, door),
             Catch::EndsWith("robot 0 cannot reach its goal (9.5, 0.5) from its start (0.5, 0.5) on the planning grid; "
                             "grid_resolution_m = 0.4 would do"));
  const auto with_cells = [](const std::string& cell_m) {
    return message_of(experiment_text + ("[simulation]\ngrid_resolution_m = " + cell_m + "\n"));
  };
  CHECK_THAT(with_cells("0.4"), !Catch::Contains("robot"));  // robots can; people cannot
  CHECK_THAT(with_cells("0.5"), Catch::Contains("grid_resolution_m = 0.4 would do"));
  CHECK_THAT(with_cells("0.75"), Catch::Contains("grid_resolution_m = 0.4 would do"));
}

TEST_CASE("mistakes in the number of robots") {
  const ExperimentFolder folder;
  const auto at = [](const std::string& lines) { return message_of(with_robots(lines)); };
  CHECK(at("robots = -1") == "experiment.toml:9:10: 'robots' must be at least 0, not -1");
  CHECK(at("robots = []") == "experiment.toml:9:10: 'robots' must have at least one number");
  CHECK(at("robots = [1, 1]") == "experiment.toml:9:14: scenario 'hall/1' occurs twice");
  CHECK(at("robots = 3\ntasks = \"listed\"") ==
        "experiment.toml:9:10: scenario 'hall' lists 2 robots, not 3 ('tasks' = 'drawn' draws them)");
  CHECK(at("tasks = \"drawn\"") == "experiment.toml:9:1: 'tasks' that are drawn need 'robots', their number");
  CHECK_THAT(at("tasks = \"random\"\nrobots = 1"), Catch::Contains("experiment.toml:9:9: 'tasks' must be"));
  CHECK_THAT(at("robots = 100"), Catch::StartsWith("experiment.toml:9:10: scenario 'hall' has room for ") &&
                                     Catch::EndsWith("s must be more than 2 m apart), not 100"));
}

TEST_CASE("a world of tiles has everything from its tile but the robots") {
  const ExperimentFolder folder;
  write_file("row/scenario.toml", R"([scenario]
name = "row"
title = "Row"
description = "three halls"
origin_m = [100.0, 0.0]

[tiles]
of = "../hall/scenario.toml"
columns = 3

[[flow]]
name = "nobody"
from = "end"
to = "corner"
people = 0

[[region]]
name = "end"
lower_m = [128.0, 1.0]
upper_m = [129.0, 2.0]

[[region]]
name = "corner"
lower_m = [128.0, 4.0]
upper_m = [129.0, 5.0]
)");
  const Experiment e = load(with(with_robots("robots = 5"), "./hall/", "./row/"));
  const core::Scenario& row = e.scenarios[0].scenario;
  CHECK(row.upper.x == 130.0);
  CHECK(row.upper.y == 8.0);
  REQUIRE(row.shapes.size() == 9);
  CHECK(row.shapes[0].name == "wall, tile 1/1");
  CHECK(row.shapes[7].name == "pillar, tile 3/1");
  CHECK(row.shapes[7].center.x == Approx(128.0));
  CHECK(row.shapes[3].vertices[0].x == Approx(row.shapes[0].vertices[0].x + 10.0));
  REQUIRE(row.flows.size() == 4);
  CHECK(row.regions[row.flows[2].regions[0]].name == "west, tile 3/1");
  CHECK(row.regions[row.flows[3].regions[0]].name == "end");
  CHECK(core::person_count(row) == 6);
  CHECK(e.scenarios[0].files.size() == 1);  // the tile's, which the digest counts
  const VariantWorld shared(e, e.scenarios[0]);
  const VariantWorld own(e, e.scenarios[0], shared, 1);
  double farthest_m = 0.0;
  for (const core::RobotTask& task : own.scenario.robots) farthest_m = std::max(farthest_m, task.start.x);
  CHECK(farthest_m > 105.0);
  check_round_trip(e);

  const auto mistake = [&](const std::string& tiles, const std::string& message) {
    write_file("row/scenario.toml",
               "[scenario]\nname = \"row\"\ntitle = \"Row\"\ndescription = \"halls\"\n[tiles]\n" + tiles + "\n");
    CHECK(message_of(with(experiment_text, "./hall/", "./row/")) == "row/scenario.toml:" + message);
  };
  mistake("of = \"../hall/scenario.toml\"", "5:1: [tiles] needs 'columns'");
  mistake("of = \"nowhere\"\ncolumns = 2", "6:6: no scenario 'nowhere'");
  mistake("of = \"scenario.toml\"\ncolumns = 2", "6:6: a scenario cannot be made of itself");
  mistake("of = \"../hall/scenario.toml\"\ncolumns = 0", "7:11: 'columns' must be at least 1, not 0");
}

TEST_CASE("recorded people come from a file beside the scenario") {
  const ExperimentFolder folder;
  write_file("hall/crowd.csv", "time, id, x, y\n0,7,1,1\n0.5,3,2.5,2\r\n1,7,1.5,1\n\n2,7,2,1.5\n");
  write_file("hall/scenario.toml", std::string(scenario_text) + "[[recording]]\nfile = \"crowd.csv\"\n");
  const Experiment e = load(experiment_text);
  const core::Scenario& hall = e.scenarios[0].scenario;
  REQUIRE(hall.tracks.size() == 2);
  CHECK(hall.tracks[0].points.size() == 3);
  CHECK(hall.tracks[0].points[2].t_ns == 2'000'000'000);
  CHECK(hall.tracks[0].points[2].position.y == 1.5);
  CHECK(hall.tracks[1].points.size() == 1);
  CHECK(core::person_count(hall) == 4);
  CHECK(core::walker_count(hall) == 2);
  const std::string digest = identity_digest(e);
  write_file("hall/crowd.csv", "\xEF\xBB\xBFtime,id,x,y\n0,7,1,1\n");
  CHECK(identity_digest(load(experiment_text)) != digest);
  check_round_trip(load(experiment_text));
}

TEST_CASE("recorded people need no pedestrian model") {
  const ExperimentFolder folder;
  write_file("hall/crowd.csv", "time,id,x,y\n0,7,1,1\n5,7,3,1\n");
  write_file("hall/scenario.toml",
             with(scenario_text, "people = 2", "people = 0") + "[[recording]]\nfile = \"crowd.csv\"\n");
  const Experiment e = load(with(with_robots("robots = [0, 2]"), "[[pedestrian_model]]\nuse = \"test.model\"\n", ""));
  for (const Combination& combination : combinations(e)) CHECK(combination.pedestrian_model == -1);
}

TEST_CASE("a recording of what nobody walks is warned of") {
  const ExperimentFolder folder;
  write_file("hall/scenario.toml", std::string(scenario_text) + "[[recording]]\nfile = \"crowd.csv\"\n");
  const auto warnings = [](const std::string& rows) {
    write_file("hall/crowd.csv", "time,id,x,y\n" + rows);
    std::string out;
    for (const std::string& warning : load(experiment_text).warnings)
      if (warning.starts_with("hall/crowd.csv")) out += warning + "\n";
    return out;
  };
  CHECK(warnings("0,1,2,1\n1,1,6.9,1\n1,2,4,1\n2,2,6,1\n") == "");
  CHECK(warnings("0,1,2,1\n1,1,2,1.5\n2,1,8,1\n3,1,2,1\n0,2,2,7\n1,2,9,7\n0,3,3,1\n") ==
        "hall/crowd.csv:4:1: person 1 moves at 6.0 m/s, faster than 5 m/s (and 1 more)\n");
  CHECK(warnings("0,1,4,4\n9,1,6,4\n") ==
        "hall/crowd.csv:3:1: person 1 goes through a wall or shape, from (4, 4) to (6, 4)\n");
  // at the start of the trial, in between two rows
  CHECK(warnings("-1,1,0.6,1\n1,1,0.6,0.5\n") ==
        "hall/crowd.csv:2:1: person 1 is on the start of robot 0 at 0 s, 0.27 m from it\n");
  CHECK(warnings("1,1,0.5,0.5\n2,1,1,1\n") == "");
}

TEST_CASE("mistakes in a recording") {
  const ExperimentFolder folder;
  write_file("hall/scenario.toml", std::string(scenario_text) + "[[recording]]\nfile = \"crowd.csv\"\n");
  CHECK(message_of(experiment_text) == "hall/scenario.toml:46:8: no file 'crowd.csv' beside the scenario file");
  const auto mistake = [](const std::string& csv, const std::string& message) {
    INFO(csv);
    write_file("hall/crowd.csv", csv);
    CHECK(message_of(experiment_text) == "hall/crowd.csv:" + message);
  };
  mistake("", "1:1: the file needs the line 'time,id,x,y'");
  mistake("time,id,x,y\n", "1:1: the recording has no rows");
  mistake("time,person,x,y\n", "1:6: the first line must be 'time,id,x,y': 'person' should be 'id'");
  mistake("time,id,x\n", "1:1: a row has 4 values, time,id,x,y, not 3");
  mistake("time,id,x,y\n0,1,2,3,4\n", "2:1: a row has 4 values, time,id,x,y, not 5");
  mistake("time,id,x,y\n0,1,2,north\n", "2:7: 'y' must be a number from -10000 to 10000, not 'north'");
  mistake("time,id,x,y\n0,1.5,2,3\n", "2:3: 'id' must be a whole number of at least 0, not '1.5'");
  mistake("time,id,x,y\n0,-1,2,3\n", "2:3: 'id' must be a whole number of at least 0, not '-1'");
  mistake("time,id,x,y\n0,1,nan,3\n", "2:5: 'x' must be a number from -10000 to 10000, not 'nan'");
  mistake("time,id,x,y\n0,1,+-2,3\n", "2:5: 'x' must be a number from -10000 to 10000, not '+-2'");
  mistake("time,id,x,y\n-2e6,1,2,3\n", "2:1: 'time' must be a number from -1000000 to 1000000, not '-2e6'");
  mistake("time,id,x,y\n,1,2,3\n", "2:1: 'time' must be a number from -1000000 to 1000000, not ''");
  mistake("time,id,x,y\n0,1,2\r3,4\n", "2:5: 'x' must be a number from -10000 to 10000, not '2 3'");
  mistake("time;id;x;y\n", "1:1: a row has 4 values, time,id,x,y, not 1");
  mistake("time,id,x,y\n0.5,1,2,3\n0.50000000001,1,2,3\n",
          "3:1: person 1 has two rows at 0.50000000001 s, line 2 is the first");
  mistake("time,id,x,y\n1,1,2,3\n0.5,2,2,3\n0.5,1,2,3\n",
          "4:1: the rows of person 1 must be in order of time: 0.5 s comes after 1 s");
  mistake("time,id,x,y\n+1,+1,2,+3\n+0.5,1,2,3\n",
          "3:1: the rows of person 1 must be in order of time: +0.5 s comes after 1 s");
  mistake("time,id,x,y\n0,1,2,3\n1,1,12,3\n", "3:1: person 1 is outside the world, at (12, 3)");
  mistake("time,id,x,y\n0,1,5,4\n", "2:1: person 1 is inside 'wall', at (5, 4)");
}

TEST_CASE("a recording without a person during the trial gives a warning") {
  const ExperimentFolder folder;
  write_file("hall/scenario.toml", std::string(scenario_text) + "[[recording]]\nfile = \"crowd.csv\"\n");
  const auto warnings = [](const std::string& csv, const std::string& settings) {
    write_file("hall/crowd.csv", "time,id,x,y\n" + csv);
    return load(experiment_text + settings).warnings;
  };
  CHECK(
      warnings("-20,1,1,1\n-3.5,1,2,1\n200,2,1,1\n", "") ==
      std::vector<std::string>{"hall/scenario.toml:46:8: nobody in 'hall/crowd.csv' is present during the trial, from "
                               "0 to 180 s: its rows are from -20 to 200 s"});
  CHECK(warnings("-20,1,1,1\n-3.5,1,2,1\n200,2,1,1\n", "[simulation]\ntime_limit_s = 200\n").empty());
  CHECK(warnings("2,1,1,1\n", "[simulation]\ntime_limit_s = 1.5\n")
            .front()
            .starts_with("hall/scenario.toml:46:8: nobody "));
  CHECK(warnings("-1,1,1,1\n0,1,2,1\n", "").empty());
  CHECK(warnings("-1,1,1,1\n190,1,2,1\n", "").empty());
}

TEST_CASE("a flow leads from region to region") {
  const ExperimentFolder folder;
  const std::string to = "hall/scenario.toml:43:6: ";
  CHECK(message_of_scenario("to = \"east\"", "to = \"west\"") ==
        to + "flow 'across' leads from region 'west' to itself: nobody would walk");
  CHECK(message_of_scenario("to = \"east\"", "via = [\"west\"]\nto = \"east\"") ==
        "hall/scenario.toml:43:8: flow 'across' leads from region 'west' to itself: nobody would walk");
  CHECK(message_of_scenario("to = \"east\"", "via = [\"east\"]\nto = \"west\"") == "no error");  // there and back
}

TEST_CASE("people need room at t = 0") {
  const ExperimentFolder folder;
  std::string text = scenario_text;
  const auto begin = text.find("[[robot]]");
  text.erase(begin, text.find("[[region]]") - begin);
  const auto hall_with = [&](const std::string& flow, const std::string& more) {
    write_file("hall/scenario.toml", with(text, "people = 2", flow) + more + "\n[people]\nradius_m = 0.3\n");
    return message_of(experiment_text);
  };
  // in the 1 m x 2 m of 'west' there is room for two or three people 0.65 m apart
  const std::string few = "people = 3\nstart = \"from\"";
  CHECK(hall_with(few, "") == "no error");
  write_file("hall/crowd.csv", "time,id,x,y\n0,1,0.8,1.3\n0,2,1.2,2\n0,3,0.8,2.7\n");
  const std::string recording = "[[recording]]\nfile = \"crowd.csv\"\n";
  CHECK_THAT(hall_with(few, recording), Catch::StartsWith("hall/scenario.toml:31:1: no room in region 'west' for 3 "
                                                          "people, for ") &&
                                            Catch::EndsWith(" at most beside 3 who are there already"));
  write_file("hall/crowd.csv", "time,id,x,y\n1,1,0.8,1.3\n1,2,1.2,2\n1,3,0.8,2.7\n");  // they come later
  CHECK(hall_with(few, recording) == "no error");

  const std::string overlapping = R"([[region]]
name = "south west"
lower_m = [0.5, 1.0]
upper_m = [1.5, 2.9]

[[flow]]
name = "too"
from = "south west"
to = "east"
people = 3
start = "from"
)";
  CHECK_THAT(hall_with("people = 1\nstart = \"from\"", overlapping), Catch::StartsWith("no error"));
  CHECK_THAT(hall_with("people = 4\nstart = \"from\"", overlapping),
             Catch::StartsWith("hall/scenario.toml:31:1: no room in region 'west' for 4 people, for ") &&
                 Catch::EndsWith(" at most beside 3 who are there already"));

  CHECK_THAT(hall_with("people = 200", ""),
             Catch::Matches("hall/scenario.toml:31:1: no room along flow 'across' for 200 people, for [0-9]+ at most"));
}

TEST_CASE("flows that start in their first region and leave for good") {
  const ExperimentFolder folder;
  const std::string back = with(scenario_text, "from = \"west\"\nto = \"east\"", "from = \"east\"\nto = \"west\"");
  write_file("hall/scenario.toml", with(back, "people = 2", "people = 3\nstart = \"from\"\nrespawn = false"));
  const core::Flow flow = load(experiment_text).scenarios[0].scenario.flows[0];
  CHECK(flow.start == core::FlowStart::from);
  CHECK_FALSE(flow.respawn);
  CHECK_THAT(message_of_scenario("people = 2", "people = 2\nstart = \"here\""),
             Catch::Contains("hall/scenario.toml:45:9: 'start' must be"));
  CHECK(message_of_scenario("people = 2", "people = 2\nrespawn = 0") ==
        "hall/scenario.toml:45:11: 'respawn' must be true or false, not an integer");
  CHECK_THAT(message_of_scenario("people = 2", "people = 50\nstart = \"from\""),
             Catch::Contains("hall/scenario.toml:40:1: no room in region 'west' for 50 people, for"));
}

TEST_CASE("a flow's reaction is that of its people") {
  const ExperimentFolder folder;
  write_file("hall/scenario.toml", with(scenario_text, "people = 2", "people = 2\nreaction = \"scared\""));
  const core::Scenario scenario = load(experiment_text).scenarios[0].scenario;
  CHECK(scenario.flows[0].reaction == DMRP_REACTION_SCARED);
  const auto geometry = std::make_shared<const core::StaticGeometry>(scenario);
  const core::World world(scenario, core::RobotSettings{}, core::SimulationSettings{}, geometry, 1);
  REQUIRE(world.people().size() == 2);
  for (const dmrp_person& person : world.people()) CHECK(person.reaction == DMRP_REACTION_SCARED);
  CHECK_THAT(message_of_scenario("people = 2", "people = 2\nreaction = \"afraid\""),
             Catch::Contains("hall/scenario.toml:45:12: 'reaction' must be one of unspecified, regular, impassive, "
                             "surprised, curious, scared, threatening, not 'afraid'"));
}

// Two robots start by the region 'west': of its 1 m x 2 m, people find but a corner that is 1.5 m away from both.
TEST_CASE("a crowd needs room beside the starts of all listed robots") {
  const ExperimentFolder folder;
  const std::string crowd = with(scenario_text, "people = 2", "people = 3\nstart = \"from\"");
  const auto no_room = Catch::Contains("hall/scenario.toml:40:1: no room in region 'west' for 3 people, for");
  write_file("hall/scenario.toml", crowd);
  CHECK_THAT(message_of(experiment_text), no_room);
  CHECK_THAT(message_of(with_robots("robots = 0")), no_room);
  std::string alone = crowd;
  const auto begin = alone.find("[[robot]]");
  alone.erase(begin, alone.find("[[region]]") - begin);
  write_file("hall/scenario.toml", alone);
  CHECK(message_of(experiment_text) == "no error");
}

TEST_CASE("a controller may have a control latency of its own") {
  const ExperimentFolder folder;
  CHECK_FALSE(load(experiment_text).local_controllers[0].control_latency_ns);
  const std::string table = "[[local_controller]]\n";
  std::string text = experiment_text;
  const std::size_t at = text.find(table);
  REQUIRE(at != std::string::npos);
  text.insert(at + table.size(), "control_latency_s = 0.03\n");
  const Experiment own = load(text);
  CHECK(own.local_controllers[0].control_latency_ns == 30'000'000);
  CHECK(own.simulation.control_latency_ns == 0);
  check_round_trip(own);
  text.replace(text.find("0.03"), 4, "30.0");
  CHECK_THAT(message_of(text), Catch::Contains("control_latency_s"));
}

TEST_CASE("a controller may be a bound for the others") {
  const ExperimentFolder folder;
  const std::string second = "[[local_controller]]\nuse = \"test.controller\"\nlabel = \"second\"\n";
  CHECK(load(experiment_text).local_controllers[0].bound == Bound::none);
  const Experiment e = load(experiment_text + second + "bound = \"upper\"\n");
  CHECK(e.local_controllers[1].bound == Bound::upper);
  check_round_trip(e);
  CHECK_THAT(message_of(experiment_text + second + "bound = \"top\"\n"),
             Catch::EndsWith("'bound' must be one of lower, upper, not 'top'"));
  CHECK_THAT(message_of(experiment_text + second + "bound = \"lower\"\n[[local_controller]]\n" +
                        "use = \"test.controller\"\nlabel = \"third\"\nbound = \"lower\"\n"),
             Catch::EndsWith("'second' and 'third' cannot both be the lower bound"));
}

TEST_CASE("one bound without the other is warned about") {
  const ExperimentFolder folder;
  const std::string second = "[[local_controller]]\nuse = \"test.controller\"\nlabel = \"second\"\n";
  const std::string third = "[[local_controller]]\nuse = \"test.controller\"\nlabel = \"third\"\n";
  const Experiment lone = load(experiment_text + second + "bound = \"lower\"\n" + third);
  REQUIRE(lone.warnings.size() == 1);
  CHECK_THAT(lone.warnings[0], Catch::Contains(": no controller is the upper bound"));
  CHECK(load(experiment_text + second + "bound = \"lower\"\n" + third + "bound = \"upper\"\n").warnings.empty());
}

TEST_CASE("imperfections are off by default") {
  const ExperimentFolder folder;
  const Experiment off = load(experiment_text);
  CHECK(off.robot.actuation_latency_ns == 0);
  CHECK(off.robot.odometry.noise == std::array<double, 4>{});
  CHECK(off.simulation.control_latency_ns == 0);
  CHECK(off.simulation.planning_latency_ns == 0);
  const std::string settings = R"([simulation]
control_latency_s = 0.05
planning_latency_s = 1.5
[robot]
actuation_latency_s = 0.12
odometry = { noise = [0.01, 0.02, 0.03, 0.04], fix_period_s = 2 }
)";
  const Experiment on = load(experiment_text + settings);
  CHECK(on.simulation.control_latency_ns == 50'000'000);
  CHECK(on.simulation.planning_latency_ns == 1'500'000'000);
  CHECK(on.robot.actuation_latency_ns == 120'000'000);
  CHECK(on.robot.odometry.noise == std::array<double, 4>{0.01, 0.02, 0.03, 0.04});
  CHECK(on.robot.odometry.fix_period_ns == 2'000'000'000);
  check_round_trip(on);
  CHECK_THAT(message_of(experiment_text + std::string("[robot]\nodometry = { noise = [0.1, 0.1] }\n")),
             Catch::EndsWith("'noise' must be [a1, a2, a3, a4], not 2 numbers"));
  CHECK_THAT(message_of(experiment_text + std::string("[simulation]\nplanning_latency_s = 30\n")),
             Catch::EndsWith("'planning_latency_s' must be at most 10, not 30"));
}

TEST_CASE("plan uses random tasks for a seed") {
  const ExperimentFolder folder;
  Experiment e = adhoc_experiment("hall/scenario.toml");
  use_random_tasks(e, 4, 3);
  CHECK(e.scenarios[0].scenario.robots.size() == 4);
  CHECK_THROWS_WITH(use_random_tasks(e, 100, 3), Catch::StartsWith("--agents 100: scenario 'hall' has room for ") &&
                                                     Catch::EndsWith("s must be more than 2 m apart"));
  write_file("cell/scenario.toml",
             "[scenario]\nname = \"cell\"\ntitle = \"Cell\"\ndescription = \"small\"\nsize_m = [4, 4]\n");
  Experiment small = adhoc_experiment("cell/scenario.toml");
  CHECK_THROWS_WITH(use_random_tasks(small, 1, 3),
                    "--agents 1: scenario 'cell' has room for 0 robots with random tasks: a goal must be at least 5 m "
                    "from its start");
}

}  // namespace check_worlds_test
