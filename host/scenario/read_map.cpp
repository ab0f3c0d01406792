// SPDX-License-Identifier: MIT
#include "host/scenario/read_map.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/maps/movingai.hpp"
#include "host/maps/ros_map.hpp"
#include "host/scenario/named_file.hpp"
#include "host/toml/setting.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

const std::vector<std::string> unknown_choices = {"occupied", "free"};

// A file with one of these extensions that scenario.toml names.
NamedFile file_of_type(const TomlValue& value, const fs::path& scenario_file, const std::string& shown_path,
                       const std::vector<std::string>& extensions, ScenarioFile& out) {
  if (const std::string type = fs::path(value.line()).extension().string();
      std::find(extensions.begin(), extensions.end(), type) == extensions.end())
    value.fail(fmt::format("'{}' must be a {} file", value.key(), fmt::join(extensions, " or ")));
  return named_file(value, scenario_file, shown_path, out);
}

// A noisy map has more boxes than any building and would fill the memory. `at`: the name of the map.
void check_roughness(const TomlValue& at, const core::CellMap& cells) {
  constexpr std::size_t max_boxes = 250'000;
  if (const std::size_t boxes = core::count_boxes(cells); boxes > max_boxes)
    at.fail(fmt::format("the map is too rough: its blocked cells make {} boxes, at most {}", boxes, max_boxes));
}

MapCensus census_of(const fs::path& file, const core::CellMap& cells) {
  return {file.filename().string(), cells.free.size(),
          static_cast<std::size_t>(std::count(cells.free.begin(), cells.free.end(), 1))};
}

TaskMap read_movingai(const TomlTable& table, const TomlValue& name, const NamedFile& file, ScenarioFile& out) {
  core::Scenario& scenario = out.scenario;
  table.allow_only({"file", "cell_m"}, " for a MovingAI map");
  TaskMap map;
  map.cells = read_movingai_map(file.path, file.shown_path);
  check_roughness(name, map.cells);
  out.census = census_of(file.path, map.cells);
  const auto cell = table.find("cell_m");
  if (cell) {
    cell->positive();
    map.cell_m = cell->number(0.0, max_side_m);
  }
  const dmrp_vec2 extent = {map.cell_m * map.cells.width, map.cell_m * map.cells.height};
  check_extent(cell ? *cell : name, extent);
  scenario.upper = {scenario.lower.x + extent.x, scenario.lower.y + extent.y};
  scenario.shapes = core::boxes_of(map.cells, map.cell_m, scenario.lower);
  return map;
}

void read_map_server(const TomlTable& root, const TomlTable& table, const TomlValue& name, const NamedFile& file,
                     ScenarioFile& out) {
  table.allow_only({"file", "unknown"}, " for a map of map_server");
  if (const auto origin = root.find_table("scenario")->find("origin_m"))
    origin->fail_at_key("a map of map_server has an 'origin' of its own");
  std::optional<UnknownCells> unknown;
  if (const auto asked = table.find("unknown"))
    unknown = asked->choice(unknown_choices) == "free" ? UnknownCells::free : UnknownCells::occupied;
  const RosMap map = read_ros_map(file.path, file.shown_path, unknown);
  check_roughness(name, map.cells);
  MapCensus& census = out.census.emplace(census_of(file.path, map.cells));
  census.unknown = map.unknown;
  census.unknown_is_free = unknown == UnknownCells::free;
  if (census.unknown_is_free) census.free -= map.unknown;
  if (map.unknown_as_free > 0)
    out.warnings.push_back(fmt::format(
        "{}: {} cell{} of grey 205, as map_saver writes unknown ones, count as free by free_thresh = {}: unknown = "
        "\"occupied\" in [map] makes them walls, \"free\" keeps them free",
        name.place(), map.unknown_as_free, map.unknown_as_free == 1 ? "" : "s", map.free_thresh));
  out.files.push_back(map.image);
  out.scenario.edge_is_open = true;
  core::PlacedBoxes placed = core::place_boxes(map.cells, map.resolution_m, map.origin);
  check_extent(name, {placed.world.upper.x - placed.world.lower.x, placed.world.upper.y - placed.world.lower.y});
  out.scenario.lower = placed.world.lower;
  out.scenario.upper = placed.world.upper;
  out.scenario.shapes = std::move(placed.shapes);
}

}  // namespace

std::vector<TomlKey> map_keys() {
  return {{"file"}, {"cell_m", positive_text(max_side_m)}, {"unknown", choices_text(unknown_choices)}};
}

std::vector<TomlKey> tasks_keys() {
  return {{"scen"}, {"count", "at least 1"}};
}

std::optional<TaskMap> read_map(const TomlTable& root, const fs::path& file, const std::string& shown_path,
                                ScenarioFile& out) {
  const auto table = root.find_table("map");
  if (!table) return std::nullopt;
  table->allow_only_keys(map_keys());
  const TomlValue name = table->need("file");
  out.size = name.position();
  const NamedFile map = file_of_type(name, file, shown_path, {".map", ".yaml", ".yml"}, out);
  if (map.path.extension() == ".map") return read_movingai(*table, name, map, out);
  read_map_server(root, *table, name, map, out);
  return std::nullopt;
}

void read_tasks(const TomlTable& table, const std::optional<TaskMap>& map, const fs::path& file,
                const std::string& shown_path, ScenarioFile& out) {
  table.allow_only_keys(tasks_keys());
  const TomlValue name = table.need("scen");
  if (!map) name.fail("'scen' needs a [map] of MovingAI that its tasks are for");
  const NamedFile tasks = file_of_type(name, file, shown_path, {".scen"}, out);
  const MovingAiTasks read = read_movingai_tasks(tasks.path, tasks.shown_path, map->cells);
  std::size_t count = read.tasks.size();
  if (const auto asked = table.find("count")) {
    count = static_cast<std::size_t>(asked->integer(1));
    if (count > read.tasks.size())
      asked->fail(fmt::format("{} has {} task{}, not {}", read.shown_path, read.tasks.size(),
                              read.tasks.size() == 1 ? "" : "s", count));
  }
  const auto pose_of = [&](MovingAiCell cell) {
    const dmrp_vec2 center = center_of(cell, map->cells, map->cell_m);
    return dmrp_pose{out.scenario.lower.x + center.x, out.scenario.lower.y + center.y, core::free_heading};
  };
  for (std::size_t i = 0; i < count; ++i) {
    out.scenario.robots.push_back(
        {fmt::format("robot {}", i), pose_of(read.tasks[i].start), {pose_of(read.tasks[i].goal)}});
    out.robots.push_back(name.position());
  }
}

}  // namespace dmrp::host
