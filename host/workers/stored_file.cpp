// SPDX-License-Identifier: MIT
#include "host/workers/stored_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

#include "host/files/sync_directory.hpp"
#include "host/process/descriptor.hpp"

namespace dmrp::host {

bool store_file(const std::filesystem::path& written, const std::filesystem::path& stored,
                const std::function<void()>& make_folder) {
  // neither follows a link, nor waits for a pipe's other end
  const Descriptor file(open(written.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat found {};
  if (!file.is_open() || fstat(file.number(), &found) != 0 || !S_ISREG(found.st_mode)) return false;
  if (fsync(file.number()) != 0) throw std::system_error(errno, std::generic_category(), written.string());
  constexpr int most_tries = 5;
  for (int tries = 1; rename(written.c_str(), stored.c_str()) != 0; ++tries) {
    if (errno != ENOENT || tries == most_tries)
      throw std::system_error(errno, std::generic_category(), stored.string());
    make_folder();
  }
  try {
    sync_directory(stored.parent_path());
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::no_such_file_or_directory) throw;  // deleted since: the trace is gone
  }
  return true;
}

}  // namespace dmrp::host
