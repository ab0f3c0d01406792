// SPDX-License-Identifier: MIT
// bench_controllers_trial.hpp: drives a trial in closed loop and records the input of every controller; replays it to
// fresh instances call by call.
#pragma once

#include <cstdint>
#include <vector>

#include "host/experiment/experiment.hpp"
#include "host/world/variant_world.hpp"
#include "tests/bench/bench_controllers_tape.hpp"
#include "tests/support/instance_pool.hpp"

namespace dmrp::bench {

// A trial of the experiment's only combination.
struct TrialUnderTest {
  const host::Experiment& experiment;
  const host::VariantWorld& variant;
  std::uint64_t seed = 0;
};

struct RecordedTrial {
  std::vector<Tape> tapes;  // by robot
  std::uint32_t arrived = 0;
  double sim_time_s = 0.0;
};

// Sensors, people and contacts between robots as in the host. Throws std::runtime_error if there is no plan.
RecordedTrial record(const TrialUnderTest& trial, host::InstancePool& pool);

// The measurements of the calls of one tape.
struct Replay {
  std::vector<double> call_ms;  // processor time
  std::vector<std::uint64_t> allocations;
  std::vector<double> iterations;  // of the calls that annotated them; only if `listens`
};

// Replays a tape to a fresh instance for one robot. Throws std::runtime_error if a command differs from the recorded
// one.
Replay replay(const TrialUnderTest& trial, host::InstancePool& pool, std::uint32_t robot, const Tape& tape,
              bool listens);

}  // namespace dmrp::bench
