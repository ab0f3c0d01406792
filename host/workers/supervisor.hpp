// SPDX-License-Identifier: MIT
// supervisor.hpp: runs trials in worker processes. One poll loop, no threads; loads no plugin.
//
// Workers are persistent: fork+exec'ed, one a job, under resource limits. A worker that dies, hangs or babbles costs
// its trial a fault and is replaced; the run goes on.
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
  std::uint64_t trial_count = 0;        // of the whole experiment, for the commands that rerun one trial
};

enum class RunEnding { done, interrupted };

// Runs the trials of the given numbers; `on_trial` gets each as it is over, in no fixed order, on the caller's thread.
// Throws InputError when the experiment's files change under way.
RunEnding supervise(const Experiment& experiment, const std::vector<std::uint64_t>& trials,
                    const SupervisorSettings& settings, const std::function<void(TrialRecord&&)>& on_trial,
                    const std::function<void()>& on_idle);

// The record of a trial before anything is known of it: its place in the experiment.
TrialRecord blank_record(const Experiment& experiment, std::uint64_t trial);

}  // namespace dmrp::host
