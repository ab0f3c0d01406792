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
  NotedCall noted_call() const { return host::noted_call(*note_); }

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
