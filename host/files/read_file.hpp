// SPDX-License-Identifier: MIT
// read_file.hpp: reads a file that the user names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace dmrp::host {

// All bytes of `file`. `shown_path`: its path in messages. Throws InputError if there is no such file, if it cannot be
// read, or if it has more than `max_bytes`.
std::string read_file(const std::filesystem::path& file, const std::string& shown_path,
                      std::uintmax_t max_bytes = 1 << 28);

// A path for messages: relative to the working directory if it lies inside, otherwise as it is.
std::string shown(const std::filesystem::path& path);

}  // namespace dmrp::host
