// SPDX-License-Identifier: MIT
// call_note.hpp: the plugin call that a child runs, in memory that it shares with its parent: a crash or a hang is
// reported with the plugin and the function. Plugins can overwrite this memory, so the parent checks what it reads.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>

#include "host/process/descriptor.hpp"

namespace dmrp::host {

struct CallNote {
  std::atomic<std::uint64_t> call_number;  // odd while a plugin function runs
  std::atomic<std::int64_t> start_ns;      // monotonic_ns()
  std::atomic<std::int64_t> limit_ns;      // a call that takes longer counts as hanging
  std::atomic<std::int64_t> step;
  std::atomic<std::int32_t> robot;
  std::atomic<std::int32_t> refused;  // the system call that the box refused, or 0
  std::array<char, 128> plugin;       // NUL-terminated
  std::array<char, 32> function;
};

// The contents of a call note. The texts are terminated; the numbers are unchecked.
struct NotedCall {
  bool inside = false;  // a plugin function was running; otherwise the other members are meaningless
  std::string plugin;
  std::string function;
  std::int64_t step = 0;
  std::int32_t robot = -1;
  std::int64_t start_ns = 0;
  std::int64_t limit_ns = 0;
  std::int32_t refused = 0;  // the system call that the box refused; 0: none
};

NotedCall read_call(const CallNote& note);

// Shared memory for one call note, all zero. Programs that are executed do not inherit it. Throws MachineError.
Descriptor make_call_note();

// A call note in shared memory, mapped while this object lives.
class SharedCallNote {
 public:
  // Closes the descriptor: nobody can then shorten the memory below the mapping. Throws MachineError.
  explicit SharedCallNote(Descriptor memory);
  ~SharedCallNote();
  SharedCallNote(const SharedCallNote&) = delete;
  SharedCallNote& operator=(const SharedCallNote&) = delete;

  CallNote& note() const { return *note_; }
  NotedCall read() const { return read_call(*note_); }

 private:
  CallNote* note_;
};

}  // namespace dmrp::host
