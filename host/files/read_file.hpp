// SPDX-License-Identifier: MIT
// read_file.hpp: the bytes of a file that the user names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace dmrp::host {

// All bytes of `file`; `shown_path`: as messages call it. An InputError where there is no such file, where it cannot be
// read, or where it has more than `most_bytes`.
std::string read_file(const std::filesystem::path& file, const std::string& shown_path,
                      std::uintmax_t most_bytes = 1 << 28);

// A path as a person standing here would write it.
std::string shown(const std::filesystem::path& path);

}  // namespace dmrp::host
