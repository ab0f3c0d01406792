// SPDX-License-Identifier: MIT
// executable.hpp: where this program is, and what is found from there. Installation and build tree look alike.
#pragma once

#include <filesystem>
#include <vector>

namespace dmrp::host {

// Absolute, links resolved.
const std::filesystem::path& executable_path();

// share/dmrp of the installation: scenarios/, layouts/, parameter_sets/.
std::filesystem::path shared_data_path();

// The folders of a colon-separated environment variable; empty ones left out.
std::vector<std::filesystem::path> folders_of_variable(const char* name);

}  // namespace dmrp::host
