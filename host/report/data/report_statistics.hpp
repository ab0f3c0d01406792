// SPDX-License-Identifier: MIT
// report_statistics.hpp: adds the statistics to the data of a report (report_data.hpp):
//
//   comparisons       [{metric, scenario, robots, varied: global_planner | local_controller | pedestrian_model, a, b,
//                     given: {the other two labels}, combinations: [of a, of b], pairs, n, ties,
//                     median_difference, low, high, mean_difference, mean_low, mean_high, effect, test: signed_rank |
//                     mean, equal, p, p_holm}]; differences are b - a; p: null below five observations, or if
//                     nothing differs
//   answers           [{heading, n, worlds, lines, cells: [labels], criteria: [{name, unit}], ranking:
//                     [{global_planner, local_controller, trials, means, standing: first | may_be_best | worse,
//                     decided: criterion, words, pareto, intervals: [[low, high]], against: [{n, mean, low, high,
//                     equal}]}]}]: answer.hpp; the first is over everything
//   best              [{labels, metric}]: best_marks.hpp; those of planners have an empty local_controller
//   failures          [{combination: labels, robots, causes: [{cause, robots, after_contact, roots, trials}],
//                     contact: {likewise}}],
//   failures_line     failure_causes.hpp
//   growth_line       manifest.hpp
//   standstills_line  likewise
//   correlations      [{scenario, robots, global_planner, pedestrian_model, x, y, n, rho, low, high, p,
//                     ties_share}]; n: observations
//   completion        [{combination, robots, horizon_s, restricted_mean_s, low, high, arrived_share,
//                     steps: [[t, share of robots that have arrived]]}]
//   pedestrian_delay  [{combination, pairs, n, mean_s, low, high}]
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "host/report/data/report_data.hpp"
#include "host/report/data/report_frame.hpp"

namespace dmrp::host {

void add_statistics(nlohmann::ordered_json& json, const ReportFrame& frame, const ExperimentFacts& facts,
                    const ReportLayouts& layouts);

}  // namespace dmrp::host
