// SPDX-License-Identifier: MIT
// executable.hpp: this program: its folders, and how it was called. Installation and build tree have the same layout.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dmrp::host {

// Absolute, without symbolic links.
const std::filesystem::path& executable_path();

// The prefix of the installation, or the build tree.
std::filesystem::path installation_path();

// share/dmrp of the installation: scenarios/, layouts/, parameter_sets/.
std::filesystem::path shared_data_path();

// The file's name of a library that comes with this program, in lib/dmrp/plugins; empty for others.
std::string name_of_own_library(const std::filesystem::path& file);

// The folders of a colon-separated environment variable, without empty ones.
std::vector<std::filesystem::path> folders_of_variable(const char* name);

// How this process was called, with the program's name first.
std::vector<std::string> command_line();

}  // namespace dmrp::host
