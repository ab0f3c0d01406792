// SPDX-License-Identifier: MIT
#include "host/check/rehearsal/fence.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <new>

namespace dmrp::host {

namespace {

// All addresses that blocks ever have: none is used twice, so that one which was kept is found whenever it is used.
class Reserve {
 public:
  Reserve() {
    void* const memory = mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    begin_ = next_ = static_cast<std::uint8_t*>(memory);
  }

  std::uint8_t* take(std::size_t wanted) {
    if (wanted > static_cast<std::size_t>(begin_ + bytes - next_)) throw std::bad_alloc();
    std::uint8_t* const taken = next_;
    next_ += wanted;
    return taken;
  }

  bool has(const std::uint8_t* address) const { return address >= begin_ && address < begin_ + bytes; }

 private:
  static constexpr std::size_t bytes = std::size_t{1} << 38;
  std::uint8_t* begin_;
  std::uint8_t* next_;
};

std::mutex mutex;  // instances may run on two threads
Reserve* reserve = nullptr;
constexpr std::size_t most_live = 4096;
struct Live {
  const std::uint8_t* begin;
  const std::uint8_t* end;  // of its pages
};
Live live[most_live];  // for the signal handler
std::size_t live_count = 0;

std::size_t page_bytes() {
  static const auto bytes = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return bytes;
}

void forget(const std::uint8_t* begin) {
  Live* const found = std::find_if(live, live + live_count, [&](const Live& one) { return one.begin == begin; });
  if (found != live + live_count) *found = live[--live_count];
}

}  // namespace

std::uint8_t* Fence::add(std::size_t bytes, std::uint8_t value) {
  const std::lock_guard lock(mutex);
  if (!reserve) reserve = new Reserve;
  const std::size_t pages = (bytes + page_bytes() - 1) / page_bytes() * page_bytes();
  std::uint8_t* const first = reserve->take(pages + page_bytes());
  if (mprotect(first, pages, PROT_READ | PROT_WRITE) != 0) throw std::bad_alloc();
  blocks_.push_back({first, pages});
  if (live_count < most_live) live[live_count++] = {first, first + pages};
  std::uint8_t* const block = first + (pages - bytes);
  std::memset(block, value, bytes);
  return block;
}

void Fence::seal() {
  for (const Block& block : blocks_) mprotect(block.first_page, block.pages_bytes, PROT_READ);
}

void Fence::release() {
  const std::lock_guard lock(mutex);
  for (const Block& block : blocks_) {
    madvise(block.first_page, block.pages_bytes, MADV_DONTNEED);
    mprotect(block.first_page, block.pages_bytes, PROT_NONE);
    forget(block.first_page);
  }
  blocks_.clear();
}

const char* fence::breach(const void* address) {
  const auto* const place = static_cast<const std::uint8_t*>(address);
  if (!reserve || !reserve->has(place)) return nullptr;
  for (std::size_t i = 0; i < live_count; ++i) {
    if (place >= live[i].begin && place < live[i].end) return "wrote to its input";
    if (place >= live[i].end && place < live[i].end + page_bytes()) return "went beyond the end of what it was given";
  }
  return "used what it was given for an earlier call or trial";
}

}  // namespace dmrp::host
