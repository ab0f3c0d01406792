// SPDX-License-Identifier: MIT
// open_log.hpp: log.txt, in a run directory that can be a stranger's.
#pragma once

#include <filesystem>

namespace dmrp::host {

// A descriptor that appends to the file, which it creates where there is none. Throws InputError if it is no regular file,
// and std::system_error.
int open_log(const std::filesystem::path& path);

}  // namespace dmrp::host
