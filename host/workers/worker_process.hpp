// SPDX-License-Identifier: MIT
// worker_process.hpp: a worker as its supervisor sees it: the process, the channel, the log.
#pragma once

#include <filesystem>

#include "host/experiment/experiment.hpp"
#include "host/process/child_process.hpp"
#include "host/process/line_channel.hpp"
#include "host/workers/capped_log.hpp"

namespace dmrp::host {

// One of the workers that run at the same time.
struct JobPlace {
  unsigned jobs;       // all of them
  unsigned processor;  // where this one runs, if it may
};

class WorkerProcess {
 public:
  // Starts `dmrp-host worker EXPERIMENT TRIALS ...` It and its guests write in this folder. The destructor kills it. Throws
  // MachineError.
  WorkerProcess(const Experiment& experiment, const std::filesystem::path& scratch, JobPlace place);

  ChildProcess& process() { return process_; }
  LineChannel& channel() { return channel_; }
  CappedLog& log() { return log_; }

 private:
  WorkerProcess(const Experiment& experiment, const std::filesystem::path& scratch, JobPlace place, Pipe to_worker,
                Pipe from_worker, Pipe output);

  ChildProcess process_;
  LineChannel channel_;
  CappedLog log_;
};

}  // namespace dmrp::host
