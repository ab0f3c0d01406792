// SPDX-License-Identifier: MIT
// worker_process.hpp: a worker as its supervisor sees it: the process, the channel, the log.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "host/experiment/experiment.hpp"
#include "host/process/child_process.hpp"
#include "host/process/descriptor.hpp"
#include "host/process/line_channel.hpp"

namespace dmrp::host {

// What a worker prints goes through a pipe into log.txt, up to a limit: a plugin cannot fill the disk.
class CappedLog {
 public:
  static constexpr std::size_t most_bytes = 16u << 20;  // of one worker

  explicit CappedLog(Descriptor read_end);

  // To wait for; -1 once the worker has closed its end.
  int read_end() const { return read_end_.number(); }

  // Copies the whole lines that are there to `log`, without waiting. False when there is nothing.
  bool copy(const Descriptor& log);

  // The same for all that an ended worker has left.
  void copy_rest(const Descriptor& log);

 private:
  void write(std::string_view text, const Descriptor& log);

  Descriptor read_end_;
  std::string line_;  // that has no end yet
  std::size_t written_ = 0;
};

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
