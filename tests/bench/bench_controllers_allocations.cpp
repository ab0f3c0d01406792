// SPDX-License-Identifier: MIT
#include "tests/bench/bench_controllers_allocations.hpp"

#include <cerrno>
#include <cstddef>
#include <cstdlib>

// The C library's functions under the names that it exports for programs that replace malloc. What an executable
// defines comes before every shared library's, so plugins allocate here too.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
}

namespace {

std::uint64_t count_of_blocks = 0;  // one thread allocates here

}  // namespace

extern "C" {

void* malloc(std::size_t size) {
  ++count_of_blocks;
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) {
  ++count_of_blocks;
  return __libc_calloc(count, size);
}

void* realloc(void* block, std::size_t size) {
  ++count_of_blocks;
  return __libc_realloc(block, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++count_of_blocks;
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  ++count_of_blocks;
  *block = __libc_memalign(alignment, size);
  return *block ? 0 : ENOMEM;
}
}

namespace dmrp::bench {

std::uint64_t allocations() {
  return count_of_blocks;
}

}  // namespace dmrp::bench
