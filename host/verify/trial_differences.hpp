// SPDX-License-Identifier: MIT
// trial_differences.hpp: what differs between two runs of a trial that should be equal to the bit.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/results/trial_record.hpp"

namespace dmrp::host {

// One line each, "path_length of robot 2 is 10.25, was 10.5"; empty if there is none. Values that are measured by a clock
// (MetricColumn::wall_clock) are not compared. Both records come from databases.
std::vector<std::string> trial_differences(const TrialRecord& before, const TrialRecord& now,
                                           std::span<const MetricColumn> metrics);

}  // namespace dmrp::host
