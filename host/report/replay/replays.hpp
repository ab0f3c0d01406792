// SPDX-License-Identifier: MIT
// replays.hpp: the replays that a report carries.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/results/trial_record.hpp"

namespace dmrp::host {

struct ReplayPolicy {
  std::vector<std::string> rank_by;       // metrics: the first that is defined in a combination ranks its trials
  std::size_t budget_bytes = 12'000'000;  // of all replays together, as they stand in the page
  std::vector<std::uint64_t> asked = {};  // ids of trials to take whatever they are like
};

struct Replay {
  std::uint64_t trial = 0;       // id
  std::vector<std::string> why;  // "asked", "median", "worst", "fault", "failure"
  std::string packed;            // replay_json() by gzip, in base64
};

struct ReplaysLeftOut {
  std::string why;  // they were wished for
  std::uint64_t trials = 0;
  std::string reason;  // for people
};

struct Replays {
  std::vector<Replay> replays;           // by id
  std::vector<ReplaysLeftOut> left_out;  // most wanted first
};

// From RUN_DIRECTORY/traces/trial_000000.mcap and so on. A trial whose trace is missing or damaged, and what does not
// fit into the budget, is left out and counted. `trials` are ordered by id.
Replays choose_and_encode_replays(const std::filesystem::path& run_directory, std::span<const TrialRecord> trials,
                                  std::span<const MetricColumn> metrics, const ReplayPolicy& policy);

}  // namespace dmrp::host
