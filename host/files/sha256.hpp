// SPDX-License-Identifier: MIT
// sha256.hpp: SHA-256 digests, in hexadecimal.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dmrp::host {

std::string sha256_of_bytes(std::string_view bytes);
std::string sha256_of_file(const std::filesystem::path& path);  // throws std::system_error

}  // namespace dmrp::host
