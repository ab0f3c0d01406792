// SPDX-License-Identifier: MIT
// atomic_file.hpp: files that are either old or whole, never half.
#pragma once

#include <filesystem>
#include <string_view>

namespace dmrp::host {

// Writes beside `path` and renames. Throws std::system_error with the path; nothing is left behind then.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

}  // namespace dmrp::host
