// SPDX-License-Identifier: MIT
// trials_table.hpp: all trials as CSV for pandas, R and spreadsheets.
#pragma once

#include <span>
#include <string>

#include "host/export/run_settings.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

// One line a trial: its labels, then one column for each parameter of its plugins and each setting, then one for each
// of these metrics' system values, with the unit: "completion_time [s]".
std::string trials_table_csv(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials,
                             const RunSettings& settings);

}  // namespace dmrp::host
