// SPDX-License-Identifier: MIT
// read_scenario.hpp: reads scenario.toml, with the places in the file for later checks.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/scenario.hpp"
#include "host/scenario/scenario_variant.hpp"
#include "host/toml/toml_document.hpp"

namespace dmrp::host {

inline constexpr double max_side_m = 10'000.0;  // of a world

// The place of a recorded person in its file.
struct TrackPlace {
  std::string shown_path;
  std::string id;
  std::vector<std::size_t> lines;  // parallel to the track's points
};

// A [[recording]]: the tracks from `first` to `end`, exclusive.
struct RecordingPlace {
  SourcePosition position;
  std::string shown_path;
  std::size_t first = 0;
  std::size_t end = 0;
};

struct ScenarioFile {
  core::Scenario scenario;
  Grade grade;
  std::vector<std::filesystem::path> files;  // other files that it names, absolute: maps, tasks, recordings, tiles
  std::shared_ptr<const TomlDocument> document;
  SourcePosition size;                   // of the world
  std::optional<SourcePosition> inside;  // the point that is given, not the listed starts
  std::vector<SourcePosition> robots;    // parallel to scenario.robots
  std::vector<SourcePosition> regions;   // parallel to scenario.regions
  std::vector<SourcePosition> flows;     // parallel to scenario.flows
  std::vector<TrackPlace> tracks;        // parallel to scenario.tracks
  std::vector<RecordingPlace> recordings;
  std::optional<MapCensus> census;
  std::vector<std::string> warnings;  // one line each
};

// All tables of the format, with their keys.
std::vector<TomlKeys> scenario_keys();

// Fails at `at` if a world of this size is too large.
void check_extent(const TomlValue& at, dmrp_vec2 extent);

// Reads the file and checks everything that does not depend on a robot. `file`: its absolute path; `shown_path`: its
// path in messages; `level`: of a scenario with [grade], by default its first. Throws InputError.
ScenarioFile read_scenario_file(const std::filesystem::path& file, const std::string& shown_path,
                                std::optional<double> level = std::nullopt);

// The levels that [grade] lists; empty without it. Throws InputError.
std::vector<double> read_levels(const std::filesystem::path& file, const std::string& shown_path);

}  // namespace dmrp::host
