// SPDX-License-Identifier: MIT
// run_trial.hpp: simulates one trial and records it in a trace.
#pragma once

#include <cstdint>

#include "core/trace/trace_encoder.hpp"
#include "host/experiment/experiment.hpp"
#include "host/guests/guests.hpp"
#include "host/trial/trial_plugins.hpp"
#include "host/world/variant_world.hpp"

namespace dmrp::host {

// A given first plan takes the planner's place where nothing can replan.
struct Trial {
  const Experiment& experiment;
  const Combination& combination;
  const VariantWorld& variant;
  std::uint64_t seed;
  FirstPlan first_plan{};
};

struct TrialEnding {
  bool succeeded = false;
  double sim_time_s = 0.0;
};

// The trace has the world's record already. Throws PluginFault; the trace then ends at the fault.
TrialEnding run_trial(const Trial& trial, Guests& guests, core::TraceEncoder& trace);

// For the trace's end: a DMRP_ENDING_* as text.
const char* ending_text(std::uint32_t ending);

}  // namespace dmrp::host
