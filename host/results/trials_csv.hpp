// SPDX-License-Identifier: MIT
// trials_csv.hpp: trials.csv, one line for each trial.
#pragma once

#include <span>
#include <string>

#include "host/results/trial_record.hpp"

namespace dmrp::host {

// The properties of each trial, then the system's value of every metric, empty if undefined.
std::string trials_csv(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials);

}  // namespace dmrp::host
