// SPDX-License-Identifier: MIT
// trials_csv.hpp: trials.csv, one line a trial.
#pragma once

#include <span>
#include <string>

#include "host/results/trial_record.hpp"

namespace dmrp::host {

// What is known of each trial, then the system's value of every metric; empty where it is undefined.
std::string trials_csv(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials);

}  // namespace dmrp::host
