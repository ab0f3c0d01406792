// SPDX-License-Identifier: MIT
// read_recordings.hpp: reads [[recording]] of scenario.toml: recorded tracks of people.
//
// A recording is a CSV file: the line `time,id,x,y`, then a row for each person and time, in s and m, in the world
// frame; the trial begins at time 0. The rows of one person are in order of time. Ids are integers; equal ids in
// different recordings mean different people.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/scenario/read_scenario.hpp"

namespace dmrp::host {

inline const std::vector<TomlKey> recording_keys = {{"file"}};

// Reads all recordings into the scenario's tracks, in the order of each person's first row. `file`, `shown_path`: of
// scenario.toml.
void read_recordings(const TomlTable& root, const std::filesystem::path& file, const std::string& shown_path,
                     ScenarioFile& out);

}  // namespace dmrp::host
