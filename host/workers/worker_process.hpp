// SPDX-License-Identifier: MIT
// worker_process.hpp: one worker as its supervisor holds it: the process, the channel, the shared call note.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "host/plugins/call_note.hpp"
#include "host/workers/line_channel.hpp"

namespace dmrp::host {

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

class WorkerProcess {
 public:
  // Starts `dmrp-host worker EXPERIMENT TRIALS ...`; its output goes to the descriptor `log`. It inherits no other
  // descriptor but its channel and its note, and outlives neither the supervisor nor this object. Throws
  // std::system_error.
  WorkerProcess(const std::filesystem::path& experiment, std::uint32_t trials, int log);
  ~WorkerProcess();  // kills it
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  LineChannel& channel() { return *channel_; }
  NotedCall noted_call() const;

  void kill();
  // Whether it is over by itself, now or in the next `wait_ms`.
  bool ends_within(int wait_ms) const;
  // Waits for its end; the status as waitpid() gives it.
  int wait();

 private:
  pid_t pid_ = -1;
  int pid_descriptor_ = -1;
  CallNote* note_ = nullptr;
  std::unique_ptr<LineChannel> channel_;
};

// Maps the call note behind a descriptor, for as long as the process lives, and closes the descriptor.
// Throws std::system_error.
CallNote& map_call_note(int descriptor);

}  // namespace dmrp::host
