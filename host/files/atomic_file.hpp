// SPDX-License-Identifier: MIT
// atomic_file.hpp: replaces a file atomically: readers find the old or the new content.
#pragma once

#include <filesystem>
#include <string_view>

namespace dmrp::host {

// Writes a temporary file beside `path`, syncs it, renames it and syncs the folder. Throws std::system_error with the
// path and then leaves no temporary file.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

// Does the same for a path that the user names, but writes into what is no regular file, such as /dev/null, a pipe or a
// link.
void write_named_file(const std::filesystem::path& path, std::string_view content);

}  // namespace dmrp::host
