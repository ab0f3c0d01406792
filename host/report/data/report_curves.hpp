// SPDX-License-Identifier: MIT
// report_curves.hpp: metrics with values at several coordinates (thresholds), over the trials of a combination.
#pragma once

#include <cstdint>
#include <vector>

#include "core/statistics/mean_of_tasks.hpp"
#include "host/report/data/report_frame.hpp"

namespace dmrp::host {

struct CurvePoint {
  double coordinate;
  core::MeanOfTasks over_tasks;
  std::uint32_t defined;  // trials
};

struct MetricCurve {
  std::size_t metric;              // index
  std::size_t combination;         // index
  std::vector<CurvePoint> points;  // by coordinate
};

// The system's curves, by metric, then combination. Omits the metric for delays of people and curves without a
// defined point.
std::vector<MetricCurve> metric_curves(const ReportFrame& frame, const std::string& people_progress);

}  // namespace dmrp::host
