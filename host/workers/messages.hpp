// SPDX-License-Identifier: MIT
// messages.hpp: what supervisor and worker say to each other.
//
//   worker  -> {"type": "ready", "digest"}           the experiment as it reads it
//   supervisor -> Job                                one trial
//   worker  -> {"type": "measuring", "index"}        as each metric begins
//   worker  -> {"type": "metric"} + MetricResult     as each metric finishes
//   worker  -> {"type": "fault", "fatal"} + FaultRecord   a plugin broke its contract; the worker goes on unless the
//                                                    fault is fatal: the library is unusable, another worker must
//   worker  -> {"type": "done"} + TrialDone          the trial is over
//   worker  -> {"type": "error", "text"}             the run cannot go on: a file is gone, the disk is full
//
// A worker that cannot go on just dies: the supervisor knows from the call note where.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "host/results/trial_record.hpp"

namespace dmrp::host {

// Exit status of a worker that ran out of memory outside a plugin call.
inline constexpr int out_of_memory_exit = 86;

struct Job {
  std::uint64_t trial = 0;
  std::string trace_file;    // "" for none
  std::string scratch_file;  // where a large trace goes until it has been measured
  bool keep_trace_of_success = true;
  std::vector<std::uint32_t> skip_metrics;  // that killed a worker before, or were measured before another one did
  std::vector<MetricEvent> known_events;    // that these gave, for the trace
};

// The end of a trial, without its values.
struct TrialDone {
  std::string outcome;
  bool repeatable = true;
  double sim_time_s = 0.0;
};

void to_json(nlohmann::json& json, const Job& job);
void from_json(const nlohmann::json& json, Job& job);
void to_json(nlohmann::json& json, const TrialDone& done);
void from_json(const nlohmann::json& json, TrialDone& done);
void to_json(nlohmann::json& json, const MetricResult& result);
void from_json(const nlohmann::json& json, MetricResult& result);
void to_json(nlohmann::json& json, const FaultRecord& fault);
void from_json(const nlohmann::json& json, FaultRecord& fault);

}  // namespace dmrp::host
