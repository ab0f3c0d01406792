// SPDX-License-Identifier: MIT
// MovingAI's files, by themselves and as parts of a scenario. What is said of damaged ones: tests/end_to_end/plan.sh.
#include "host/maps/movingai.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "host/errors/input_error.hpp"
#include "host/experiment/adhoc_use.hpp"
#include "host/scenario/read_scenario.hpp"
#include "tests/unit/host/experiment/experiment_example.hpp"

namespace movingai_test {

using namespace dmrp;
using namespace dmrp::test;
using host::InputError;
using host::MovingAiCell;

const char* const map_text =
    "type octile\n"
    "height 3\n"
    "width 5\n"
    "map\n"
    ".GS..\n"
    "@OTW.\n"
    ".....\n";
const char* const tasks_text =
    "version 1\n"
    "0\tyard.map\t5\t3\t0\t0\t0\t2\t8.0\n"
    "1\tyard.map\t5\t3\t2\t2\t4\t0\t4\n"
    "1\tyard.map\t5\t3\t4\t2\t2\t0\t4\n";
const std::string yard_text = R"([scenario]
name = "yard"
title = "Yard"
description = "a wall across"

[map]
file = "yard.map"
cell_m = 2.0

[robots]
scen = "yard.scen"
count = 2
)";

core::Scenario read_yard(const std::string& text) {
  write_file("yard/scenario.toml", text);
  return host::read_scenario_file(std::filesystem::absolute("yard/scenario.toml"), "yard/scenario.toml").scenario;
}

