// SPDX-License-Identifier: MIT
// line_chart.hpp: a metric over a number that trials differ in, as lines with intervals.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/statistics/descriptive.hpp"
#include "host/export/run_settings.hpp"
#include "host/results/summary_layout.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

struct ChartPoint {
  double x = 0.0;
  double mean = 0.0;
  core::Interval interval{};  // 95 % of the mean, over tasks; NaN: none
};

struct ChartLine {
  std::string name;  // the labels in which lines differ
  std::vector<ChartPoint> points;
};

struct LineChart {
  std::string x_title;
  std::string y_title;  // with the unit
  std::vector<ChartLine> lines;
};

// `over`: "robots", or a name of the settings whose values are numbers. Plugins whose labels
// differ only because of that parameter make one line. Throws InputError if the metric or `over` is unknown, or if
// trials do not differ in it.
LineChart metric_over(const std::string& metric, const std::string& over, const SummaryLayout& layout,
                      std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials,
                      const RunSettings& settings);

std::string svg_document(const LineChart& chart);

}  // namespace dmrp::host
