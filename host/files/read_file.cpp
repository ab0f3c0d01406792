// SPDX-License-Identifier: MIT
#include "host/files/read_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "host/errors/input_error.hpp"

namespace dmrp::host {

std::string read_file(const std::filesystem::path& file, const std::string& shown_path, std::uintmax_t max_bytes) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) throw InputError(shown_path + ": there is no such file");
  if (const auto size = std::filesystem::file_size(file, error); !error && size > max_bytes)
    throw InputError(fmt::format("{}:1:1: the file is too large: {} bytes, at most {}", shown_path, size, max_bytes));
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  std::string text = bytes.str();
  // Reading an empty file sets a failure bit although nothing failed.
  if (!stream.is_open() || stream.bad() || (!stream && !text.empty()))
    throw InputError(shown_path + ":1:1: the file cannot be read");
  return text;
}

std::string shown(const std::filesystem::path& path) {
  const std::string near = path.lexically_proximate(std::filesystem::current_path()).string();
  return near.starts_with("..") ? path.string() : near;
}

}  // namespace dmrp::host
