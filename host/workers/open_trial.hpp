// SPDX-License-Identifier: MIT
// open_trial.hpp: a trial that is not over: what its worker has said so far, and how often it was begun.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/experiment/experiment.hpp"
#include "host/results/trial_record.hpp"
#include "host/workers/messages.hpp"

namespace dmrp::host {

// The record of a trial that has not run: its place in the experiment.
TrialRecord row_of(const Experiment& experiment, std::uint64_t trial);

class OpenTrial {
 public:
  explicit OpenTrial(TrialRecord blank) : record_(std::move(blank)) {}

  // Begins an attempt: the job for a worker, without its files.
  Job begin();

  // Takes a message of the worker; true: the trial is over. Throws nlohmann::json::exception.
  bool take(const nlohmann::json& message);

  // The worker has begun this attempt.
  bool has_begun() const { return begun_; }

  // Ends with its worker.
  void end_by(FaultRecord fault);

  // Ends before it begins, by the fault of the planner in another trial of the same plan.
  void end_without_plan(StoredPlan stored);

  // Forgets this attempt.
  void restart();

  const TrialRecord& record() const { return record_; }
  TrialRecord take_record() { return std::move(record_); }

  std::int64_t started_ns = 0;  // of this attempt
  bool worker_failed = false;   // an attempt ended because its worker could not continue
  int killed = 0;               // so many attempts were killed from outside

 private:
  void add_fault(FaultRecord fault);
  void add_timing(const std::vector<TimingReason>& reasons);

  TrialRecord record_;
  bool begun_ = false;
};

}  // namespace dmrp::host
