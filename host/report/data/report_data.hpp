// SPDX-License-Identifier: MIT
// report_data.hpp: the data of a report as one JSON text. NaN is null; seeds are strings (JavaScript's numbers hold 53
// bits); lists of equal length are parallel:
//
//   format            1
//   run               name, seed, repetitions, trials_planned, trials_finished, version, started, command_line,
//                     effective_toml, conditions, manifest (the whole file)
//   scenarios         [{name, robots, title, description, people, time_limit_s}]
//   metrics           [{name, unit, direction: higher | lower | none, wall_clock, description}]
//   combinations      [{scenario, robots, global_planner, local_controller, pedestrian_model}]; the index is its id
//   trials            columns: {id, combination, repetition, seed, outcome, repeatable, sim_time_s, wall_time_s}
//   values            {metric: [the system's value of each trial]}, to seven significant digits; without metrics that
//                     have curves only
//   met               what the trials have met, in words; observation: "task" or "crowd", that n counts
//   summaries         [combination][metric]: {trials, n, defined, mean, sd, median, low, high, at_most, paper_mean,
//                     paper_count, paper_trimmed_all_nonzero}: the numbers of summary.csv
//   planners          [{scenario, robots, global_planner}], planner_summaries [planner][metric]: the same over all
//                     controllers and pedestrian models
//   curves            [{metric, combination, coordinate_unit, points: [[coordinate, mean, low, high, defined]]}]
//   comparisons, correlations, completion, pedestrian_delay: report_statistics.hpp
//   graded            [{name, title, quantity, unit, levels, scenarios, results: [{global_planner, local_controller,
//                     pedestrian_model, threshold, means}]}]: tests with levels, from hard to easy
//   timing            [{trial, plugin, reason}]: why trials are not repeatable
//   faults            [{trial, kind, plugin, function, step, robot, signal, detail, rerun}]
//   layouts           {summary, report}: the files in share/dmrp/layouts
//   replays           [{trial, why, element}] in the page; replays_left_out [{why, trials, reason}]
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/report/data/report_layout.hpp"
#include "host/report/data/report_run.hpp"
#include "host/report/replay/replays.hpp"
#include "host/results/summary_layout.hpp"

namespace dmrp::host {

struct ReportLayouts {
  SummaryLayout summary;
  std::string summary_json;  // the whole file
  ReportLayout report;
};

// Reads the files of share/dmrp/layouts.
ReportLayouts read_report_layouts(const std::filesystem::path& folder);

// A replay in the page and the id of its element.
struct ReplayEntry {
  std::uint64_t trial = 0;
  std::vector<std::string> why;  // "median", "worst", "failure", "fault", "asked"
  std::string element;
};

struct ReplayIndex {
  std::vector<ReplayEntry> replays;
  std::vector<OmittedReplays> omitted;
};

std::string report_data_json(const ReportRun& run, const ReportLayouts& layouts, const ReplayIndex& replays);

}  // namespace dmrp::host
