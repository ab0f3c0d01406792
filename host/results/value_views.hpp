// SPDX-License-Identifier: MIT
// value_views.hpp: views of results.sqlite with a column for each metric.
#pragma once

#include <span>
#include <string>

#include "host/results/trial_record.hpp"

namespace dmrp::host {

// SQL that creates
//   trial_values   one row a trial: the columns of `trial`, then the system's values
//   robot_values   one row a robot of a trial: trial_id, robot, then its values
// Columns of metrics have their units: "completion_time [s]". Values of curves are in `value` alone.
std::string create_value_views(std::span<const MetricColumn> metrics);

}  // namespace dmrp::host
