// SPDX-License-Identifier: MIT
// command_output.hpp: the output of commands: text, files, warnings.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace dmrp::host {

struct Experiment;

// "1 trial", "2 trials"
std::string plural(std::uint64_t n, const std::string& noun);

// A line for each map in use: "flat.yaml: 800 cells: 77 % free, 21 % walls, 2 % unknown (count as walls)". Before them
// one for cells that the experiment leaves to choose.
std::string map_lines(const Experiment& experiment);

// On standard error, as "warning: TEXT".
void warn(const std::string& text);

// Throws InputError if `file`, which `option` names, cannot be written because its folder is missing or it is a folder
// itself: found before a long computation. An empty path passes.
void check_output_file(const char* option, const std::filesystem::path& file);

// Writes `content` to the file that `option` names, or to standard output if `file` is empty. Throws InputError or
// MachineError.
void write_output(const char* option, const std::filesystem::path& file, std::string_view content);

}  // namespace dmrp::host
