// SPDX-License-Identifier: MIT
#include "host/plugins/call_note.hpp"

#include <cstring>

namespace dmrp::host {

namespace {

template <std::size_t n>
std::string text_of(const std::array<char, n>& text) {
  return std::string(text.data(), strnlen(text.data(), n));
}

}  // namespace

NotedCall noted_call(const CallNote& note) {
  NotedCall call;
  const std::uint64_t number = note.call_number.load(std::memory_order_acquire);
  call.plugin = text_of(note.plugin);
  call.function = text_of(note.function);
  call.step = note.step.load(std::memory_order_relaxed);
  call.robot = note.robot.load(std::memory_order_relaxed);
  call.start_ns = note.start_ns.load(std::memory_order_relaxed);
  call.limit_ns = note.limit_ns.load(std::memory_order_relaxed);
  // a note that changed while it was read mixes two calls: the one that was looked for has returned
  std::atomic_thread_fence(std::memory_order_acquire);
  call.inside = number % 2 == 1 && note.call_number.load(std::memory_order_relaxed) == number;
  return call;
}

}  // namespace dmrp::host
