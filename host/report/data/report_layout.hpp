// SPDX-License-Identifier: MIT
// report_layout.hpp: what a report shows and compares: a data file (host/layouts/report.json), so that code names no
// metric. What is for the page alone (tables, heat map) stays JSON; here stands what statistics are made of.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "host/report/replay/replays.hpp"

namespace dmrp::host {

enum class PairedTest { signed_rank, sign_flip };

// A metric whose values are compared, by seed, between the planners, the controllers, the pedestrian models.
struct ComparedMetric {
  std::string metric;
  PairedTest test = PairedTest::signed_rank;
  bool censored = false;  // a time: where it is undefined, the trial's time limit counts
  bool both_succeeded =
      false;  // means something of trials that succeeded only: pairs in which one did not are left out
};

// x against each of y, within each scenario and planner.
struct DiagnosisAxes {
  std::string x;
  std::vector<std::string> y;
};

// Of the pair of trials with and without robots.
struct PedestrianDelayMetrics {
  std::string progress;       // curve over seconds: mean distance gained by a person, m
  std::string desired_speed;  // mean over people, m/s
};

struct CurveAxis {
  std::string metric;
  std::string coordinate;  // what it is, for people
  std::string coordinate_unit;
};

struct ReportLayout {
  std::string json;  // the whole file
  std::vector<ComparedMetric> comparisons;
  DiagnosisAxes diagnosis;
  std::string completion;  // metric: when a robot arrived, undefined if it did not
  PedestrianDelayMetrics pedestrian_delay;
  std::vector<CurveAxis> curves;
  ReplayPolicy replays;
};

// `name` is for messages. Throws std::runtime_error.
ReportLayout parse_report_layout(std::string_view json, const std::string& name);
ReportLayout read_report_layout(const std::filesystem::path& path);

}  // namespace dmrp::host
