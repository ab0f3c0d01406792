// SPDX-License-Identifier: MIT
// read_scenario.hpp: scenario.toml as data, with the places that later checks point at.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/scenario.hpp"
#include "host/toml/toml_document.hpp"

namespace dmrp::host {

inline constexpr double longest_side_m = 10'000.0;  // of a world

// Where a recorded person stands in its file.
struct TrackPlace {
  std::string shown_path;
  std::string id;
  std::vector<std::size_t> lines;  // parallel to the track's points
};

// A [[recording]]: the tracks from `first` up to before `end`.
struct RecordingPlace {
  SourcePosition position;
  std::string shown_path;
  std::size_t first = 0;
  std::size_t end = 0;
};

struct ScenarioFile {
  core::Scenario scenario;
  std::vector<std::filesystem::path> files;  // that it is made of beside scenario.toml, absolute: a map, tasks
  std::shared_ptr<const TomlDocument> document;
  SourcePosition size;                  // of the world
  std::vector<SourcePosition> robots;   // parallel to scenario.robots
  std::vector<SourcePosition> regions;  // likewise
  std::vector<SourcePosition> flows;
  std::vector<TrackPlace> tracks;
  std::vector<RecordingPlace> recordings;
};

// Reads and checks the file, `file` being its absolute path, by itself: not yet against a robot. `shown_path`: as
// messages call it.
ScenarioFile read_scenario_file(const std::filesystem::path& file, const std::string& shown_path);

}  // namespace dmrp::host
