// SPDX-License-Identifier: MIT
// descriptive.hpp: what the summaries of a run are made of. Undefined results (of too few values) are NaN.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace dmrp::core {

double mean(std::span<const double> values);       // of one or more
double sample_sd(std::span<const double> values);  // with n - 1; of two or more
double median(std::span<const double> values);     // of one or more; the mean of the middle two of an even number

// The p-quantile of ascending values, linear between them (Hyndman and Fan's type 7).
double quantile_of_sorted(std::span<const double> ascending, double p);

// The mean as the paper takes it: of the successful trials' values, those farther than two standard deviations (n - 1)
// from their mean are left out, in one pass, none below n = 5.
struct TrimmedMean {
  double mean;
  std::uint32_t count;       // of the values that were kept
  bool trimmed_all_nonzero;  // there were values other than zero, and none was kept: a rare event has vanished
};
TrimmedMean paper_mean(std::span<const double> values_of_successful_trials);

}  // namespace dmrp::core
