// SPDX-License-Identifier: MIT
#include "core/bytes/file_error.hpp"

#include <cerrno>
#include <system_error>

namespace dmrp::core {

void throw_file_error(const std::filesystem::path& path) {
  throw std::system_error(errno != 0 ? errno : EIO, std::generic_category(), path.string());
}

}  // namespace dmrp::core
