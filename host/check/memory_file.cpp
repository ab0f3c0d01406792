// SPDX-License-Identifier: MIT
#include "host/check/memory_file.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "host/errors/machine_error.hpp"

namespace dmrp::host {

MemoryFile::MemoryFile() : file_(memfd_create("dmrp-answer", MFD_CLOEXEC)) {
  if (!file_.is_open()) throw MachineError("memfd_create", errno);
}

void MemoryFile::append(std::string_view bytes) const {
  if (!file_.write(bytes)) throw MachineError("an answer cannot be written", errno);
}

std::string MemoryFile::read() const {
  const off_t size = lseek(file_.number(), 0, SEEK_END);
  std::string text(static_cast<std::size_t>(std::max<off_t>(size, 0)), '\0');
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t count = pread(file_.number(), text.data() + done, text.size() - done, static_cast<off_t>(done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    done += static_cast<std::size_t>(count);
  }
  text.resize(done);
  return text;
}

}  // namespace dmrp::host
