// SPDX-License-Identifier: MIT
// mean_of_tasks.hpp: means over tasks and their paired differences, with 95 % intervals.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "core/statistics/descriptive.hpp"
#include "core/statistics/resampling.hpp"

namespace dmrp::core {

// What values of a metric can be: [0, 1] of a share. None: unbounded at one end at least.
using Bounds = std::optional<Interval>;
inline constexpr Interval share_bounds{0.0, 1.0};

// Fewer unbounded values have no interval: theirs would be too narrow. Differences have long tails on both sides, so that
// Student's interval alone will do for some of fewer.
inline constexpr std::size_t fewest_for_bootstrap_t = 10;
inline constexpr std::size_t fewest_for_student = 5;

struct MeanOfTasks {
  std::uint32_t n = 0;  // observations in which the value is defined: tasks, or worlds "in general"
  double mean = undefined;
  double sd = undefined;  // of the observations, with n - 1
  Interval interval;      // undefined: none
  // The interval's own procedure tests, two-sided, whether the mean is 0: p is below 0.05 where the interval excludes 0. It
  // is undefined for means of bounded values, and without an interval.
  double p = undefined;
};

// The mean over observations (resampling.hpp). Its interval: of bounded values by betting (betting.hpp), from one
// observation on; of unbounded ones by the bootstrap-t (Efron and Tibshirani 1993, section 12.5) from ten on, at
// either end at least as far from the mean as Student's; none below. Where all unbounded values are equal, there is none:
// the data show no spread.
MeanOfTasks mean_of_tasks(std::span<const double> by_task, const Bounds& bounds, const Resampling& resampling);

// The mean of paired differences, over observations in which they are defined. `bounds`: of the values, not of their
// differences. The interval of bounded ones is Student's over n + 2 observations, two of which are the largest differences
// that bounds allow, up and down: so that one rare difference does not decide (as Agresti and Coull add successes and
// failures to shares: The American Statistician 52, 1998). It stays within these bounds. The interval of unbounded ones is
// the bootstrap-t from ten observations on, Student's from five.
MeanOfTasks difference_of_tasks(std::span<const double> differences, const Bounds& bounds,
                                const Resampling& resampling);

// Differences with those two observations added. `span`: the largest difference.
struct PaddedMean {
  std::size_t n = 0;  // with them
  double mean = undefined;
  double error = undefined;  // its standard error

  double bound(double one_sided) const { return student_quantile(n, one_sided) * error; }  // so far from the mean
};
PaddedMean padded_mean(std::span<const double> differences, double span);

// The largest share that n tasks without a single case allow, at 95 %: 1 - 0.05^(1/n), about 3 / n (Hanley, Lippman-Hand:
// If nothing goes wrong, is everything all right?, JAMA 249, 1983). 1 without tasks.
double rule_of_three(std::uint32_t n);

}  // namespace dmrp::core
