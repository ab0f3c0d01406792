// SPDX-License-Identifier: MIT
// What a guest may do with the memory that its judge shares with it.
#include "host/guests/exchange/guest_memory.hpp"

#include <sys/mman.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <stdexcept>
#include <thread>

namespace guest_memory_test {

using namespace dmrp::host;

constexpr std::size_t page_bytes = 4096;

int map_error(int descriptor, int protection) {
  void* const mapped = mmap(nullptr, page_bytes, protection, MAP_SHARED, descriptor, 0);
  if (mapped == MAP_FAILED) return errno;
  munmap(mapped, page_bytes);
  return 0;
}

TEST_CASE("nobody but the judge can write to the judge's part") {
  const GuestMemory memory;
  const GuestMemory::Place place = memory.place();
  CHECK(map_error(place.judge_descriptor, PROT_READ) == 0);
  CHECK(map_error(place.judge_descriptor, PROT_READ | PROT_WRITE) == EPERM);
  CHECK(map_error(place.guest_descriptor, PROT_READ | PROT_WRITE) == 0);
  void* const shown = mmap(nullptr, page_bytes, PROT_READ, MAP_SHARED, place.judge_descriptor, 0);
  REQUIRE(shown != MAP_FAILED);
  CHECK(mprotect(shown, page_bytes, PROT_READ | PROT_WRITE) != 0);
  memory.judge().turn = 7;
  CHECK(static_cast<const JudgePage*>(shown)->turn == 7);
  munmap(shown, page_bytes);
}

TEST_CASE("a guest whose addresses are taken says so") {
  const GuestMemory memory;
  GuestMemory::Place place = memory.place();
  place.judge_descriptor = place.guest_descriptor = -1;
  CHECK_THROWS_AS(GuestMemory(place), std::runtime_error);
}

TEST_CASE("the parts of the memory do not overlap") {
  const GuestMemory memory;
  auto* const sent = memory.judge_arena().make<char>();
  auto* const answer = memory.output_arena().make<char>();
  CHECK(memory.is_read_only(&memory.judge()));
  CHECK(memory.is_read_only(sent));
  CHECK_FALSE(memory.is_read_only(answer));
  CHECK_FALSE(memory.is_read_only(&memory.guest()));
  CHECK(answer + memory.output_arena().room() <= memory.text());
  CHECK(reinterpret_cast<char*>(memory.annotations()) == memory.text() + memory.text_room());
}

TEST_CASE("a side waits until it is its turn") {
  const GuestMemory memory;
  std::atomic<std::uint32_t>& turn = memory.guest().turn;
  CHECK_FALSE(GuestMemory::wait(turn, 0, std::chrono::milliseconds(1)));
  std::thread other([&] { GuestMemory::give(turn, 1); });
  while (!GuestMemory::wait(turn, 0, std::chrono::milliseconds(100))) {
  }
  other.join();
  CHECK(turn == 1);
}

}  // namespace guest_memory_test
