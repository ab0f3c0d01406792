// SPDX-License-Identifier: MIT
#include "host/files/open_log.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "host/errors/input_error.hpp"

namespace dmrp::host {

int open_log(const std::filesystem::path& path) {
  // a pipe without a reader is ENXIO
  const int log = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0644);
  if (log < 0 && errno != ELOOP && errno != ENXIO)
    throw std::system_error(errno, std::generic_category(), path.string());
  struct stat found {};
  if (log >= 0 && fstat(log, &found) == 0 && S_ISREG(found.st_mode)) return log;
  if (log >= 0) close(log);
  throw InputError(path.string() + ": is no regular file");
}

}  // namespace dmrp::host
