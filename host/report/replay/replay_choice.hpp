// SPDX-License-Identifier: MIT
// replay_choice.hpp: selects the trials of a run for replays, in order of priority.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/results/trial_record.hpp"

namespace dmrp::host {

struct ReplayCandidate {
  std::size_t trial = 0;  // index into the trials
  std::string why;        // "asked", "median", "worst", "fault", "failure"
};

// In order of priority: requested trials; the median trial of every combination (the lower one of an even number); the
// worst of every combination; faults, then failures, in rounds of one for each combination. Trials are ranked by the
// first metric of `rank_by` that is defined in their combination, ties by id. A trial appears once for each reason.
// Ignores skipped trials.
std::vector<ReplayCandidate> replay_candidates(std::span<const TrialRecord> trials,
                                               std::span<const MetricColumn> metrics,
                                               std::span<const std::string> rank_by,
                                               std::span<const std::uint64_t> asked);

}  // namespace dmrp::host
