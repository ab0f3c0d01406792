// SPDX-License-Identifier: MIT
#include "host/files/atomic_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>

#include "host/files/sync_directory.hpp"

namespace dmrp::host {
namespace {

void write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw std::system_error(errno, std::generic_category());
    content.remove_prefix(static_cast<std::size_t>(written));
  }
}

// A file, or nothing: a device, a pipe or a link stays, and is written into.
bool is_replaced(const std::filesystem::path& path) {
  const auto status = std::filesystem::symlink_status(path);
  return !std::filesystem::exists(status) || std::filesystem::is_regular_file(status);
}

}  // namespace

void write_file_atomically(const std::filesystem::path& path, std::string_view content) {
  std::string beside = path.string() + ".XXXXXX";
  const int descriptor = ::mkstemp(beside.data());
  if (descriptor < 0) throw std::system_error(errno, std::generic_category(), path.string());
  try {
    write_all(descriptor, content);
    // mkstemp makes the file private; the files of a run are readable by all, as the umask allows.
    const mode_t mask = ::umask(0);
    ::umask(mask);
    if (::fchmod(descriptor, 0666 & ~mask) != 0 || ::fsync(descriptor) != 0)
      throw std::system_error(errno, std::generic_category());
    std::filesystem::rename(beside, path);
    sync_directory(path.parent_path());
  } catch (const std::system_error& error) {
    ::unlink(beside.c_str());
    ::close(descriptor);
    throw std::system_error(error.code(), path.string());
  }
  ::close(descriptor);
}

void write_named_file(const std::filesystem::path& path, std::string_view content) {
  if (is_replaced(path)) return write_file_atomically(path, content);
  std::ofstream out(path, std::ios::binary);
  out << content << std::flush;
  if (!out) throw std::system_error(errno, std::generic_category(), path.string());
}

}  // namespace dmrp::host
