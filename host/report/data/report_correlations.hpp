// SPDX-License-Identifier: MIT
// report_correlations.hpp: the diagnosis plot's rank correlations, each within one scenario, planner and crowd: pooling
// planners invites Simpson's paradox.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/statistics/rank_correlation.hpp"
#include "host/report/data/report_frame.hpp"
#include "host/report/data/report_layout.hpp"

namespace dmrp::host {

struct StratumCorrelation {
  CombinationLabels stratum;  // without a controller: its trials are those of all of them
  std::size_t x;              // metrics
  std::size_t y;
  core::RankCorrelation correlation;  // over the trials in which both are defined, those of one controller exchangeable
};

std::vector<StratumCorrelation> stratum_correlations(const ReportFrame& frame, const DiagnosisAxes& axes);

}  // namespace dmrp::host
