// SPDX-License-Identifier: MIT
// trial_filter.hpp: the trials of a run that agree with conditions such as "scenario=mall".
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/export/run_settings.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

// The trials with these values in columns of trials_table.hpp that are no metrics. Conditions on one column are
// alternatives, those on several columns hold together. Numbers may be written in any way; "planner" and "controller"
// are columns, too. Throws InputError for an
// unknown column, for a value that no trial has, and if no trial agrees with all.
std::vector<TrialRecord> trials_where(const std::vector<std::string>& conditions, std::span<const TrialRecord> trials,
                                      const RunSettings& settings);

}  // namespace dmrp::host
