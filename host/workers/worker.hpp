// SPDX-License-Identifier: MIT
// worker.hpp: the worker process, the judge of its trials: it loads no plugin, but asks guests (host/guests). It runs trials
// until its supervisor closes the channel.
#pragma once

#include <cstdint>
#include <filesystem>

namespace dmrp::host {

struct WorkerTask {
  std::filesystem::path experiment;
  std::uint32_t trials = 0;       // repetitions, as in load_experiment()
  unsigned jobs = 1;              // workers that run at the same time
  unsigned processor = 0;         // where it runs, if it may
  std::filesystem::path scratch;  // where it and its guests write their files
  int read_end = -1;              // of the channel
  int write_end = -1;
};

// Returns the exit status.
int run_worker(const WorkerTask& task);

}  // namespace dmrp::host
