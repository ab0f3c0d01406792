// SPDX-License-Identifier: MIT
// report_json.hpp: what the data of all pages have in common, as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "host/findings/summary.hpp"
#include "host/results/manifest.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

using Json = nlohmann::ordered_json;

// {scenario, robots, global_planner, local_controller, pedestrian_model}
Json labels_json(const CombinationLabels& labels);

// [{name, unit, direction: higher | lower | none, wall_clock, description}]
Json metrics_json(std::span<const MetricColumn> metrics);

// [{name, robots, title, description, people, time_limit_s}]
Json scenarios_json(std::span<const ScenarioFacts> scenarios);

}  // namespace dmrp::host
