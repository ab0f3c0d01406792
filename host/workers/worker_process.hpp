// SPDX-License-Identifier: MIT
// worker_process.hpp: a worker as its supervisor sees it: the process, the channel, the shared call note.
#pragma once

#include <filesystem>

#include "host/process/call_note.hpp"
#include "host/process/child_process.hpp"
#include "host/process/line_channel.hpp"

namespace dmrp::host {

class WorkerProcess {
 public:
  // Starts `dmrp-host worker EXPERIMENT TRIALS ...`, whose output goes to the descriptor `log`. The destructor kills it.
  // Throws MachineError.
  WorkerProcess(const std::filesystem::path& experiment, std::uint32_t trials, int log);

  ChildProcess& process() { return process_; }
  LineChannel& channel() { return channel_; }
  NotedCall last_call() const { return note_.read(); }

 private:
  WorkerProcess(const std::filesystem::path& experiment, std::uint32_t trials, int log, Descriptor note, Pipe to_worker,
                Pipe from_worker);

  ChildProcess process_;
  SharedCallNote note_;
  LineChannel channel_;
};

}  // namespace dmrp::host
