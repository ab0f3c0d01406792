// SPDX-License-Identifier: MIT
// messages.hpp: the messages between supervisor and worker.
//
//   worker     -> {"type": "ready", "digest"}        of what the worker has read (loaded_digest())
//   supervisor -> Job                                one trial
//   worker     -> {"type": "began"}                  the worker begins it
//   worker     -> {"type": "planned"} + StoredPlan   the first plan of the trial, whose paths stand in Job::new_plan
//   worker     -> {"type": "measuring", "index"}     a metric begins
//   worker     -> {"type": "metric", "last"} + MetricResult  a piece of what a metric has given; with the last, the
//                                                    metric has finished
//   worker     -> {"type": "fault", "fatal"} + FaultRecord   a plugin broke its contract. The worker continues unless the
//                                                    fault is fatal: no function of the library may be called again
//   worker     -> {"type": "done"} + TrialDone       the trial is over
//   worker     -> {"type": "error", "text", "machine", "number"}   the worker cannot continue. machine: the machine failed
//                                                    (the disk is full), with the value of errno; otherwise the input is
//                                                    at fault (a file is gone)
//
// Messages about a trial carry "trial" and "stamp" of its job. Copies of the worker that a plugin makes do not know the
// stamp.
//
// A worker whose plugin crashes sends nothing: the supervisor reads the plugin and the function from the call note.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/results/trial_record.hpp"

namespace dmrp::host {

// A worker sent what its state does not allow: a plugin wrote into the channel, or copied the process.
class UnbelievableMessage : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct StoredPlan;  // stored_plan.hpp

struct Job {
  std::uint64_t trial = 0;
  std::uint64_t stamp = 0;                  // another one for each attempt, not 0
  std::string trace_file;                   // in the worker's scratch folder; "" for none
  std::string scratch_file;                 // where a large trace goes until it has been measured
  std::vector<std::uint32_t> skip_metrics;  // ended in a fault in an earlier attempt
  std::string plan{};                       // name of its stored plan; "" for none
  std::string new_plan{};                   // where the paths of its first plan go; "" if that is stored
};

// Calls `send` with the pieces of a result, in order: each side holds one as text at a time.
void send_in_pieces(const MetricResult& result, const std::function<void(const MetricResult& piece, bool last)>& send);

// The result of a trial, without the values of its metrics.
struct TrialDone {
  std::string outcome;
  std::vector<TimingReason> timing;  // none: repeatable
  double sim_time_s = 0.0;
  std::string task;  // TrialRecord::task
};

void to_json(nlohmann::json& json, const Job& job);
void from_json(const nlohmann::json& json, Job& job);
void to_json(nlohmann::json& json, const TrialDone& done);
void from_json(const nlohmann::json& json, TrialDone& done);
void to_json(nlohmann::json& json, const MetricResult& result);
void from_json(const nlohmann::json& json, MetricResult& result);
void to_json(nlohmann::json& json, const StoredPlan& plan);  // without paths
void from_json(const nlohmann::json& json, StoredPlan& plan);
void to_json(nlohmann::json& json, const FaultRecord& fault);
void from_json(const nlohmann::json& json, FaultRecord& fault);

}  // namespace dmrp::host
