// SPDX-License-Identifier: MIT
// run_description.hpp: what a run notes of its experiment before it begins.
#pragma once

#include <string>
#include <vector>

#include "host/experiment/experiment.hpp"
#include "host/results/manifest.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

// The values of all metrics.
std::vector<MetricColumn> columns_of(const Experiment& experiment);

// `trials_planned`: of the shard.
ExperimentFacts facts_of(const Experiment& experiment, const Shard& shard, std::uint64_t trials_planned);

// What the run depends on, beside the experiment's text.
Manifest manifest_of(const Experiment& experiment, const Shard& shard, std::uint64_t trials_planned,
                     const std::vector<std::string>& command_line);

}  // namespace dmrp::host
