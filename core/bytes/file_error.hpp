// SPDX-License-Identifier: MIT
// file_error.hpp: the exception for a file that the machine fails to read or write.
#pragma once

#include <filesystem>

namespace dmrp::core {

// Throws std::system_error with errno (EIO if it is 0) and the path.
[[noreturn]] void throw_file_error(const std::filesystem::path& path);

}  // namespace dmrp::core
