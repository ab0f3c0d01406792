// SPDX-License-Identifier: MIT
// worker.hpp: the worker process: loads the plugins and runs trials until its supervisor closes the channel.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "host/process/resource_limits.hpp"

namespace dmrp::host {

struct WorkerTask {
  std::filesystem::path experiment;
  std::uint32_t trials = 0;  // repetitions, as in load_experiment()
  ProcessLimits limits;
  std::filesystem::path scratch;  // where it writes its files
  int read_end = -1;              // of the channel
  int write_end = -1;
  int note = -1;                                  // the shared call note
  std::vector<std::filesystem::path> unloadable;  // libraries that the supervisor has left out
};

// Returns the exit status.
int run_worker(const WorkerTask& task);

}  // namespace dmrp::host
