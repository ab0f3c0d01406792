// SPDX-License-Identifier: MIT
// call_note.hpp: what a worker is doing, in memory that it shares with its supervisor: so that a crash or a hang has
// a name. A plugin can scribble here: the supervisor believes nothing that it has not checked.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>

namespace dmrp::host {

struct CallNote {
  std::atomic<std::uint64_t> call_number;  // odd while a plugin function runs
  std::atomic<std::int64_t> start_ns;      // CLOCK_MONOTONIC
  std::atomic<std::int64_t> limit_ns;      // how long the call may take before it counts as hanging
  std::atomic<std::int64_t> step;
  std::atomic<std::int32_t> robot;
  std::array<char, 128> plugin;  // NUL-terminated
  std::array<char, 32> function;
};

// What a call note said. Its texts end; its numbers may still be anything.
struct NotedCall {
  bool inside = false;  // a plugin function was running; else the rest means nothing
  std::string plugin;
  std::string function;
  std::int64_t step = 0;
  std::int32_t robot = -1;
  std::int64_t start_ns = 0;
  std::int64_t limit_ns = 0;
};

NotedCall noted_call(const CallNote& note);

}  // namespace dmrp::host
