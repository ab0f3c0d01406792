// SPDX-License-Identifier: MIT
// threshold.hpp: the level of a graded test at which half of the attempts succeed.
#pragma once

#include <span>
#include <vector>

#include "core/statistics/bootstrap.hpp"

namespace dmrp::core {

// The non-decreasing sequence nearest to the values in the sense of least squares, with weights above zero: pooled
// adjacent violators (Barlow, Bartholomew, Bremner, Brunk: Statistical Inference under Order Restrictions, 1972).
std::vector<double> isotonic_fit(std::span<const double> values, std::span<const double> weights);

// A level and the shares of success there (0 to 1), one for each repetition; NaN: missing.
struct LevelOutcomes {
  double level = 0.0;
  std::vector<double> by_repetition;
};

// Success is assumed not to get rarer with easier levels; nothing else about the form of the curve. The threshold is
// where the isotonic fit, linear between levels, first reaches one half.
struct Threshold {
  double level = 0.0;
  bool beyond_hardest = false;  // even the hardest level, `level`, succeeds that often
  bool beyond_easiest = false;  // not even the easiest level, `level`, does
};

struct ThresholdEstimate {
  Threshold threshold;
  Threshold low;   // 95 % interval, on the side of the harder levels: percentile bootstrap over repetitions, which are
  Threshold high;  // drawn together at all levels
};

// `levels`: from the hardest to the easiest, at least one, with the same number of repetitions.
Threshold half_threshold(std::span<const LevelOutcomes> levels);
ThresholdEstimate estimate_threshold(std::span<const LevelOutcomes> levels, const BootstrapSettings& settings = {});

}  // namespace dmrp::core
