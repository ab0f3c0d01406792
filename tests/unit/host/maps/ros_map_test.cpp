// SPDX-License-Identifier: MIT
// Maps of map_server, by themselves and as parts of a scenario, whole and damaged.
#include "host/maps/ros_map.hpp"

#include <png.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <optional>
#include <regex>

#include "core/scene/static_geometry.hpp"
#include "host/errors/input_error.hpp"
#include "host/maps/map_image.hpp"
#include "host/scenario/read_scenario.hpp"
#include "tests/support/test_data.hpp"
#include "tests/unit/host/experiment/experiment_example.hpp"

namespace ros_map_test {

using namespace dmrp;
using namespace dmrp::test;
using host::InputError;
using host::UnknownCells;

const std::string yaml_text =
    "image: attic.pgm\n"
    "resolution: 0.5\n"
    "origin: [-1.0, 2.0, 0.0]\n"
    "negate: 0\n"
    "occupied_thresh: 0.65\n"
    "free_thresh: 0.196\n";
// above: free, unknown, occupied; below: free, free, occupied
const std::string pgm_text =
    "P2\n"
    "# drawn by hand\n"
    "3 2 # width, height\n"
    "255\n"
    "254 205 0\n"
    "254 254 0\n";
const std::string scenario_text_of_map = R"([scenario]
name = "attic"
title = "Attic"
description = "two rooms, one of them unknown"

[map]
file = "attic.yaml"

[[robot]]
start = [-0.75, 2.25]
goal = [-0.25, 2.25, 1.57]
)";

using Cells = std::vector<std::uint8_t>;

void write_attic() {
  write_file("attic/attic.yaml", yaml_text);
  write_file("attic/attic.pgm", pgm_text);
}

host::RosMap read_map(std::optional<UnknownCells> unknown = std::nullopt) {
  return host::read_ros_map("attic/attic.yaml", "attic/attic.yaml", unknown);
}

