// SPDX-License-Identifier: MIT
// bench_controllers_trial.hpp: drives a trial in closed loop and records the input of every controller; replays it to
// fresh instances, of this or another controller, call by call.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "host/experiment/experiment.hpp"
#include "host/world/variant_world.hpp"
#include "tests/bench/bench_controllers_tape.hpp"
#include "tests/support/instance_pool.hpp"

namespace dmrp::bench {

// A trial of the experiment's first combination.
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

// Sensors, people and contacts between robots as in the host. `all_sensors`: records what the controller does not read,
// too. Throws std::runtime_error if there is no plan.
RecordedTrial record(const TrialUnderTest& trial, host::InstancePool& pool, bool all_sensors = false);

// The answers to the calls of one tape, and their measurements.
struct Replay {
  std::vector<std::optional<dmrp_command>> commands;  // empty: no command
  std::vector<double> call_ms;                        // processor time
  std::vector<std::uint64_t> allocations;
  std::vector<double> iterations;  // of the calls that annotated them; only if `listens`
};

// Replays a tape to a fresh instance of the experiment's `controller`, 0 being the one that was recorded, for one robot.
// Throws std::runtime_error if that one answers otherwise than recorded.
Replay replay(const TrialUnderTest& trial, host::InstancePool& pool, std::uint32_t robot, const Tape& tape,
              bool listens, std::size_t controller = 0);

}  // namespace dmrp::bench
