// SPDX-License-Identifier: MIT
#include "host/check/symbol_hooks.hpp"

#include <elf.h>
#include <link.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string_view>

#include "host/check/rehearsal/fence.hpp"
#include "host/plugins/calls/call_guard.hpp"

namespace dmrp::host {

namespace {

#if defined(__aarch64__)
constexpr std::uint32_t slot_types[] = {R_AARCH64_JUMP_SLOT, R_AARCH64_GLOB_DAT};
#else
constexpr std::uint32_t slot_types[] = {R_X86_64_JUMP_SLOT, R_X86_64_GLOB_DAT};
#endif

struct Hook {
  std::string_view name;
  void* function;
};

// The parts of a loaded object by which it finds functions of others.
struct Linkage {
  std::uintptr_t base = 0;
  const ElfW(Sym) * symbols = nullptr;
  const char* names = nullptr;
  std::array<std::span<const ElfW(Rela)>, 2> slots;  // of calls, of addresses
};

Linkage linkage_of(const dl_phdr_info& object) {
  Linkage found;
  found.base = object.dlpi_addr;
  std::array<const ElfW(Rela)*, 2> first{};
  std::array<std::size_t, 2> bytes{};
  for (int i = 0; i < object.dlpi_phnum; ++i) {
    if (object.dlpi_phdr[i].p_type != PT_DYNAMIC) continue;
    const auto* entry = reinterpret_cast<const ElfW(Dyn)*>(found.base + object.dlpi_phdr[i].p_vaddr);
    for (; entry->d_tag != DT_NULL; ++entry) {
      if (entry->d_tag == DT_SYMTAB) found.symbols = reinterpret_cast<const ElfW(Sym)*>(entry->d_un.d_ptr);
      if (entry->d_tag == DT_STRTAB) found.names = reinterpret_cast<const char*>(entry->d_un.d_ptr);
      if (entry->d_tag == DT_JMPREL) first[0] = reinterpret_cast<const ElfW(Rela)*>(entry->d_un.d_ptr);
      if (entry->d_tag == DT_PLTRELSZ) bytes[0] = entry->d_un.d_val;
      if (entry->d_tag == DT_RELA) first[1] = reinterpret_cast<const ElfW(Rela)*>(entry->d_un.d_ptr);
      if (entry->d_tag == DT_RELASZ) bytes[1] = entry->d_un.d_val;
    }
  }
  for (std::size_t i = 0; i < 2; ++i)
    if (first[i]) found.slots[i] = {first[i], bytes[i] / sizeof(ElfW(Rela))};
  return found;
}

// The host's program, the C library and the loader keep their functions.
bool is_hooked(std::string_view file) {
  static constexpr std::string_view others[] = {"libc.so", "ld-linux", "linux-vdso", "libasan", "libtsan"};
  const std::string_view name = file.substr(file.rfind('/') + 1);
  return !name.empty() && std::none_of(std::begin(others), std::end(others),
                                       [&](std::string_view other) { return name.starts_with(other); });
}

// The loader may have made the slots read-only.
void overwrite(std::uintptr_t slot, void* function) {
  const auto page_bytes = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  if (mprotect(reinterpret_cast<void*>(slot & ~(page_bytes - 1)), page_bytes, PROT_READ | PROT_WRITE) == 0)
    *reinterpret_cast<void**>(slot) = function;
}

void hook(std::span<const Hook> hooks) {
  const auto hook_object = [](dl_phdr_info* object, std::size_t, void* data) {
    if (!is_hooked(object->dlpi_name)) return 0;
    const Linkage linkage = linkage_of(*object);
    if (!linkage.symbols || !linkage.names) return 0;
    for (const auto& slots : linkage.slots)
      for (const ElfW(Rela) & slot : slots) {
        if (std::count(std::begin(slot_types), std::end(slot_types), ELF64_R_TYPE(slot.r_info)) == 0) continue;
        const std::string_view name = linkage.names + linkage.symbols[ELF64_R_SYM(slot.r_info)].st_name;
        for (const Hook& hook : *static_cast<const std::span<const Hook>*>(data))
          if (hook.name == name) overwrite(linkage.base + slot.r_offset, hook.function);
      }
    return 0;
  };
  dl_iterate_phdr(hook_object, &hooks);
}

template <class Function>
void* address(Function* function) {
  return reinterpret_cast<void*>(function);
}

// Clocks

std::atomic<std::int64_t> leap_ns = 0;    // of each look
std::atomic<std::int64_t> offset_ns = 0;  // of the next one

void leap(timespec& time) {
  const std::int64_t ns = time.tv_nsec + (offset_ns += leap_ns);
  time.tv_sec += ns / 1'000'000'000;
  time.tv_nsec = ns % 1'000'000'000;
}

int leaping_clock_gettime(clockid_t clock, timespec* out) {
  const int result = clock_gettime(clock, out);
  if (result == 0) leap(*out);
  return result;
}

int leaping_gettimeofday(timeval* out, void*) {
  timespec now{};
  leaping_clock_gettime(CLOCK_REALTIME, &now);
  *out = {now.tv_sec, now.tv_nsec / 1000};
  return 0;
}

std::time_t leaping_time(std::time_t* out) {
  timespec now{};
  leaping_clock_gettime(CLOCK_REALTIME, &now);
  if (out) *out = now.tv_sec;
  return now.tv_sec;
}

std::clock_t leaping_clock() {
  timespec now{};
  leaping_clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return now.tv_sec * CLOCKS_PER_SEC + now.tv_nsec / (1'000'000'000 / CLOCKS_PER_SEC);
}

// Memory

const CallGuard* counted_calls = nullptr;
std::atomic<std::int64_t> allocated = 0;
std::atomic<std::int64_t> allocated_bytes = 0;
std::atomic<std::int64_t> kept_bytes = 0;

void* counted(void* block) {
  if (!block || !counted_calls->in_call()) return block;
  const auto bytes = static_cast<std::int64_t>(malloc_usable_size(block));
  ++allocated;
  allocated_bytes += bytes;
  kept_bytes += bytes;
  return block;
}

void discount(void* block) {
  if (block && counted_calls->in_call()) kept_bytes -= static_cast<std::int64_t>(malloc_usable_size(block));
}

void* counted_malloc(std::size_t bytes) {
  return counted(std::malloc(bytes));
}
void* counted_calloc(std::size_t count, std::size_t bytes) {
  return counted(std::calloc(count, bytes));
}
void* counted_realloc(void* block, std::size_t bytes) {
  discount(block);
  return counted(std::realloc(block, bytes));
}
void* counted_aligned_alloc(std::size_t alignment, std::size_t bytes) {
  return counted(aligned_alloc(alignment, bytes));
}
int counted_posix_memalign(void** out, std::size_t alignment, std::size_t bytes) {
  const int result = posix_memalign(out, alignment, bytes);
  if (result == 0) counted(*out);
  return result;
}
void counted_free(void* block) {
  discount(block);
  std::free(block);
}

std::atomic<int> filling = 0;

void* filled_malloc(std::size_t bytes) {
  void* const block = std::malloc(bytes);
  return block ? std::memset(block, filling, bytes) : block;
}

const CallGuard* fenced_calls = nullptr;

void* fenced_malloc(std::size_t bytes) {
  void* const block = fenced_calls->in_call() ? fence::allocate(bytes) : nullptr;
  return block ? block : std::malloc(bytes);
}
void* fenced_calloc(std::size_t count, std::size_t bytes) {
  std::size_t all = 0;
  const bool fits = !__builtin_mul_overflow(count, bytes, &all);
  void* const block = fits && fenced_calls->in_call() ? fence::allocate(all) : nullptr;  // new pages are zero
  return block ? block : std::calloc(count, bytes);
}
void fenced_free(void* block) {
  fence::has_allocated(block) ? fence::free(block) : std::free(block);
}
void* fenced_realloc(void* block, std::size_t bytes) {
  if (!fence::has_allocated(block)) return std::realloc(block, bytes);
  void* const moved = fenced_malloc(bytes);
  if (!moved) return nullptr;
  std::memcpy(moved, block, std::min(bytes, fence::bytes_of(block)));
  fence::free(block);
  return moved;
}

}  // namespace

static void hook_clocks() {
  const std::array hooks = {Hook{"clock_gettime", address(leaping_clock_gettime)},
                            Hook{"gettimeofday", address(leaping_gettimeofday)}, Hook{"time", address(leaping_time)},
                            Hook{"clock", address(leaping_clock)}};
  hook(hooks);
}

void let_clocks_leap() {
  leap_ns = clock_leap_ns;
  hook_clocks();
}

void let_clocks_be_off(std::int64_t ns) {
  offset_ns = ns;
  hook_clocks();
}

void count_allocations(const CallGuard& guard) {
  counted_calls = &guard;
  const std::array hooks = {Hook{"malloc", address(counted_malloc)},
                            Hook{"calloc", address(counted_calloc)},
                            Hook{"realloc", address(counted_realloc)},
                            Hook{"aligned_alloc", address(counted_aligned_alloc)},
                            Hook{"posix_memalign", address(counted_posix_memalign)},
                            Hook{"free", address(counted_free)}};
  hook(hooks);
}

void fence_allocations(const CallGuard& guard) {
  fenced_calls = &guard;
  const std::array hooks = {Hook{"malloc", address(fenced_malloc)}, Hook{"calloc", address(fenced_calloc)},
                            Hook{"realloc", address(fenced_realloc)}, Hook{"free", address(fenced_free)}};
  hook(hooks);
}

void fill_new_memory(std::uint8_t byte) {
  filling = byte;
  const std::array hooks = {Hook{"malloc", address(filled_malloc)}};
  hook(hooks);
}

Allocations allocations() {
  return {allocated, allocated_bytes, kept_bytes};
}

}  // namespace dmrp::host
