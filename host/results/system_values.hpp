// SPDX-License-Identifier: MIT
// system_values.hpp: a table of the system's values of all metrics, for fast access.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "host/results/trial_record.hpp"

namespace dmrp::host {

// [trial][metric] in the order of the lists, without curves and other subjects. None if undefined or not measured.
using SystemValues = std::vector<std::vector<std::optional<double>>>;
SystemValues system_values(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials);

}  // namespace dmrp::host
