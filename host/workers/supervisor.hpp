// SPDX-License-Identifier: MIT
// supervisor.hpp: runs trials in worker processes. One poll loop, no threads; loads no plugin.
//
// Each job has one worker, which runs many trials under resource limits. If a worker dies, hangs or sends a message that
// its state does not allow, another worker takes its place. Workers write in scratch folders; this process alone puts
// traces into the run directory, each before its trial is reported. A trial that was killed from outside, or whose
// worker had run other trials before, is run again by a fresh worker; otherwise it ends as a fault.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "host/experiment/experiment.hpp"
#include "host/results/trial_record.hpp"
#include "host/workers/planned_trials.hpp"

namespace dmrp::host {

struct SupervisorSettings {
  unsigned jobs = 1;
  std::filesystem::path run_directory;  // traces/ and log.txt go there
  std::uint64_t trial_count = 0;        // of the whole experiment; the commands that rerun one trial need it
};

struct SupervisorSinks {
  std::function<void(TrialRecord&&)> on_trial;  // as each ends, in no fixed order
  // Of a trial that has ended already: destroy() and deinit() are called later.
  std::function<void(std::uint64_t trial, const FaultRecord&)> on_late_fault;
  std::function<void(const std::string&)> on_warning;
  std::function<bool()> goes_on;  // asked every 100 ms or more often; false: the run ends as by a signal
};

enum class RunEnding { done, interrupted };

// Runs these trials. Throws InputError if the experiment's files change during the run, and MachineError.
RunEnding supervise(const Experiment& experiment, PlannedTrials trials, const SupervisorSettings& settings,
                    const SupervisorSinks& sinks);

}  // namespace dmrp::host
