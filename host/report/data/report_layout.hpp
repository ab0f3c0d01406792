// SPDX-License-Identifier: MIT
// report_layout.hpp: the metrics that a report shows and compares, from a data file (host/layouts/report.json), so that
// the code names no metric. Parses the keys for statistics; those for the page alone (tables, heat map) stay JSON.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "host/ranking/paired_difference.hpp"
#include "host/report/replay/replays.hpp"

namespace dmrp::host {

// A metric that is compared between planners, controllers and pedestrian models, paired by trial.
struct ComparedMetric {
  std::string metric;
  PairedTest test = PairedTest::signed_rank;
  bool censored = false;        // a time: an undefined value counts as the trial's time limit
  bool both_succeeded = false;  // omits pairs in which a trial did not succeed
};

// x against each of y, within each scenario and planner.
struct DiagnosisAxes {
  std::string x;
  std::vector<std::string> y;
};

struct CurveAxis {
  std::string metric;
  std::string coordinate;  // its name for readers
  std::string coordinate_unit;
};

struct ReportLayout {
  std::string json;  // the whole file
  std::vector<ComparedMetric> comparisons;
  DiagnosisAxes diagnosis;
  std::string completion;  // metric: arrival time of a robot, undefined if it did not arrive
  std::vector<CurveAxis> curves;
  ReplayPolicy replays;
};

// `name`: the file's name for error messages. Throws std::runtime_error.
ReportLayout parse_report_layout(std::string_view json, const std::string& name);
ReportLayout read_report_layout(const std::filesystem::path& path);

}  // namespace dmrp::host
