// SPDX-License-Identifier: MIT
// report_correlations.hpp: rank correlations of metrics, within one scenario, planner and pedestrian model each, and
// within controllers, because pooling can cause Simpson's paradox.
#pragma once

#include <cstddef>
#include <vector>

#include "core/statistics/rank_correlation.hpp"
#include "host/report/data/report_frame.hpp"
#include "host/report/data/report_layout.hpp"

namespace dmrp::host {

struct StratumCorrelation {
  CombinationLabels stratum;  // without a controller: includes the trials of all controllers
  std::size_t x;              // metrics
  std::size_t y;
  core::RankCorrelation correlation;  // over the tasks in which both are defined, within controllers
};

std::vector<StratumCorrelation> stratum_correlations(const ReportFrame& frame, const DiagnosisAxes& axes);

}  // namespace dmrp::host
