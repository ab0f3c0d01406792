// SPDX-License-Identifier: MIT
// try_to_write.hpp: whether the machine can write files.
#pragma once

#include <filesystem>

namespace dmrp::host {

// Writes a small file in this folder, and deletes it.
bool can_write_in(const std::filesystem::path& folder);

// Whether `ulimit -f` limits the size of this process's files.
bool files_are_limited();

}  // namespace dmrp::host
