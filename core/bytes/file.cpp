// SPDX-License-Identifier: MIT
#include "core/bytes/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace dmrp::core {

File create_file(const std::filesystem::path& path) {
  std::error_code ignored;
  std::filesystem::remove(path, ignored);  // a link, not what it leads to
  File file(std::fopen(path.c_str(), "w+bxe"));
  if (!file) throw_file_error(path);
  return file;
}

File open_file(const std::filesystem::path& path, Links links) {
  const int descriptor =
      open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | (links == Links::refused ? O_NOFOLLOW : 0));
  if (descriptor < 0 && errno != ELOOP) throw_file_error(path);
  File file(descriptor < 0 ? nullptr : fdopen(descriptor, "rb"));
  struct stat found {};
  if (!file || fstat(descriptor, &found) != 0 || !S_ISREG(found.st_mode))
    throw std::system_error(EINVAL, std::generic_category(), path.string() + ": is no regular file");
  return file;
}

void throw_file_error(const std::filesystem::path& path) {
  throw std::system_error(errno != 0 ? errno : EIO, std::generic_category(), path.string());
}

}  // namespace dmrp::core
