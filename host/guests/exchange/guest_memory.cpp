// SPDX-License-Identifier: MIT
#include "host/guests/exchange/guest_memory.hpp"

#include <fcntl.h>
#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <stdexcept>

#include "host/errors/machine_error.hpp"

namespace dmrp::host {

namespace {

constexpr std::size_t page_bytes = 4096;  // for what stands at the beginning of a part
static_assert(sizeof(JudgePage) <= page_bytes && sizeof(GuestPage) <= page_bytes);

// It reserves addresses: pages that nobody writes to take no memory.
constexpr std::size_t most_part_bytes = std::size_t{1} << 30;
constexpr std::size_t most_guests = 16;  // that share a limit of the address space

std::size_t limit(__rlimit_resource resource) {
  rlimit found{};
  getrlimit(resource, &found);
  return found.rlim_cur == RLIM_INFINITY ? most_part_bytes * 2 * most_guests : found.rlim_cur;
}

Descriptor make_part(const char* name, std::size_t bytes) {
  Descriptor part(memfd_create(name, MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (!part.is_open() || ftruncate(part.number(), static_cast<off_t>(bytes)) != 0)
    throw MachineError("memfd_create", errno);
  return part;
}

void map_part(const Descriptor& part, void* at, std::size_t bytes, int protection) {
  if (mmap(at, bytes, protection, MAP_SHARED | MAP_FIXED, part.number(), 0) == MAP_FAILED)
    throw MachineError("mmap", errno);
}

void seal(const Descriptor& part, int seals) {
  if (fcntl(part.number(), F_ADD_SEALS, seals | F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) != 0)
    throw MachineError("F_ADD_SEALS", errno);
}

std::size_t bytes_of(const Descriptor& part) {
  struct stat found {};
  return fstat(part.number(), &found) == 0 ? static_cast<std::size_t>(found.st_blocks) * 512 : 0;
}

long futex(const std::atomic<std::uint32_t>& word, int operation, std::uint32_t value, const timespec* longest) {
  return syscall(SYS_futex, &word, operation, value, longest, nullptr, 0);
}

}  // namespace

std::size_t GuestMemory::part_bytes() {
  const std::size_t bytes = std::min({most_part_bytes, limit(RLIMIT_FSIZE), limit(RLIMIT_AS) / (2 * most_guests)});
  return std::max(bytes / page_bytes, std::size_t{16}) * page_bytes;
}

GuestMemory::GuestMemory()
    : judge_part_(make_part("dmrp-judge", part_bytes())),
      guest_part_(make_part("dmrp-guest", part_bytes())),
      part_bytes_(part_bytes()) {
  memory_ = mmap(nullptr, 2 * part_bytes_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory_ == MAP_FAILED) throw MachineError("mmap", errno);
  map_part(judge_part_, memory_, part_bytes_, PROT_READ | PROT_WRITE);
  map_part(guest_part_, &guest(), part_bytes_, PROT_READ | PROT_WRITE);
  // from now on nobody else can map it to write: not even by mprotect()
  seal(judge_part_, F_SEAL_FUTURE_WRITE);
  seal(guest_part_, 0);
}

GuestMemory::Place GuestMemory::place() const {
  return {judge_part_.number(), guest_part_.number(), reinterpret_cast<std::uintptr_t>(memory_), part_bytes_};
}

GuestMemory::GuestMemory(const Place& place)
    : judge_part_(place.judge_descriptor), guest_part_(place.guest_descriptor), part_bytes_(place.part_bytes) {
  void* const wanted = reinterpret_cast<void*>(place.address);
  memory_ = mmap(wanted, 2 * part_bytes_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_FIXED_NOREPLACE,
                 -1, 0);
  if (memory_ != wanted) throw std::runtime_error("the addresses of the judge are taken");
  map_part(judge_part_, memory_, part_bytes_, PROT_READ);
  map_part(guest_part_, &guest(), part_bytes_, PROT_READ | PROT_WRITE);
  judge_part_.close();
  guest_part_.close();
}

GuestMemory::~GuestMemory() {
  munmap(memory_, 2 * part_bytes_);
}

GuestPage& GuestMemory::guest() const {
  return *reinterpret_cast<GuestPage*>(static_cast<std::byte*>(memory_) + part_bytes_);
}

Arena GuestMemory::judge_arena() const {
  return Arena(static_cast<std::byte*>(memory_) + page_bytes, part_bytes_ - page_bytes);
}

Arena GuestMemory::output_arena() const {
  return Arena(reinterpret_cast<std::byte*>(&guest()) + page_bytes, part_bytes_ / 2 - page_bytes);
}

char* GuestMemory::text() const {
  return reinterpret_cast<char*>(&guest()) + part_bytes_ / 2;
}

std::uint8_t* GuestMemory::annotations() const {
  return reinterpret_cast<std::uint8_t*>(text() + text_room());
}

bool GuestMemory::is_read_only(const void* address) const {
  const auto* const first = static_cast<const std::byte*>(memory_);
  return address >= first && address < first + part_bytes_;
}

std::size_t GuestMemory::bytes_in_use() const {
  return bytes_of(judge_part_) + bytes_of(guest_part_);
}

bool GuestMemory::wait(const std::atomic<std::uint32_t>& turn, std::uint32_t seen, std::chrono::milliseconds longest) {
  const timespec time = {longest.count() / 1000, longest.count() % 1000 * 1'000'000};
  while (turn.load(std::memory_order_acquire) == seen)
    if (futex(turn, FUTEX_WAIT, seen, longest.count() > 0 ? &time : nullptr) != 0 && errno != EAGAIN)
      return turn.load(std::memory_order_acquire) != seen;
  return true;
}

void GuestMemory::give(std::atomic<std::uint32_t>& turn, std::uint32_t value) {
  turn.store(value, std::memory_order_release);
  futex(turn, FUTEX_WAKE, 1, nullptr);
}

}  // namespace dmrp::host
