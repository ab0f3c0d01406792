// SPDX-License-Identifier: MIT
// report_comparisons.hpp: paired comparisons of combinations, over trials with the same seed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/statistics/bootstrap.hpp"
#include "host/report/data/report_frame.hpp"
#include "host/report/data/report_layout.hpp"
#include "host/results/manifest.hpp"

namespace dmrp::host {

enum class Varied { global_planner, local_controller, pedestrian_model };

// One metric of two combinations that differ in one label only. Differences are b - a, one pair for each seed.
struct PairedComparison {
  std::size_t metric;  // index
  Varied varied;
  std::size_t a;  // combinations
  std::size_t b;
  std::uint32_t pairs;
  std::uint32_t ties;        // pairs of equal values
  double median_difference;  // Hodges and Lehmann's
  core::Interval median_interval;
  double mean_difference;
  core::Interval mean_interval;  // bootstrap over seeds
  double effect;                 // matched-pairs rank-biserial correlation
  PairedTest test;
  bool exact;
  double p;
  double p_holm;  // corrected for all comparisons of the metric and `varied` in the scenario
};

// For the metrics of the layout, in its order. Omits pairs of combinations without a common seed (for `both_succeeded`:
// a seed with which both trials succeeded).
std::vector<PairedComparison> paired_comparisons(const ReportFrame& frame, const ExperimentFacts& facts,
                                                 const ReportLayout& layout,
                                                 std::span<const std::string> counts_failures);

}  // namespace dmrp::host
