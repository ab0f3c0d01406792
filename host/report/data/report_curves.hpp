// SPDX-License-Identifier: MIT
// report_curves.hpp: metrics with values at several coordinates (thresholds), over the trials of a combination.
#pragma once

#include <cstdint>
#include <vector>

#include "core/statistics/bootstrap.hpp"
#include "host/report/data/report_frame.hpp"
#include "host/report/data/report_layout.hpp"

namespace dmrp::host {

struct CurvePoint {
  double coordinate;
  double mean;              // of the trials in which it is defined; NaN if there is none
  core::Interval interval;  // 95 %, over seeds
  std::uint32_t defined;    // trials
};

struct MetricCurve {
  std::size_t metric;              // index
  std::size_t combination;         // index
  std::vector<CurvePoint> points;  // by coordinate
};

// The system's curves, by metric, then combination. Omits the metric for pedestrian delays and curves without a
// defined point.
std::vector<MetricCurve> metric_curves(const ReportFrame& frame, const ReportLayout& layout);

}  // namespace dmrp::host
