// SPDX-License-Identifier: MIT
// messages.hpp: the messages between supervisor and worker.
//
//   supervisor -> {"libraries", "traces", "routes"}  the descriptors of plugins, by file; which traces are kept; routes of
//                                                    the people, by [[scenario]]
//   worker     -> {"type": "ready", "digest"}        of what the worker has read (loaded_digest())
//   supervisor -> Job                                one trial
//   worker     -> {"type": "began"}                  the worker begins it
//   worker     -> {"type": "planned"} + StoredPlan   the first plan of the trial, whose paths stand in Job::new_plan
//   worker     -> {"type": "metric"} + MetricResult  a piece of what a metric has given
//   worker     -> {"type": "fault"} + FaultRecord    a plugin broke its contract: the trial, or the metric, has ended
//   worker     -> {"type": "done"} + TrialDone       the trial is over
//   worker     -> {"type": "late_fault"} + FaultRecord  a plugin broke its contract after its last trial
//   worker     -> {"type": "error", "text", "machine", "number"}   the worker cannot continue. machine: the machine failed
//                                                    (the disk is full), with the value of errno; otherwise the input is
//                                                    at fault (a file is gone)
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/people/flow_routes.hpp"
#include "host/results/result_json.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

struct StoredPlan;  // stored_plan.hpp

struct Job {
  std::uint64_t trial = 0;
  std::string trace_file;    // in the worker's scratch folder; "" for none
  std::string scratch_file;  // where a large trace goes until it has been measured
  std::string plan{};        // name of its stored plan; "" for none
  std::string new_plan{};    // where the paths of its first plan go; "" if that is stored
};

// Calls `send` with the pieces of a result, in order: each side holds one as text at a time.
void send_in_pieces(const MetricResult& result, const std::function<void(const MetricResult& piece)>& send);

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
void to_json(nlohmann::json& json, const StoredPlan& plan);  // without paths
void from_json(const nlohmann::json& json, StoredPlan& plan);
nlohmann::json json_of(const core::FlowRoutes& routes);  // exact
core::FlowRoutes routes_in(const nlohmann::json& json);

}  // namespace dmrp::host
