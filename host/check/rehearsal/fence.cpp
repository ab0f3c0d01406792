// SPDX-License-Identifier: MIT
#include "host/check/rehearsal/fence.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <new>
#include <optional>

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
std::optional<Reserve> heap;  // of fence::allocate(), which must not allocate
std::size_t heap_blocks = 0;
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

std::size_t whole_pages(std::size_t bytes) {
  return (bytes + page_bytes() - 1) / page_bytes() * page_bytes();
}

void give_back(std::uint8_t* first_page, std::size_t bytes) {
  madvise(first_page, bytes, MADV_DONTNEED);
  mprotect(first_page, bytes, PROT_NONE);
}

void forget(const std::uint8_t* begin) {
  Live* const found = std::find_if(live, live + live_count, [&](const Live& one) { return one.begin == begin; });
  if (found != live + live_count) *found = live[--live_count];
}

}  // namespace

std::uint8_t* Fence::add(std::size_t bytes, std::uint8_t value) {
  const std::lock_guard lock(mutex);
  if (!reserve) reserve = new Reserve;
  const std::size_t pages = whole_pages(bytes);
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
    give_back(block.first_page, block.pages_bytes);
    forget(block.first_page);
  }
  blocks_.clear();
}

void* fence::allocate(std::size_t bytes) {
  constexpr std::size_t most_blocks = 20'000;  // the kernel has a limit of mappings
  constexpr std::size_t most_bytes = std::size_t{1} << 30;
  const std::lock_guard lock(mutex);
  if (heap_blocks == most_blocks || bytes > most_bytes) return nullptr;
  if (!heap) heap.emplace();
  const std::size_t padded = (bytes + 15) / 16 * 16;  // what a compiler may take for granted
  const std::size_t pages = whole_pages(padded + 16);
  std::uint8_t* const first = heap->take(pages + page_bytes());
  if (mprotect(first, pages, PROT_READ | PROT_WRITE) != 0) return nullptr;
  ++heap_blocks;
  std::uint8_t* const block = first + (pages - padded);
  std::memcpy(block - 16, &bytes, sizeof(bytes));
  return block;
}

std::size_t fence::bytes_of(const void* block) {
  std::size_t bytes = 0;
  std::memcpy(&bytes, static_cast<const std::uint8_t*>(block) - 16, sizeof(bytes));
  return bytes;
}

bool fence::has_allocated(const void* block) {
  return heap && heap->has(static_cast<const std::uint8_t*>(block));
}

void fence::free(void* block) {
  const std::lock_guard lock(mutex);
  const std::size_t pages = whole_pages((bytes_of(block) + 15) / 16 * 16 + 16);
  auto* const end = reinterpret_cast<std::uint8_t*>(
      whole_pages(reinterpret_cast<std::uintptr_t>(block) + (bytes_of(block) + 15) / 16 * 16));
  give_back(end - pages, pages);
  --heap_blocks;
}

const char* fence::breach(const void* address) {
  const auto* const place = static_cast<const std::uint8_t*>(address);
  if (heap && heap->has(place)) return "went beyond a block of its memory, or used one that it had freed";
  if (!reserve || !reserve->has(place)) return nullptr;
  for (std::size_t i = 0; i < live_count; ++i) {
    if (place >= live[i].begin && place < live[i].end) return "wrote to its input";
    if (place >= live[i].end && place < live[i].end + page_bytes()) return "went beyond the end of what it was given";
  }
  return "used what it was given for an earlier call or trial";
}

}  // namespace dmrp::host