std::string mistake(const std::string& from, const std::string& to) {
  try {
    read_yard(with(yard_text, from, to));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

void write_yard() {
  write_file("yard/yard.map", map_text);
  write_file("yard/yard.scen", tasks_text);
}

TEST_CASE("a map is read, its first line above all others") {
  const ExperimentFolder folder;
  write_file("yard.map", map_text);
  const core::CellMap map = host::read_movingai_map("yard.map", "yard.map");
  REQUIRE(map.width == 5);
  REQUIRE(map.height == 3);
  const std::vector<std::uint8_t> expected = {1, 1, 1, 1, 1, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1};
  CHECK(map.free == expected);
  const dmrp_vec2 center = host::center_of({1, 0}, map, 2.0);
  CHECK(center.x == 3.0);
  CHECK(center.y == 5.0);

  // other line ends, width first, another type, no end of the last line: the same map
  write_file("odd.map", "type tile\r\nwidth 5\r\nheight 3\r\nmap\r\n.GS..\r\n@OTW.\r\n.....");
  CHECK(host::read_movingai_map("odd.map", "odd.map").free == expected);
}

TEST_CASE("what editors add and nobody sees is no part of a map or task") {
  const ExperimentFolder folder;
  const std::string mark = "\xEF\xBB\xBF";
  write_file("yard.map", mark + "type octile \r\nheight 3\t\nwidth 5  \nmap \n.GS..  \n@OTW.\r\n..... \t\r\n \n\t\r\n");
  const core::CellMap map = host::read_movingai_map("yard.map", "yard.map");
  CHECK(map.free == std::vector<std::uint8_t>{1, 1, 1, 1, 1, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1});
  write_file("yard.scen", mark + "version 1 \n0\tyard.map\t5\t3\t0\t0\t0\t2\t8.0\t \r\n  \n");
  CHECK(host::read_movingai_tasks("yard.scen", "yard.scen", map).tasks.size() == 1);

  // a byte that changes the word is named
  const auto told = [&](const std::string& from, const std::string& to) -> std::string {
    write_file("yard.map", with(map_text, from, to));
    try {
      host::read_movingai_map("yard.map", "yard.map");
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  CHECK(told("map\n", "map\xC2\xA0\n") ==
        "yard.map:4:1: expected 'map' (column 4 has the byte 0xC2, which does not show)");
  CHECK(told("map\n", " map\n") == "yard.map:4:1: expected 'map' (column 1 has the byte 0x20, which does not show)");
  CHECK(told("map\n", "mop\xC2\n") == "yard.map:4:1: expected 'map'");
  CHECK(told("height 3",
             "height\xC2\xA0"
             "3") == "yard.map:2:1: expected 'height N' (column 7 has the byte 0xC2, which does not show)");
  CHECK(told("type", "\xFF\xFEtype") ==
        "yard.map:1:1: expected 'type octile': this is no MovingAI map (column 1 has the "
        "byte 0xFF, which does not show)");
  CHECK(told("@OT", std::string("@\0T", 3)) ==
        "yard.map:6:2: unknown cell of byte 0x00 (known: '.', 'G', 'S' free; '@', 'O', 'T', 'W' blocked)");
}

TEST_CASE("tasks are read, by tabs or blanks") {
  const ExperimentFolder folder;
  write_file("yard.map", map_text);
  const core::CellMap map = host::read_movingai_map("yard.map", "yard.map");
  for (const bool blanks : {false, true}) {
    std::string text = tasks_text;
    if (blanks) std::replace(text.begin(), text.end(), '\t', ' ');
    write_file("yard.scen", text);
    const host::MovingAiTasks read = host::read_movingai_tasks("yard.scen", "yard.scen", map);
    CHECK(read.map_name == "yard.map");
    REQUIRE(read.tasks.size() == 3);
    CHECK(read.tasks[0].goal == MovingAiCell{0, 2});
    CHECK(read.tasks[1].start == MovingAiCell{2, 2});
    CHECK(read.tasks[2].line == 4);
  }
}

TEST_CASE("a scenario of a map and tasks") {
  const ExperimentFolder folder;
  write_yard();
  const core::Scenario yard = read_yard(yard_text);
  CHECK(yard.upper.x == 10.0);
  CHECK(yard.upper.y == 6.0);
  REQUIRE(yard.shapes.size() == 1);
  CHECK(yard.shapes[0].vertices[0].y == 2.0);
  CHECK(yard.shapes[0].vertices[2].x == 8.0);
  REQUIRE(yard.robots.size() == 2);
  CHECK(yard.robots[0].start.x == 1.0);
  CHECK(yard.robots[0].start.y == 5.0);
  CHECK(std::isnan(yard.robots[0].start.theta));
  CHECK(yard.robots[1].goals[0].x == 9.0);
  CHECK(yard.robots[1].goals[0].y == 5.0);

  SECTION("without a count all tasks, without a cell size 1 m, elsewhere, with furniture") {
    std::string text = with(with(yard_text, "count = 2\n", ""), "cell_m = 2.0\n", "");
    text = with(text, "\n[map]", "origin_m = [100.0, -50.0]\n\n[map]");
    const core::Scenario moved =
        read_yard(text + "\n[[box]]\nname = \"bench\"\ncenter_m = [104.0, -49.5]\nsize_m = [0.5, 0.2]\n");
    CHECK(moved.robots.size() == 3);
    CHECK(moved.upper.x == 105.0);
    CHECK(moved.shapes.size() == 2);
    CHECK(moved.shapes[0].vertices[0].y == -49.0);
    CHECK(moved.robots[0].start.x == 100.5);
    CHECK(moved.robots[0].start.y == -47.5);
  }
  SECTION("its own robots") {
    const core::Scenario own = read_yard(
        with(yard_text, "[robots]\nscen = \"yard.scen\"\ncount = 2", "[[robot]]\nstart = [1, 1]\ngoal = [9, 1]"));
    CHECK(own.robots.size() == 1);
  }
  SECTION("an experiment uses fewer of the tasks and lists the files") {
    const std::string text = with(experiment_text, "./hall/scenario.toml", "./yard/scenario.toml");
    const host::Experiment before = load(with(text, "[[global_planner]]", "robots = 1\n[[global_planner]]"));
    CHECK(before.scenarios[0].scenario.robots.size() == 1);
    CHECK(before.scenarios[0].files.size() == 2);
    const std::string digest = identity_digest(before);
    write_file("yard/yard.map", std::string(map_text) + "\n");
    CHECK(identity_digest(before) != digest);
  }
}

TEST_CASE("mistakes in a scenario of a map") {
  const ExperimentFolder folder;
  write_yard();
  CHECK(mistake("\"yard.map\"", "\"yrd.map\"") == "yard/scenario.toml:7:8: no file 'yrd.map' beside the scenario file");
  CHECK(mistake("\"yard.map\"", "\"yard.scen\"") ==
        "yard/scenario.toml:7:8: 'file' must be a .map or .yaml or .yml file");
  CHECK(mistake("file =", "fil =") == "yard/scenario.toml:7:1: unknown key 'fil' in [map] (did you mean 'file'?)");
  CHECK(mistake("cell_m = 2.0", "cell_m = 0.0") == "yard/scenario.toml:8:10: 'cell_m' must be positive, not 0");
  CHECK(mistake("cell_m = 2.0", "cell_m = 3000.0") ==
        "yard/scenario.toml:8:10: the world must be at most 10000 m by 10000 m");
  CHECK(mistake("count = 2", "count = 4") == "yard/scenario.toml:12:9: yard/yard.scen has 3 tasks, not 4");
  CHECK(mistake("count = 2", "count = 0") == "yard/scenario.toml:12:9: 'count' must be at least 1, not 0");
  CHECK(mistake("[map]\nfile = \"yard.map\"\ncell_m = 2.0", "") == "yard/scenario.toml:1:1: [scenario] needs 'size_m'");
  CHECK(mistake("\n[map]", "size_m = [1, 1]\n\n[map]") ==
        "yard/scenario.toml:5:1: a scenario has either 'size_m' or a [map], which gives its size");
  CHECK(mistake("[robots]", "[[robot]]\nstart = [1, 1]\ngoal = [9, 1]\n\n[robots]") ==
        "yard/scenario.toml:10:3: a scenario has either [[robot]] or [robots]");
  write_file("yard/yard.map", with(map_text, "@", "#"));
  CHECK(mistake("count = 2", "count = 1") ==
        "yard/yard.map:6:1: unknown cell '#' (known: '.', 'G', 'S' free; '@', 'O', 'T', 'W' blocked)");
}

TEST_CASE("tasks that the robots cannot do are refused") {
  const ExperimentFolder folder;
  write_yard();
  // 0.5 m cells on a planning grid of 1 m: starts are no cells' centres any more
  write_file("yard/scenario.toml", with(yard_text, "cell_m = 2.0", "cell_m = 0.25"));
  REQUIRE_THROWS_WITH(host::adhoc_experiment("./yard"), Catch::Contains("robot 0"));
}

}  // namespace movingai_test