std::string mistake_of_map() {
  try {
    read_map();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

core::Scenario read_attic(const std::string& text) {
  write_file("attic/scenario.toml", text);
  return host::read_scenario_file(std::filesystem::absolute("attic/scenario.toml"), "attic/scenario.toml").scenario;
}

std::string mistake(const std::string& from, const std::string& to) {
  try {
    read_attic(with(scenario_text_of_map, from, to));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

struct PngKind {
  int color_type = PNG_COLOR_TYPE_GRAY;
  int bit_depth = 8;
  int interlace = PNG_INTERLACE_NONE;
};

// A PNG of 2 rows; `samples` as its kind has them, palette indices in a palette of black, grey 205 and white.
std::string png_of(PngKind kind, std::uint32_t width, std::string samples) {
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &bytes,
      [](png_structp to, png_bytep data, std::size_t count) {
        static_cast<std::string*>(png_get_io_ptr(to))->append(reinterpret_cast<const char*>(data), count);
      },
      nullptr);
  png_set_IHDR(png, info, width, 2, kind.bit_depth, kind.color_type, kind.interlace, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  const png_color palette[] = {{0, 0, 0}, {205, 205, 205}, {254, 254, 254}};
  if (kind.color_type == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette, 3);
  png_write_info(png, info);
  const std::size_t row_bytes = png_get_rowbytes(png, info);
  auto* const first = reinterpret_cast<png_bytep>(samples.data());
  png_bytep rows[] = {first, first + row_bytes};
  png_write_image(png, rows);
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

std::string bytes_of(std::initializer_list<int> values) {
  std::string out;
  for (const int value : values) out += static_cast<char>(value);
  return out;
}

// The attic's image in another format.
host::RosMap read_with_image(const std::string& image, const std::string& more_yaml = "") {
  write_file("attic/attic.pgm", image);
  write_file("attic/attic.yaml", yaml_text + more_yaml);
  return read_map();
}

// Of an experiment in the attic.
std::string message_of_attic() {
  try {
    write_file("attic/scenario.toml", scenario_text_of_map);
    load(with(experiment_text, "./hall/scenario.toml", "./attic/scenario.toml"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

const Cells attic_cells = {1, 1, 0, 1, 0, 0};

TEST_CASE("a map of map_server is read, the image's first row above all others") {
  const ExperimentFolder folder;
  write_attic();
  const host::RosMap map = read_map();
  REQUIRE(map.cells.width == 3);
  REQUIRE(map.cells.height == 2);
  CHECK(map.cells.free == attic_cells);
  CHECK(map.resolution_m == 0.5);
  CHECK(map.origin.x == -1.0);
  CHECK(map.origin.y == 2.0);
  CHECK(map.image == "attic/attic.pgm");
  CHECK(read_map(UnknownCells::free).cells.free == Cells{1, 1, 0, 1, 1, 0});

  SECTION("with keys of other tools, by an absolute path") {
    write_file("attic/attic.yaml", with(yaml_text, "attic.pgm", (folder.path() / "attic/attic.pgm").string()) +
                                       "created_by: {tool: somebody's, passes: [1, 2]}\n");
    CHECK(read_map().cells.free == attic_cells);
  }
  SECTION("negated") {
    write_file("attic/attic.yaml", with(yaml_text, "negate: 0", "negate: true"));
    CHECK(read_map().cells.free == Cells{0, 0, 1, 0, 0, 1});
  }
}

TEST_CASE("images of every kind give the same map") {
  const ExperimentFolder folder;
  CHECK(read_with_image("P5 3 2 255\n" + bytes_of({254, 205, 0, 254, 254, 0})).cells.free == attic_cells);
  // a line end after the image is none of it
  CHECK(read_with_image("P5 3 2 255\n" + bytes_of({254, 205, 0, 254, 254, 0}) + "\n").cells.free == attic_cells);
  CHECK(read_with_image("P5\n#a\n#b\n3 #c\n2\n100\t" + bytes_of({100, 80, 0, 99, 100, 1})).cells.free == attic_cells);
  CHECK(read_with_image("P5 3 2 65535\n" + bytes_of({255, 255, 205, 0, 0, 9, 255, 0, 254, 0, 1, 0})).cells.free ==
        attic_cells);
  CHECK(read_with_image("P2 3 2 65535 65535 52500 0 65000 65535 255").cells.free == attic_cells);

  const std::string gray = bytes_of({254, 205, 0, 254, 254, 0});
  const std::string rgb = bytes_of({254, 254, 254, 204, 205, 206, 0, 0, 0, 255, 253, 254, 254, 254, 254, 9, 9, 9});
  CHECK(read_with_image(png_of({}, 3, gray)).cells.free == attic_cells);
  CHECK(read_with_image(png_of({PNG_COLOR_TYPE_GRAY, 8, PNG_INTERLACE_ADAM7}, 3, gray)).cells.free == attic_cells);
  CHECK(read_with_image(png_of({PNG_COLOR_TYPE_GRAY, 16}, 3, bytes_of({254, 9, 205, 0, 0, 0, 254, 0, 254, 0, 0, 0})))
            .cells.free == attic_cells);
  CHECK(read_with_image(png_of({PNG_COLOR_TYPE_RGB}, 3, rgb)).cells.free == attic_cells);
  CHECK(read_with_image(png_of({PNG_COLOR_TYPE_PALETTE}, 3, bytes_of({2, 1, 0, 2, 2, 0}))).cells.free == attic_cells);
  CHECK(read_with_image(png_of({PNG_COLOR_TYPE_PALETTE, 2}, 3, bytes_of({0b10010000, 0b10100000}))).cells.free ==
        attic_cells);
  // one bit: black and white
  CHECK(read_with_image(png_of({PNG_COLOR_TYPE_GRAY, 1}, 3, bytes_of({0b10000000, 0b11000000}))).cells.free ==
        attic_cells);
}

TEST_CASE("grey 205 is unknown if the scenario says what unknown cells are, and else not free unseen") {
  const ExperimentFolder folder;
  write_attic();
  // as nav2's map_saver writes it: 1 - 205 / 255 is below
  write_file("attic/attic.yaml", with(yaml_text, "0.196", "0.25"));
  CHECK(read_map().cells.free == Cells{1, 1, 0, 1, 1, 0});
  CHECK(read_map().unknown_as_free == 1);
  CHECK(read_map().unknown == 0);
  CHECK(read_map(UnknownCells::occupied).cells.free == attic_cells);
  CHECK(read_map(UnknownCells::occupied).unknown_as_free == 0);
  CHECK(read_map(UnknownCells::occupied).unknown == 1);
  CHECK(read_map(UnknownCells::free).cells.free == Cells{1, 1, 0, 1, 1, 0});

  SECTION("with thresholds by which it is occupied") {
    write_file("attic/attic.yaml", with(with(yaml_text, "0.196", "0.1"), "0.65", "0.15"));
    CHECK(read_map().cells.free == attic_cells);
    CHECK(read_map(UnknownCells::free).cells.free == Cells{1, 1, 0, 1, 1, 0});
  }
  SECTION("other greys, other modes and negated images are what the thresholds say") {
    write_file("attic/attic.pgm", with(pgm_text, "205", "206"));
    CHECK(read_map(UnknownCells::occupied).cells.free == Cells{1, 1, 0, 1, 1, 0});
    CHECK(read_map().unknown_as_free == 0);
    write_attic();
    write_file("attic/attic.yaml", with(yaml_text, "0.196", "0.25") + "mode: scale\n");
    CHECK(read_map(UnknownCells::occupied).cells.free == Cells{1, 1, 0, 1, 1, 0});
    CHECK(read_map().unknown_as_free == 0);
    write_file("attic/attic.yaml", with(with(yaml_text, "0.65", "0.9"), "negate: 0", "negate: 1"));
    write_file("attic/attic.pgm", with(pgm_text, "205", "40"));
    CHECK(read_map(UnknownCells::occupied).cells.free == Cells{0, 0, 1, 0, 1, 1});
  }
  SECTION("opaque images of colours") {
    const std::string rgba = bytes_of({254, 254, 254, 255, 205, 205, 205, 255, 0, 0, 0, 255,  //
                                       254, 254, 254, 255, 254, 254, 254, 255, 0, 0, 0, 255});
    write_file("attic/attic.pgm", png_of({PNG_COLOR_TYPE_RGB_ALPHA}, 3, rgba));
    CHECK(read_map().unknown_as_free == 1);  // the mean of all channels is lighter
    CHECK(read_map(UnknownCells::occupied).cells.free == attic_cells);
  }
  SECTION("a scenario is warned, until it says") {
    const auto read = [](const std::string& text) {
      write_file("attic/scenario.toml", text);
      return host::read_scenario_file(std::filesystem::absolute("attic/scenario.toml"), "attic/scenario.toml");
    };
    CHECK(
        read(scenario_text_of_map).warnings ==
        std::vector<std::string>{"attic/scenario.toml:7:8: 1 cell of grey 205, as map_saver writes unknown ones, count "
                                 "as free by free_thresh = 0.25: unknown = \"occupied\" in [map] makes them walls, "
                                 "\"free\" keeps them free"});
    for (const char* unknown : {"occupied", "free"})
      CHECK(read(with(scenario_text_of_map, "attic.yaml\"", std::string("attic.yaml\"\nunknown = \"") + unknown + '"'))
                .warnings.empty());
    write_file("attic/attic.yaml", yaml_text);
    CHECK(read(scenario_text_of_map).warnings.empty());
  }
}

TEST_CASE("the census of a map") {
  const ExperimentFolder folder;
  write_attic();
  const auto census = [](const std::string& unknown) {
    write_file("attic/scenario.toml", with(scenario_text_of_map, "attic.yaml\"", "attic.yaml\"" + unknown));
    return census_text(
        *host::read_scenario_file(std::filesystem::absolute("attic/scenario.toml"), "attic/scenario.toml").census);
  };
  CHECK(census("") == "6 cells: 50 % free, 33 % walls, 17 % unknown (count as walls)");
  CHECK(census("\nunknown = \"free\"") == "6 cells: 50 % free, 33 % walls, 17 % unknown (count as free)");
  CHECK(host::census_text({"", 1, 1}) == "1 cell: 100 % free, 0 % walls");
  CHECK(host::census_text({"", 1000, 999}) == "1000 cells: 99 % free, under 1 % walls");

  // an image that is read the other way round: the start is in a wall, and so is nearly all
  std::string dark = "P2 10 10 255\n";
  for (int i = 0; i < 100; ++i) dark += i == 0 ? "254 " : "0 ";
  write_file("attic/attic.pgm", dark);
  CHECK_THAT(message_of_attic(), Catch::Contains("robot 0 starts inside") &&
                                     Catch::Contains("; hardly anything is free in attic.yaml: 100 cells: 1 % free, "
                                                     "99 % walls"));
  std::string light = "P2 10 10 255\n";
  for (int i = 0; i < 100; ++i) light += i < 10 ? "254 " : "0 ";
  write_file("attic/attic.pgm", light);
  CHECK_THAT(message_of_attic(), Catch::Contains("robot 0 starts inside") && !Catch::Contains("hardly"));
}

TEST_CASE("an image with transparency: trinary takes the mean of all channels, scale treats it as unknown") {
  const ExperimentFolder folder;
  // white, opaque; white, half transparent; black, opaque
  const std::string gray = bytes_of({255, 255, 255, 127, 0, 255, 255, 255, 255, 0, 0, 0});
  const std::string png = png_of({PNG_COLOR_TYPE_GRAY_ALPHA}, 3, gray);
  const host::MapImage image = host::read_png(png, "attic.png");
  CHECK(image.white == 765);
  CHECK(image.level == std::vector<std::uint32_t>{765, 765, 0, 765, 765, 0});
  CHECK(image.alpha == std::vector<std::uint8_t>{255, 127, 255, 255, 0, 0});
  // (3 * 255 + 127) / 4 is light enough; (3 * 255 + 0) / 4 is not; (3 * 0 + 255) / 4 is dark enough
  CHECK(read_with_image(png).cells.free == Cells{1, 0, 0, 1, 1, 0});
  CHECK(read_with_image(png, "mode: scale\n").cells.free == Cells{1, 0, 0, 1, 0, 0});
  CHECK(host::read_ros_map("attic/attic.yaml", "a.yaml", UnknownCells::free).cells.free == Cells{1, 1, 1, 1, 1, 0});
}

TEST_CASE("scale and raw: a cell is blocked from a probability of 50 on") {
  const ExperimentFolder folder;
  // half way between the thresholds is 0.423 of 255: grey 147
  CHECK(read_with_image("P2 3 2 255  254 150 0  148 146 60", "mode: scale\n").cells.free == Cells{1, 0, 0, 1, 1, 0});
  CHECK(read_with_image("P2 3 2 255  0 49 50  100 101 255", "mode: raw\n").cells.free == Cells{0, 0, 0, 1, 1, 0});
  CHECK(read_map(UnknownCells::free).cells.free == Cells{0, 1, 1, 1, 1, 0});
  // raw is not negated
  write_file("attic/attic.yaml", with(yaml_text, "negate: 0", "negate: 1") + "mode: raw\n");
  CHECK(read_map().cells.free == Cells{0, 0, 0, 1, 1, 0});
}

TEST_CASE("a scenario of a map of map_server has the map's origin") {
  const ExperimentFolder folder;
  write_attic();
  const core::Scenario attic = read_attic(scenario_text_of_map);
  CHECK(attic.lower == dmrp_vec2{-1.0, 2.0});
  CHECK(attic.upper == dmrp_vec2{0.5, 3.0});
  REQUIRE(attic.shapes.size() == 2);
  REQUIRE(attic.robots.size() == 1);
  CHECK(attic.robots[0].goals[0].theta == 1.57);
  const core::StaticGeometry geometry(attic);
  CHECK(geometry.clearance({-0.75, 2.75}) == 0.25);
  CHECK(geometry.clearance({-0.25, 2.75}) == 0.0);
  CHECK(geometry.clearance({0.25, 2.25}) == 0.0);

  SECTION("unknown cells can be free") {
    const core::Scenario open =
        read_attic(with(scenario_text_of_map, "attic.yaml\"", "attic.yaml\"\nunknown = \"free\""));
    REQUIRE(open.shapes.size() == 1);
    CHECK(core::StaticGeometry(open).clearance({-0.25, 2.75}) == 0.25);
  }
  SECTION("an experiment lists the files") {
    const host::Experiment before = load(
        with(experiment_text, "./hall/scenario.toml", "./attic/scenario.toml") +
        "[simulation]\ngrid_resolution_m = 0.5\nplanning_margin_m = 0.0\n[robot]\nfootprint = { radius_m = 0.2 }\n");
    REQUIRE(before.scenarios[0].files.size() == 2);
    CHECK(before.scenarios[0].files[1] == folder.path() / "attic/attic.pgm");
    const std::string digest = identity_digest(before);
    write_file("attic/attic.pgm", pgm_text + "\n");
    CHECK(identity_digest(before) != digest);
  }
}

TEST_CASE("a rotated map: its cells, and walls around it") {
  const ExperimentFolder folder;
  toolkit::Stream stream(1, "turned");
  for (int round = 0; round < 40; ++round) {
    core::CellMap map{
        1 + static_cast<std::uint32_t>(stream.below(6)), 1 + static_cast<std::uint32_t>(stream.below(6)), {}};
    for (std::uint32_t i = 0; i < map.width * map.height; ++i) map.free.push_back(stream.uniform() < 0.6 ? 1 : 0);
    const double yaw = round < 8 ? round * 0.5 * 3.141592653589793 : 7.0 * stream.uniform();
    const dmrp_pose origin = {3.0, -2.0, yaw};
    const core::PlacedBoxes placed = core::place_boxes(map, 0.5, origin);
    core::Scenario scenario;
    scenario.lower = placed.world.lower;
    scenario.upper = placed.world.upper;
    scenario.shapes = placed.shapes;
    const core::StaticGeometry geometry(scenario);
    for (int i = 0; i < 200; ++i) {
      const dmrp_vec2 p = {scenario.lower.x + stream.uniform() * (scenario.upper.x - scenario.lower.x),
                           scenario.lower.y + stream.uniform() * (scenario.upper.y - scenario.lower.y)};
      const dmrp_vec2 d = p - dmrp_vec2{origin.x, origin.y};
      const double column = (std::cos(yaw) * d.x + std::sin(yaw) * d.y) / 0.5;
      const double row = (-std::sin(yaw) * d.x + std::cos(yaw) * d.y) / 0.5;
      const bool inside = column >= 0.0 && row >= 0.0 && column < map.width && row < map.height;
      const bool free = inside && map.is_free(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
      const double edge = std::min(std::abs(column - std::round(column)), std::abs(row - std::round(row)));
      if (edge > 1e-6) REQUIRE((geometry.clearance(p) > 0.0) == free);
    }
  }
  // the world's sides go through the corners of a map turned by 45 degrees
  const core::PlacedBoxes diamond = core::place_boxes({2, 2, {1, 1, 1, 1}}, 1.0, {0.0, 0.0, 0.25 * 3.141592653589793});
  CHECK(diamond.shapes.size() == 4);
  CHECK(diamond.world.lower.x == Approx(-std::sqrt(2.0)));
  CHECK(diamond.world.upper.y == Approx(2.0 * std::sqrt(2.0)));
}

TEST_CASE("mistakes in a scenario of a map of map_server") {
  const ExperimentFolder folder;
  write_attic();
  CHECK(mistake("attic.yaml", "attik.yaml") ==
        "attic/scenario.toml:7:8: no file 'attik.yaml' beside the scenario file");
  CHECK(mistake("attic.yaml", "attic.pgm") == "attic/scenario.toml:7:8: 'file' must be a .map or .yaml or .yml file");
  CHECK(mistake("attic.yaml\"", "attic.yaml\"\nunknown = \"fre\"") ==
        "attic/scenario.toml:8:11: 'unknown' must be one of occupied, free, not 'fre' (did you mean 'free'?)");
  CHECK(mistake("attic.yaml\"", "attic.yaml\"\ncell_m = 1") ==
        "attic/scenario.toml:8:1: unknown key 'cell_m' for a map of map_server");
  CHECK(mistake("\n[map]", "origin_m = [0, 0]\n\n[map]") ==
        "attic/scenario.toml:5:1: a map of map_server has an 'origin' of its own");
  CHECK(mistake("[[robot]]\nstart = [-0.75, 2.25]\ngoal = [-0.25, 2.25, 1.57]", "[robots]\nscen = \"attic.scen\"") ==
        "attic/scenario.toml:10:8: 'scen' needs a [map] of MovingAI that its tasks are for");
  std::string board = "P5 1000 502 255\n";
  for (int row = 0; row < 502; ++row)
    for (int column = 0; column < 1000; ++column) board += (row + column) % 2 == 0 ? '\0' : '\xfe';
  write_file("attic/attic.pgm", board);
  CHECK(mistake("[-0.75", "[-0.70") ==
        "attic/scenario.toml:7:8: the map is too rough: its blocked cells make 251000 boxes, at most 250000");
}

TEST_CASE("mistakes in a map's YAML file") {
  const ExperimentFolder folder;
  write_attic();
  const auto told = [](const std::string& from, const std::string& to) {
    write_file("attic/attic.yaml", with(yaml_text, from, to));
    return mistake_of_map();
  };
  const std::string at = "attic/attic.yaml:";
  CHECK(told("attic.pgm", "attik.pgm") == at + "1:8: no file 'attik.pgm' beside the map file");
  CHECK(told("image: attic.pgm\n", "") == at + "1:1: the map needs 'image'");
  CHECK(told("image:", "imag:") == at + "1:1: unknown key 'imag' (did you mean 'image'?)");
  CHECK(told("attic.pgm", "[attic.pgm]") == at + "1:8: 'image' must be a text");
  CHECK(told("0.5", "0.0") == at + "2:13: 'resolution' must be from 0.001 to 100, not 0");
  CHECK(told("0.5", "-0.5") == at + "2:13: 'resolution' must be from 0.001 to 100, not -0.5");
  CHECK(told("0.5", ".nan") == at + "2:13: 'resolution' must be a number, not '.nan'");
  CHECK(told("0.5", ".inf") == at + "2:13: 'resolution' must be from 0.001 to 100, not inf");
  CHECK(told("0.5", "half") == at + "2:13: 'resolution' must be a number, not 'half'");
  CHECK(told("[-1.0, 2.0, 0.0]", "[-1.0, 2.0]") == at + "3:9: 'origin' must be [x, y, yaw]");
  CHECK(told("[-1.0, 2.0, 0.0]", "7") == at + "3:9: 'origin' must be [x, y, yaw]");
  CHECK(told("[-1.0, 2.0, 0.0]", "[-1.0, here, 0.0]") == at + "3:16: 'origin' must be a number, not 'here'");
  CHECK(told("negate: 0", "negate: 2") == at + "4:9: 'negate' must be 0 or 1, not '2'");
  CHECK(told("negate: 0\n", "") == at + "1:1: the map needs 'negate'");
  CHECK(told("0.65", "1.65") == at + "5:18: 'occupied_thresh' must be from 0 to 1, not 1.65");
  CHECK(told("0.196", "0.7") == at + "6:14: 'free_thresh' must be below 'occupied_thresh', not 0.7 and 0.65");
  CHECK(told("negate: 0", "negate: 0\nmode: trinaty") ==
        at + "5:7: 'mode' must be one of trinary, scale, raw, not 'trinaty' (did you mean 'trinary'?)");
  CHECK(told("negate: 0", "image: b.pgm") == at + "4:1: 'image' occurs twice");
  CHECK(told("[-1.0, 2.0, 0.0]", "[-1.0, 2.0, 0.0") == at + "4:7: end of sequence flow not found");
  CHECK(told(yaml_text, "attic.pgm") == at + "1:1: expected 'image: ...' and other keys: this is no map of map_server");
  CHECK(told(yaml_text, "") == at + "1:1: expected 'image: ...' and other keys: this is no map of map_server");
  CHECK(told(yaml_text, std::string(1 << 17, 'a')) == at + "1:1: the file is too large: 131072 bytes, at most 65536");
  CHECK(told(yaml_text, std::string(60'000, '[')).substr(0, at.size()) == at);
}

TEST_CASE("mistakes in a map's image") {
  const ExperimentFolder folder;
  write_attic();
  const auto told = [](const std::string& image) {
    write_file("attic/attic.pgm", image);
    return mistake_of_map();
  };
  const std::string at = "attic/attic.pgm:";
  CHECK(told("P6 3 2 255 ") == at + "1:1: expected a PGM (P2 or P5) or PNG image");
  CHECK(told("") == at + "1:1: expected a PGM (P2 or P5) or PNG image");
  CHECK(told("P5 three") == at + "1:4: the width must be a whole number");
  CHECK(told("P5\n3") == at + "2:2: the file ends before the height");
  CHECK(told("P5\n# size\n-3 2 255 ") == at + "3:1: the width must be a whole number");
  CHECK(told("P5\n0 2 255 ") == at + "1:3: the image has no cells");
  CHECK(told("P5\n32000 32000 255 ") ==
        at + "1:3: the map is too large: 32000 x 32000 cells, at most 10000 a side and 16777216 altogether");
  CHECK(told("P5\n99999999999999999999 2 255 ") == at + "2:1: the width must be at most 4294967295");
  CHECK(told("P5 3 2 0 ") == at + "1:8: maxval must be at least 1");
  CHECK(told("P5 3 2 65536 ") == at + "1:8: maxval must be at most 65535");
  CHECK(told("P5 3 2 255\n12345") == at + "2:1: the image ends after 5 of 6 grey values");
  CHECK(told("P5 3 2 256\n12345678901") == at + "2:1: the image ends after 5 of 6 grey values");
  CHECK(told("P5 3 2 49\n012345") == at + "2:1: grey value 3 of the image is 50, above maxval 49");
  CHECK(told("P2 3 2 255\n1 2 3\n4 256 6") == at + "3:3: a grey value must be at most 255");
  CHECK(told("P2 3 2 255\n1 2 3\n4 5") == at + "3:4: the file ends before a grey value");
  CHECK(told("P2 3 2 255\n1 2 3\n4 five") == at + "3:3: a grey value must be a whole number");
  CHECK(told("P5 3 2 255\n1234567") == at + "2:1: the file has 1 byte more than 3 x 2 grey values need");
  CHECK(told("P5 3 2 255\n123456\n\n") == at + "2:1: the file has 2 bytes more than 3 x 2 grey values need");
  CHECK(told("P5 3 2 256\n12345678901211") == at + "2:1: the file has 2 bytes more than 3 x 2 grey values need");
  CHECK(told("P5\r\n3 2\r\n255\r\n123456") ==
        at + "3:5: the file has 1 byte more than 3 x 2 grey values need: its header must end with LF, not CR LF");
  CHECK(told("P5\r\n3 2\r\n255\r\n12345\n") ==
        at + "3:5: the file has 1 byte more than 3 x 2 grey values need: its header must end with LF, not CR LF");
  CHECK(told("P5 3 2 255\n123456\n") == "no error");
  CHECK(told("P5 3 2 255\n123456\r\n") == "no error");
  CHECK(told("P2 3 2 255\n1 2 3\n4 5 6 7") == at + "3:7: the file goes on after the image's last grey value");
  CHECK(told("P2\r\n3 2\r\n255\r\n1 2 3 4 5 6\r\n# drawn by hand") == "no error");
  CHECK(told("\x89PNG\r\n\x1a\n") == at + "1:1: the PNG image cannot be read: the file ends early");
  std::string large = png_of({}, 3, "123456");
  large[18] = '\x7f';  // of the width
  CHECK(told(large).substr(0, at.size() + 5) == at + "1:1: ");
}

TEST_CASE("damaged maps give an error of one line or a map") {
  const ExperimentFolder folder;
  write_attic();
  const std::string png = png_of({PNG_COLOR_TYPE_GRAY_ALPHA, 8, PNG_INTERLACE_ADAM7}, 3, "123456789012");
  const std::string raw_pgm = "P5\n# a\n3 2\n255\n" + bytes_of({254, 205, 0, 254, 254, 0});
  const std::regex line("attic/attic\\.(yaml|pgm):[0-9]+:[0-9]+: [^\\x00-\\x1f]+|no error");
  const auto check = [&](const std::string& file, const std::string& bytes) {
    write_file("attic/" + file, bytes);
    const std::string told = mistake_of_map();
    INFO(told);
    REQUIRE(std::regex_match(told, line));
    return told != "no error";
  };
  for (const auto& [file, whole] :
       {std::pair<std::string, std::string>{"attic.pgm", png}, {"attic.pgm", raw_pgm}, {"attic.yaml", yaml_text}}) {
    write_attic();
    // the last line of YAML can end early and still be whole
    const std::size_t needed = file == "attic.yaml" ? whole.size() - 5 : whole.size();
    for (std::size_t length = 0; length < needed; ++length) CHECK(check(file, whole.substr(0, length)));
    for (std::size_t i = 0; i < whole.size(); ++i)
      for (int bit = 0; bit < 8; ++bit) {
        std::string flipped = whole;
        flipped[i] = static_cast<char>(flipped[i] ^ (1 << bit));
        check(file, flipped);
      }
  }
  toolkit::Stream stream(1, "damage");
  for (int round = 0; round < 500; ++round) {
    write_attic();
    std::string text = yaml_text;
    for (std::uint64_t i = stream.below(6); i-- > 0;)
      text[stream.below(text.size())] = "[]{}:,&*!|>'\"%@`#-? \n\t0~"[stream.below(25)];
    check("attic.yaml", text);
  }
}

TEST_CASE("public maps become few shapes that contain every blocked cell") {
  const auto data = test_data();
  if (!data || !std::filesystem::is_directory(*data / "mrpb")) {
    WARN("skipped: DMRP_TEST_DATA is not set");
    return;
  }
  for (const char* name : {"shopping_mall", "office02", "room02", "narrow_graph"})
    for (const UnknownCells unknown : {UnknownCells::occupied, UnknownCells::free}) {
      const host::RosMap map = host::read_ros_map(*data / "mrpb" / name / "map.yaml", name, unknown);
      CHECK(map.cells.width == 380);
      CHECK(map.resolution_m == 0.1);
      CHECK(map.origin.x == -19.0);
      const auto blocked = std::count(map.cells.free.begin(), map.cells.free.end(), 0);
      const auto shapes = core::place_boxes(map.cells, map.resolution_m, map.origin).shapes;
      INFO(name << ": " << blocked << " cells, " << shapes.size() << " shapes");
      CHECK(10 * shapes.size() <= static_cast<std::size_t>(blocked));
      double area = 0.0;
      for (const core::Shape& shape : shapes) {
        const dmrp_vec2 size = shape.vertices[2] - shape.vertices[0];
        area += size.x * size.y;
      }
      CHECK(area == Approx(0.01 * static_cast<double>(blocked)));
    }
}

}  // namespace ros_map_test
