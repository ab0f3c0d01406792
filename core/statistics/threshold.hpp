// SPDX-License-Identifier: MIT
// threshold.hpp: the level of a graded test at which half of the attempts succeed.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/statistics/resampling.hpp"

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

// Around the threshold: the last level that fails (the isotonic fit is below one half) and the first that is passed.
struct ThresholdBracket {
  std::optional<double> last_failed;   // none: even the hardest level is passed
  std::optional<double> first_passed;  // none: not even the easiest level is
  bool is_steep = false;  // the fit is 0 at one and 1 at the other: nothing measured says where between them it lies
};

struct ThresholdEstimate {
  Threshold threshold;
  Threshold
      low;  // 95 % interval, on the side of the harder levels: between quantiles over the resampling, in which the
  Threshold high;  // repetitions are the tasks, drawn together at all levels. Says nothing where the threshold is steep
  ThresholdBracket bracket{};
};

// `levels`: from the hardest to the easiest, at least one, with the same number of repetitions.
Threshold half_threshold(std::span<const LevelOutcomes> levels);
ThresholdEstimate estimate_threshold(std::span<const LevelOutcomes> levels, const Resampling& resampling);

}  // namespace dmrp::core
