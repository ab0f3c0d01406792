// SPDX-License-Identifier: MIT
#include "host/files/read_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "core/bytes/file.hpp"
#include "host/errors/input_error.hpp"

namespace dmrp::host {

namespace {

std::string content_of(const std::filesystem::path& path) {
  const core::File file = core::open_file(path, core::Links::followed);
  std::string text;
  std::array<char, 1 << 16> part;
  while (const std::size_t count = std::fread(part.data(), 1, part.size(), file.get())) text.append(part.data(), count);
  if (std::ferror(file.get())) throw std::system_error(errno, std::generic_category());
  return text;
}

}  // namespace

std::string read_file(const std::filesystem::path& file, const std::string& shown_path, std::uintmax_t max_bytes) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) throw InputError(shown_path + ": there is no such file");
  if (const auto size = std::filesystem::file_size(file, error); !error && size > max_bytes)
    throw InputError(fmt::format("{}:1:1: the file is too large: {} bytes, at most {}", shown_path, size, max_bytes));
  try {
    return content_of(file);
  } catch (const std::system_error&) {
    throw InputError(shown_path + ":1:1: the file cannot be read");
  }
}

std::string shown(const std::filesystem::path& path) {
  const std::string near = path.lexically_proximate(std::filesystem::current_path()).string();
  return near.starts_with("..") ? path.string() : near;
}

}  // namespace dmrp::host
