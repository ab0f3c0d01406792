// SPDX-License-Identifier: MIT
// worker_process.hpp: a worker as its supervisor sees it: the process, the channel, the shared call note.
#pragma once

#include <filesystem>

#include "host/experiment/experiment.hpp"
#include "host/process/call_note.hpp"
#include "host/process/child_process.hpp"
#include "host/process/line_channel.hpp"
#include "host/workers/capped_log.hpp"

namespace dmrp::host {

class WorkerProcess {
 public:
  // Starts `dmrp-host worker EXPERIMENT TRIALS ...`, which writes in this folder alone. The destructor kills it. Throws
  // MachineError.
  WorkerProcess(const Experiment& experiment, const std::filesystem::path& scratch);

  ChildProcess& process() { return process_; }
  LineChannel& channel() { return channel_; }
  CappedLog& log() { return log_; }
  NotedCall last_call() const { return note_.read(); }

 private:
  WorkerProcess(const Experiment& experiment, const std::filesystem::path& scratch, Descriptor note, Pipe to_worker,
                Pipe from_worker, Pipe output);

  ChildProcess process_;
  SharedCallNote note_;
  LineChannel channel_;
  CappedLog log_;
};

}  // namespace dmrp::host
