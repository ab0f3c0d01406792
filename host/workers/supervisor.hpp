// SPDX-License-Identifier: MIT
// supervisor.hpp: runs trials in worker processes. One poll loop, no threads; loads no plugin.
//
// Each job has one worker, which runs many trials under resource limits. If a worker dies, hangs or sends an invalid
// message, its trial ends as a fault and another worker takes its place.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "host/experiment/experiment.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

struct SupervisorSettings {
  unsigned jobs = 1;
  std::filesystem::path run_directory;  // traces/ and log.txt go there
  std::uint64_t trial_count = 0;        // of the whole experiment; the commands that rerun one trial need it
};

enum class RunEnding { done, interrupted };

// Runs the trials with these numbers. Calls `on_trial` as each ends, in no fixed order, and `on_idle` every 100 ms or
// more often. Throws InputError if the experiment's files change during the run, and MachineError.
RunEnding supervise(const Experiment& experiment, const std::vector<std::uint64_t>& trials,
                    const SupervisorSettings& settings, const std::function<void(TrialRecord&&)>& on_trial,
                    const std::function<void()>& on_idle);

// The record of a trial that has not run: its place in the experiment.
TrialRecord blank_record(const Experiment& experiment, std::uint64_t trial);

}  // namespace dmrp::host
