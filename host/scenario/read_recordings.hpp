// SPDX-License-Identifier: MIT
// read_recordings.hpp: [[recording]] of scenario.toml: people as they walked when somebody recorded them.
//
// A recording is a CSV file: the line `time,id,x,y`, then a row for each person and moment, in s and m, in the world's
// frame; the trial begins at time 0. The rows of one person are in order of time; ids are whole numbers, persons of
// several recordings are different people.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/scenario/read_scenario.hpp"

namespace dmrp::host {

inline const std::vector<std::string> recording_keys = {"file"};

// Reads all of them into the scenario's tracks, in the order in which people first appear in the files. `file`,
// `shown_path`: of scenario.toml.
void read_recordings(const TomlTable& root, const std::filesystem::path& file, const std::string& shown_path,
                     ScenarioFile& out);

}  // namespace dmrp::host
