// SPDX-License-Identifier: MIT
// trials_table.hpp: all trials as CSV for pandas, R and spreadsheets.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/export/run_settings.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

// The columns before those of metrics, and a trial's text in one of them.
std::vector<std::string> label_columns(const RunSettings& settings);
std::string label_text(const std::string& column, const TrialRecord& trial, const RunSettings& settings);

// One line a trial: its labels, then one column for each parameter of its plugins and each setting, then one for each
// of these metrics' system values, with the unit: "completion_time [s]".
std::string trials_table_csv(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials,
                             const RunSettings& settings);

}  // namespace dmrp::host
