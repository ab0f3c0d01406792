// SPDX-License-Identifier: MIT
#include "host/process/descriptor.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include "host/errors/machine_error.hpp"

namespace dmrp::host {

void Descriptor::close() {
  if (number_ >= 0) ::close(number_);
  number_ = -1;
}

bool Descriptor::write(std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t count = ::write(number_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

Pipe make_pipe() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw MachineError("pipe", errno);
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

}  // namespace dmrp::host
