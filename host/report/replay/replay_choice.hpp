// SPDX-License-Identifier: MIT
// replay_choice.hpp: which trials of a run are worth a replay, and in which order where there is no room for all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/results/trial_record.hpp"

namespace dmrp::host {

struct ReplayWish {
  std::size_t trial = 0;  // index into the trials
  std::string why;        // "asked", "median", "worst", "fault", "failure"
};

// Most wanted first: the trials asked for by id; every combination's median trial (the lower one of an even number),
// then every combination's worst; then faults and failures, of each combination one, of each a second, and so on.
// Trials are ranked by the first metric of `rank_by` that is defined anywhere in their combination, equals by id. A
// trial may be wished for more than one reason. Skipped trials count for nothing.
std::vector<ReplayWish> wished_replays(std::span<const TrialRecord> trials, std::span<const MetricColumn> metrics,
                                       std::span<const std::string> rank_by, std::span<const std::uint64_t> asked);

}  // namespace dmrp::host
