// SPDX-License-Identifier: MIT
#include "host/process/own_process.hpp"

#include <pthread.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <vector>

#include "host/errors/machine_error.hpp"

namespace dmrp::host::own_process {

namespace {

volatile std::uint64_t* is_original = nullptr;  // on a page that is all zero in a copy
pid_t watched = 0;
std::atomic<std::uint64_t> copies = 0;

struct Watched {
  int descriptor;
  dev_t device;
  ino_t file;
};
std::vector<Watched>* descriptors = nullptr;

Watched identity(int descriptor) {
  struct stat found {};
  if (fstat(descriptor, &found) != 0) return {descriptor, 0, 0};
  return {descriptor, found.st_dev, found.st_ino};
}

void count_copy() {
  ++copies;
}

void close_in_copy() {
  for (const Watched& one : *descriptors) close(one.descriptor);
}

}  // namespace

void watch(std::initializer_list<int> numbers) {
  if (!descriptors) {
    static std::vector<Watched> all;
    descriptors = &all;
    pthread_atfork(nullptr, &count_copy, &close_in_copy);
  }
  descriptors->clear();
  for (const int number : numbers) descriptors->push_back(identity(number));
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* const memory = mmap(nullptr, page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw MachineError("mmap", errno);
  if (madvise(memory, page, MADV_WIPEONFORK) != 0) throw MachineError("madvise", errno);
  is_original = static_cast<std::uint64_t*>(memory);
  *is_original = 1;
  watched = getpid();
}

bool has_descriptors() {
  return !descriptors || std::all_of(descriptors->begin(), descriptors->end(), [](const Watched& before) {
    const Watched now = identity(before.descriptor);
    return now.device == before.device && now.file == before.file;
  });
}

bool is_copy() {
  return is_original && *is_original == 0;
}

bool is_other_process() {
  return is_original && (is_copy() || getpid() != watched);
}

std::uint64_t copies_made() {
  return copies;
}

bool has_children() {
  siginfo_t child{};
  return waitid(P_ALL, 0, &child, WEXITED | WNOHANG | WNOWAIT | __WALL) == 0 || errno != ECHILD;
}

}  // namespace dmrp::host::own_process
