// SPDX-License-Identifier: MIT
// replays.hpp: selects and encodes the replays of a report.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "host/results/trial_record.hpp"

namespace dmrp::host {

struct ReplayPolicy {
  std::vector<std::string> rank_by;       // metrics: the first one defined in a combination ranks its trials
  std::size_t budget_bytes = 12'000'000;  // of all packed replays
  std::vector<std::uint64_t> asked = {};  // ids of requested trials
};

struct Replay {
  std::uint64_t trial = 0;       // id
  std::vector<std::string> why;  // "asked", "median", "worst", "fault", "failure"
  std::string packed;            // replay_json() by gzip, in base64
};

struct OmittedReplays {
  std::string why;  // reason for the selection
  std::uint64_t trials = 0;
  std::string reason;  // reason for the omission, for readers
};

struct Replays {
  std::vector<Replay> replays;          // by id
  std::vector<OmittedReplays> omitted;  // by priority
};

// Reads RUN_DIRECTORY/traces/trial_000000.mcap and so on. Omits and counts trials whose trace is missing or damaged or
// whose replay exceeds the budget. `trials` are ordered by id. `events_of`: the events of a trial, if `trials` have not all.
Replays encode_replays(const std::filesystem::path& run_directory, std::span<const TrialRecord> trials,
                       std::span<const MetricColumn> metrics, const ReplayPolicy& policy,
                       const std::function<std::vector<MetricEvent>(std::uint64_t trial)>& events_of = {});

}  // namespace dmrp::host
