// SPDX-License-Identifier: MIT
// report_data.hpp: all that the page of a report knows, as one JSON text. NaN is written as null, seeds as text (64 bits
// do not fit a number of JavaScript), lists of equal length run in parallel:
//
//   format            1
//   run               name, seed, repetitions, trials_planned, trials_finished, version, started, command_line,
//                     effective_toml, manifest (as it is)
//   scenarios         [{name, robots, title, description, people, time_limit_s}]
//   metrics           [{name, unit, direction: higher | lower | none, wall_clock, description}]
//   combinations      [{scenario, robots, global_planner, local_controller, pedestrian_model}]; the index is its id
//   trials            columns: {id, combination, repetition, seed, outcome, repeatable, sim_time_s, wall_time_s}
//   values            {metric: [the system's value of each trial]}; metrics that are curves alone are left out
//   summaries         [combination][metric]: {trials, defined, mean, sd, median, low, high, paper_mean, paper_count,
//                     paper_trimmed_all_nonzero}: the numbers of summary.csv
//   planners          [{scenario, robots, global_planner}], planner_summaries [planner][metric]: the same over all
//                     controllers and pedestrian models
//   curves            [{metric, combination, coordinate_unit, points: [[coordinate, mean, low, high, defined]]}]
//   comparisons, correlations, completion, pedestrian_delay: report_statistics.hpp
//   faults            [{trial, kind, plugin, function, step, robot, signal, detail, rerun}]
//   layouts           {summary, report}: the files in share/dmrp/layouts
//   replays           [{trial, why, element}] in the page; replays_left_out [{why, trials, reason}]
#pragma once

#include <cstdint>
#include <span>
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

// Those of share/dmrp/layouts.
ReportLayouts read_report_layouts(const std::filesystem::path& folder);

// A replay that the page holds in the element of that id.
struct ReplayMention {
  std::uint64_t trial = 0;
  std::vector<std::string> why;  // "median", "worst", "failure", "fault", "asked"
  std::string element;
};

struct ReplayIndex {
  std::vector<ReplayMention> replays;
  std::vector<ReplaysLeftOut> left_out;
};

std::string report_data_json(const ReportRun& run, const ReportLayouts& layouts, const ReplayIndex& replays);

}  // namespace dmrp::host
