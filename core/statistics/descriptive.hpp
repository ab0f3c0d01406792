// SPDX-License-Identifier: MIT
// descriptive.hpp: descriptive statistics for the summaries of a run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace dmrp::core {

// The statistic of too few values.
inline constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

// It is the level of tests and, as 1 - 0.05, that of intervals.
inline constexpr double significance = 0.05;

// Between two ends; undefined at both where there is none.
struct Interval {
  double low = undefined;
  double high = undefined;
};

double mean(std::span<const double> values);       // undefined without one
double sample_sd(std::span<const double> values);  // with n - 1; needs two values
double median(std::span<const double> values);     // needs one value; the mean of the middle two of an even number

// Student's t for the mean of n >= 2 normal values: exceeded with this probability.
double student_quantile(std::size_t n, double probability);
// The probability that it lies at least |t| away from 0; 1 if t is undefined.
double student_two_sided(std::size_t n, double t);

// The p-quantile of ascending values, with linear interpolation (Hyndman and Fan's type 7).
double quantile_of_sorted(std::span<const double> ascending, double p);

// The mean as the paper defines it: the values of successful trials without those farther than two standard deviations
// (n - 1) from their mean, in one pass; below n = 5 all values count.
struct TrimmedMean {
  double mean;
  std::uint32_t count;       // of the values that count
  bool trimmed_all_nonzero;  // all values other than zero were trimmed: the mean hides a rare event
};
TrimmedMean paper_mean(std::span<const double> values_of_successful_trials);

}  // namespace dmrp::core
