// SPDX-License-Identifier: MIT
// fence.hpp: memory for what a case passes to a plugin. Each block ends where a page begins that nobody may touch, is
// read-only once it is sealed, and may not be touched any more once it is released: a plugin that does so crashes, and
// fence::breach() says what it did.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dmrp::host {

class Fence {
 public:
  Fence() = default;
  ~Fence() { release(); }
  Fence(const Fence&) = delete;
  Fence& operator=(const Fence&) = delete;

  // A block of so many bytes, a multiple of 8, all of this value. Throws std::bad_alloc.
  std::uint8_t* add(std::size_t bytes, std::uint8_t value);

  // No block may be written to from now on.
  void seal();

  // Ends the life of all blocks.
  void release();

 private:
  struct Block {
    std::uint8_t* first_page;
    std::size_t pages_bytes;
  };
  std::vector<Block> blocks_;
};

namespace fence {

// What an access to this address that the kernel refuses means, in words; nullptr if the address is none of a fence's.
// Async-signal-safe.
const char* breach(const void* address);

// A block of memory of the plugin's own, which ends where a page begins that nobody may touch (16 bytes are the unit).
// nullptr if there are too many, or if it is larger than 1 GB. Once it is free, nobody may touch it any more.
void* allocate(std::size_t bytes);
bool has_allocated(const void* block);
std::size_t bytes_of(const void* block);
void free(void* block);

}  // namespace fence

}  // namespace dmrp::host
