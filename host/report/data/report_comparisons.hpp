// SPDX-License-Identifier: MIT
// report_comparisons.hpp: paired comparisons of combinations, over the tasks that both met.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/statistics/signed_rank.hpp"
#include "host/ranking/paired_difference.hpp"
#include "host/report/data/report_frame.hpp"
#include "host/report/data/report_layout.hpp"
#include "host/results/manifest.hpp"

namespace dmrp::host {

enum class Varied { global_planner, local_controller, pedestrian_model };

// One metric of two combinations that differ in one label only. Differences are b - a.
struct PairedComparison {
  std::size_t metric;  // index
  Varied varied;
  std::size_t a;  // combinations
  std::size_t b;
  std::uint32_t pairs;  // of trials
  std::uint32_t ties;   // tasks of equal values
  PairedTest test;
  PairedDifference difference;  // p_holm: over all comparisons of the metric and `varied` in the scenario
  core::HodgesLehmann shift;    // the median difference
  double effect;                // matched-pairs rank-biserial correlation
};

// For the metrics of the layout, in its order. Omits pairs of combinations without a situation that both met (for
// `both_succeeded`: one in which both succeeded).
std::vector<PairedComparison> paired_comparisons(const ReportFrame& frame, const ExperimentFacts& facts,
                                                 const ReportLayout& layout,
                                                 std::span<const std::string> counts_failures);

}  // namespace dmrp::host
