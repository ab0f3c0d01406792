// SPDX-License-Identifier: MIT
#include "host/scenario/read_tiles.hpp"

#include <fmt/format.h>

#include <string>

#include "host/errors/mistakes.hpp"
#include "host/files/read_file.hpp"
#include "host/scenario/find_scenario.hpp"
#include "host/toml/nearest_name.hpp"
#include "host/toml/setting.hpp"

namespace dmrp::host {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t max_tiles = 100;  // along a side

dmrp_vec2 moved(dmrp_vec2 point, dmrp_vec2 by) {
  return {point.x + by.x, point.y + by.y};
}

// Adds the tile's shapes, regions and flows, moved and renamed. `at`: the place of [tiles].
void add_tile(const core::Scenario& tile, dmrp_vec2 by, const std::string& suffix, SourcePosition at,
              ScenarioFile& out) {
  core::Scenario& scenario = out.scenario;
  const auto first_region = static_cast<std::uint32_t>(scenario.regions.size());
  for (core::Shape shape : tile.shapes) {
    shape.name += suffix;
    shape.center = moved(shape.center, by);
    for (dmrp_vec2& vertex : shape.vertices) vertex = moved(vertex, by);
    scenario.shapes.push_back(std::move(shape));
  }
  for (const core::Region& region : tile.regions) {
    scenario.regions.push_back({region.name + suffix, moved(region.lower, by), moved(region.upper, by)});
    out.regions.push_back(at);
  }
  for (core::Flow flow : tile.flows) {
    flow.name += suffix;
    for (std::uint32_t& region : flow.regions) region += first_region;
    scenario.flows.push_back(std::move(flow));
    out.flows.push_back(at);
  }
}

ScenarioFile read_tile(const TomlValue& of, const fs::path& file) {
  const fs::path tile_file = find_scenario(of.text(), file.parent_path());
  if (tile_file.empty())
    of.fail(fmt::format("no scenario '{}'{}", of.text(), did_you_mean(of.text(), known_scenarios())));
  if (tile_file == file) of.fail("a scenario cannot be made of itself");
  ScenarioFile tile = read_scenario_file(tile_file, shown(tile_file));
  if (tile.document->root().find_table("tiles")) of.fail(fmt::format("'{}' is made of tiles itself", of.text()));
  if (!tile.scenario.tracks.empty()) of.fail(fmt::format("'{}' has a [[recording]], which cannot be tiled", of.text()));
  tile.files.insert(tile.files.begin(), tile_file);
  return tile;
}

}  // namespace

std::vector<TomlKey> tiles_keys() {
  return {{"of"}, {"columns", range_text(1, max_tiles)}, {"rows", range_text(1, max_tiles)}};
}

void read_tiles(const TomlTable& root, const fs::path& file, ScenarioFile& out) {
  const auto table = root.find_table("tiles");
  if (!table) return;
  Mistakes mistakes;
  mistakes.attempt([&] { table->allow_only_keys(tiles_keys()); });
  mistakes.attempt([&] {
    if (const auto map = root.find("map")) map->fail_at_key("a scenario has either [tiles] or a [map]");
  });
  std::int64_t columns = 1;
  mistakes.attempt([&] { columns = table->need("columns").integer(1, max_tiles); });
  std::int64_t rows = 1;
  mistakes.attempt([&] {
    if (const auto asked = table->find("rows")) rows = asked->integer(1, max_tiles);
  });
  ScenarioFile tile;
  mistakes.attempt([&] { tile = read_tile(table->need("of"), file); });
  mistakes.end();
  const TomlValue of = table->need("of");
  out.size = of.position();
  out.census = tile.census;
  out.warnings = tile.warnings;
  out.files.insert(out.files.end(), tile.files.begin(), tile.files.end());

  core::Scenario& scenario = out.scenario;
  const dmrp_vec2 extent = {tile.scenario.upper.x - tile.scenario.lower.x,
                            tile.scenario.upper.y - tile.scenario.lower.y};
  const dmrp_vec2 whole = {extent.x * static_cast<double>(columns), extent.y * static_cast<double>(rows)};
  check_extent(of, whole);
  scenario.upper = moved(scenario.lower, whole);
  scenario.people = tile.scenario.people;
  for (std::int64_t row = 0; row < rows; ++row)
    for (std::int64_t column = 0; column < columns; ++column) {
      const dmrp_vec2 corner = {scenario.lower.x + extent.x * static_cast<double>(column),
                                scenario.lower.y + extent.y * static_cast<double>(row)};
      add_tile(tile.scenario, {corner.x - tile.scenario.lower.x, corner.y - tile.scenario.lower.y},
               fmt::format(", tile {}/{}", column + 1, row + 1), table->position(), out);
    }
}

}  // namespace dmrp::host
