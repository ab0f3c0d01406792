// SPDX-License-Identifier: MIT
// run_cost.hpp: how long a run will take, and how large it will be, from its first trials.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/experiment/experiment.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

// One wants to know it before a run with at least this many trials.
inline constexpr std::uint64_t fewest_trials_with_cost = 20;

class RunCost {
 public:
  // `trials`: of the run; `directory`: where it keeps their traces.
  RunCost(const Experiment& experiment, std::uint64_t trials, unsigned jobs, std::filesystem::path directory);

  // A trial that has ended, after its trace has been stored.
  void add(const TrialRecord& trial);

  // Whether a trial of each combination has ended, or one has and five seconds have passed, or twenty.
  bool is_known() const;

  // "about 6 min, 1.0 GB"; "probably more than 3 h" if no trial has ended.
  std::string words() const;

 private:
  double wall_s() const;
  double bytes() const;

  const Experiment& experiment_;
  std::vector<Combination> combinations_;
  double trials_;
  double jobs_;
  std::filesystem::path directory_;
  std::int64_t start_ns_;
  std::vector<double> wall_s_;  // by combination, of its last trial; 0: none has ended
  double ended_ = 0.0;
  double failed_ = 0.0;
  double result_bytes_ = 0.0;
  double traces_ = 0.0;
  double trace_bytes_ = 0.0;
};

// RunCost::words() of a run that has not begun, from trials in a temporary folder, as long as it takes to know it; "" if
// it has too few trials. nullopt if a signal came. Throws as supervise().
std::optional<std::string> sampled_cost(const Experiment& experiment, unsigned jobs);

}  // namespace dmrp::host
