// SPDX-License-Identifier: MIT
// network_file_system.hpp: whether a folder is on another machine.
#pragma once

#include <filesystem>
#include <string>

namespace dmrp::host {

// "NFS", "Lustre", ...: the file system that holds `path`, or would hold it. Empty for one of this machine, and for those
// that the kernel does not tell apart (FUSE, 9P).
std::string network_file_system(const std::filesystem::path& path);

}  // namespace dmrp::host
