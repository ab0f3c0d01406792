// SPDX-License-Identifier: MIT
// system_values.hpp: the system's values of all metrics in one table: found once, read often.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "host/results/trial_record.hpp"

namespace dmrp::host {

// [trial][metric], as in the lists; curves and other subjects left out. None where undefined or not measured.
using SystemValues = std::vector<std::vector<std::optional<double>>>;
SystemValues system_values(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials);

}  // namespace dmrp::host
