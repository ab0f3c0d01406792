// SPDX-License-Identifier: MIT
#include "host/process/call_note.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "host/errors/machine_error.hpp"

namespace dmrp::host {

namespace {

template <std::size_t n>
std::string text_of(const std::array<char, n>& text) {
  return std::string(text.data(), strnlen(text.data(), n));
}

}  // namespace

NotedCall read_call(const CallNote& note) {
  NotedCall call;
  const std::uint64_t number = note.call_number.load(std::memory_order_acquire);
  call.plugin = text_of(note.plugin);
  call.function = text_of(note.function);
  call.step = note.step.load(std::memory_order_relaxed);
  call.robot = note.robot.load(std::memory_order_relaxed);
  call.start_ns = note.start_ns.load(std::memory_order_relaxed);
  call.refused = note.refused.load(std::memory_order_relaxed);
  call.limit_ns = note.limit_ns.load(std::memory_order_relaxed);
  // a note that changed while it was read mixes two calls: the first of them has returned
  std::atomic_thread_fence(std::memory_order_acquire);
  call.inside = number % 2 == 1 && note.call_number.load(std::memory_order_relaxed) == number;
  return call;
}

Descriptor make_call_note() {
  Descriptor memory(memfd_create("dmrp-call-note", MFD_CLOEXEC));
  if (!memory.is_open() || ftruncate(memory.number(), sizeof(CallNote)) != 0) throw MachineError("memfd_create", errno);
  return memory;
}

SharedCallNote::SharedCallNote(Descriptor memory) {
  void* const mapped = mmap(nullptr, sizeof(CallNote), PROT_READ | PROT_WRITE, MAP_SHARED, memory.number(), 0);
  if (mapped == MAP_FAILED) throw MachineError("mmap", errno);
  note_ = static_cast<CallNote*>(mapped);
}

SharedCallNote::~SharedCallNote() {
  munmap(note_, sizeof(CallNote));
}

}  // namespace dmrp::host
