// SPDX-License-Identifier: MIT
#include "host/plugins/calls/own_process.hpp"

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>

#include "host/errors/machine_error.hpp"

namespace dmrp::host::own_process {

namespace {

volatile std::uint64_t* is_original = nullptr;  // on a page that is all zero in a copy
}  // namespace

void watch() {
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* const memory = mmap(nullptr, page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw MachineError("mmap", errno);
  if (madvise(memory, page, MADV_WIPEONFORK) != 0) throw MachineError("madvise", errno);
  is_original = static_cast<std::uint64_t*>(memory);
  *is_original = 1;
}

bool is_copy() {
  return is_original && *is_original == 0;
}

bool has_children() {
  siginfo_t child{};
  return waitid(P_ALL, 0, &child, WEXITED | WNOHANG | WNOWAIT | __WALL) == 0 || errno != ECHILD;
}

}  // namespace dmrp::host::own_process
