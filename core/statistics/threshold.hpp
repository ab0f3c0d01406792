// SPDX-License-Identifier: MIT
// threshold.hpp: the level of a graded test at which half of the attempts succeed.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/statistics/bootstrap.hpp"
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

struct ThresholdEstimate {
  Threshold threshold;
  Threshold low;   // 95 % interval, on the side of the harder levels: percentile bootstrap over repetitions, which are
  Threshold high;  // drawn together at all levels
};

// `levels`: from the hardest to the easiest, at least one, with the same number of repetitions.
Threshold half_threshold(std::span<const LevelOutcomes> levels);
ThresholdEstimate estimate_threshold(std::span<const LevelOutcomes> levels, const BootstrapSettings& settings = {});

// The same over a resampling of tasks, of which repetitions are the tasks.
ThresholdEstimate estimate_threshold(std::span<const LevelOutcomes> levels, const Resampling& resampling);

// Around the threshold: the last level that fails (the isotonic fit is below one half) and the first that is passed.
struct ThresholdBracket {
  std::optional<double> last_failed;   // none: even the hardest level is passed
  std::optional<double> first_passed;  // none: not even the easiest level is
  bool is_steep =
      false;  // both fit values are 0 and 1: the threshold lies between the two levels, and nothing measured
              // says where: print the bracket, neither the estimate nor its interval
};
ThresholdBracket threshold_bracket(std::span<const LevelOutcomes> levels);

}  // namespace dmrp::core
