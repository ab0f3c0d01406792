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

// What a call note said, checked: texts end, numbers are possible.
struct NotedCall {
  std::uint64_t call_number = 0;
  bool inside = false;  // a plugin function was running
  std::string plugin;
  std::string function;
  std::int64_t step = 0;
  std::int32_t robot = -1;
  std::int64_t start_ns = 0;
  std::int64_t limit_ns = 0;
};

class WorkerProcess {
 public:
  // Starts `dmrp-host worker EXPERIMENT TRIALS ...`; its output goes to the descriptor `log`.
  WorkerProcess(const std::filesystem::path& experiment, std::uint32_t trials, int log);
  ~WorkerProcess();  // kills it
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  LineChannel& channel() { return *channel_; }
  NotedCall noted_call() const;

  void kill();
  // Waits for its end; the status as waitpid() gives it.
  int wait();

 private:
  pid_t pid_ = -1;
  int pid_descriptor_ = -1;
  CallNote* note_ = nullptr;
  std::unique_ptr<LineChannel> channel_;
};

// The worker's side: the call note behind a descriptor that it inherited.
CallNote& map_call_note(int descriptor);

}  // namespace dmrp::host
