// SPDX-License-Identifier: MIT
// graded_series.hpp: tests with levels: how hard a level each combination of planner and controller passes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/statistics/threshold.hpp"
#include "host/findings/summary.hpp"
#include "host/results/manifest.hpp"
#include "host/results/summary_layout.hpp"

namespace dmrp::host {

// One combination in one series. A repetition is passed if all of its robots succeed, by the first share of the answer's.
struct GradedResult {
  std::string global_planner;
  std::string local_controller;
  std::string pedestrian_model;
  std::vector<double> means;  // the share of repetitions passed, by level; NaN: no trials
  core::ThresholdEstimate estimate;
};

struct GradedSeries {
  std::string name;
  std::string title;
  std::string quantity;  // "width of the door"
  std::string unit;
  bool harder_when_higher = true;
  std::vector<double> levels;          // from the hardest to the easiest
  std::vector<std::string> scenarios;  // of the levels, as in the results
  std::vector<GradedResult> results;   // in order of first appearance
};

// In order of first appearance. Empty without tests with levels, or if success was not measured.
std::vector<GradedSeries> graded_series(const SummaryLayout& layout, std::span<const ScenarioFacts> scenarios,
                                        std::span<const TrialRecord> trials);

// "0.72 [0.71, 0.74] m"; "between 0.7 and 0.75 m" if nobody passes the one and all pass the other; "≤ 0.55 m" if even the
// hardest level, 0.55 m, is passed; "> 1 m" if not even the easiest is.
std::string threshold_words(const GradedSeries& series, const core::ThresholdEstimate& estimate);

// What tells a combination from the others of all series: the controller alone, if there is one planner.
std::string combination_name(std::span<const GradedSeries> all, const GradedResult& result);

}  // namespace dmrp::host
