// SPDX-License-Identifier: MIT
#include "host/files/try_to_write.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <string>

namespace dmrp::host {

bool can_write_in(const std::filesystem::path& folder) {
  std::string name = (folder / ".write_test_XXXXXX").string();
  const int file = mkostemp(name.data(), O_CLOEXEC);
  if (file < 0) return false;
  const std::array<char, 4096> block{};
  const bool written =
      write(file, block.data(), block.size()) == static_cast<ssize_t>(block.size()) && fsync(file) == 0;
  close(file);
  unlink(name.c_str());
  return written;
}

bool files_are_limited() {
  rlimit files{};
  return getrlimit(RLIMIT_FSIZE, &files) == 0 && files.rlim_cur != RLIM_INFINITY;
}

}  // namespace dmrp::host
