// SPDX-License-Identifier: MIT
// sync_directory.hpp: the names of new files outlive a power cut.
#pragma once

#include <filesystem>

namespace dmrp::host {

// What was created, renamed or deleted in this directory is on the disk when it returns. Throws std::system_error.
void sync_directory(const std::filesystem::path& directory);

}  // namespace dmrp::host
