// SPDX-License-Identifier: MIT
// run_trial.hpp: one trial, from the plan to the end, written down in a trace.
#pragma once

#include <cstdint>

#include "core/trace/trace_encoder.hpp"
#include "host/experiment/experiment.hpp"
#include "host/trial/instance_pool.hpp"
#include "host/trial/variant_world.hpp"

namespace dmrp::host {

struct Trial {
  const Experiment& experiment;
  const Combination& combination;
  const VariantWorld& variant;
  std::uint64_t seed;
};

struct TrialEnding {
  bool succeeded = false;
  double sim_time_s = 0.0;
};

// Runs it. The trace has the world's record already. Throws PluginFault; the trace then ends where it happened.
TrialEnding run_trial(const Trial& trial, InstancePool& pool, core::TraceEncoder& trace);

}  // namespace dmrp::host
