// SPDX-License-Identifier: MIT
#include "core/statistics/mean_of_tasks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/statistics/betting.hpp"

namespace dmrp::core {
namespace {

// Of a resample, as a share of the observed one: few values that are nearly all equal have resamples in which nothing
// differs, and a division by nearly nothing would make the interval as wide as one likes.
constexpr double least_error = 0.2;

// How far an observation's value lies from the mean.
struct Deviation {
  std::size_t observation = 0;
  double value = 0.0;
};
using Strata = std::vector<std::vector<Deviation>>;

Strata strata_of(std::span<const double> values, double center, const Resampling& resampling) {
  Strata strata(resampling.strata());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isnan(values[i])) strata[resampling.stratum_of(i)].push_back({i, values[i] - center});
  return strata;
}

struct MeanAndError {
  double mean = undefined;
  double error = undefined;
};

// The mean of values that each count `count_of(observation)` times, and its standard error where draws stay within strata.
template <class CountOf>
MeanAndError mean_and_error(const Strata& strata, const CountOf& count_of) {
  double counts = 0.0;
  double sums = 0.0;
  double variance = 0.0;
  for (const std::vector<Deviation>& stratum : strata) {
    double count = 0.0;
    double sum = 0.0;
    double squares = 0.0;
    for (const auto& [observation, value] : stratum) {
      const double own = count_of(observation);
      count += own;
      sum += own * value;
      squares += own * value * value;
    }
    counts += count;
    sums += sum;
    if (count >= 2.0) variance += count * std::max(0.0, squares - sum * sum / count) / (count - 1.0);
  }
  return {sums / counts, std::sqrt(variance) / counts};
}

// Unbounded values get the bootstrap-t, not nearer to the mean than Student's interval at either end: with long tails on
// both sides the bootstrap-t is too narrow; with one it is not, where Student's is. Below ten Student's stands alone.
void add_interval(MeanOfTasks& result, std::span<const double> values, const Resampling& resampling) {
  const Strata strata = strata_of(values, result.mean, resampling);
  const MeanAndError observed = mean_and_error(strata, [](std::size_t) { return 1.0; });
  if (!(observed.error > 0.0)) return;  // equal values show no spread
  const double t = result.mean / observed.error;
  const double student = student_quantile(result.n, significance / 2.0);
  Interval errors{student, student};  // of the mean, below it and above
  result.p = student_two_sided(result.n, t);
  if (result.n >= fewest_for_bootstrap_t) {
    std::vector<double> studentised;
    for (std::size_t i = 0; i < resampling.resamples(); ++i) {
      const auto counts = resampling.counts(i);
      const MeanAndError drawn = mean_and_error(strata, [&](std::size_t k) { return static_cast<double>(counts[k]); });
      studentised.push_back((drawn.mean - observed.mean) / std::fmax(drawn.error, least_error * observed.error));
    }
    const auto beyond = std::count_if(studentised.begin(), studentised.end(),
                                      [&](double drawn) { return t > 0.0 ? drawn >= t : drawn <= t; });
    const double share = static_cast<double>(beyond) / static_cast<double>(studentised.size());
    result.p = std::fmax(result.p, std::fmin(1.0, 2.0 * share));
    const Interval quantiles = percentile_interval(std::move(studentised));
    errors = {std::fmax(student, quantiles.high), std::fmax(student, -quantiles.low)};
  }
  result.interval = {result.mean - errors.low * observed.error, result.mean + errors.high * observed.error};
}

// Sets n, mean and deviation of the defined values, which it returns.
std::vector<double> describe(std::span<const double> values, MeanOfTasks& result) {
  std::vector<double> defined;
  for (const double value : values)
    if (!std::isnan(value)) defined.push_back(value);
  result.n = static_cast<std::uint32_t>(defined.size());
  result.mean = mean(defined);
  result.sd = sample_sd(defined);
  return defined;
}

Interval interval_within(std::vector<double> values, const Interval& bounds) {
  const double span = bounds.high - bounds.low;
  for (double& value : values) value = std::clamp((value - bounds.low) / span, 0.0, 1.0);
  const Interval unit = betting_interval(values);
  return {bounds.low + span * unit.low, bounds.low + span * unit.high};
}

}  // namespace

MeanOfTasks mean_of_tasks(std::span<const double> by_task, const Bounds& bounds, const Resampling& resampling) {
  const std::vector<double> values = resampling.by_observation(by_task);
  MeanOfTasks result;
  std::vector<double> defined = describe(values, result);
  if (bounds && !defined.empty())
    result.interval = interval_within(std::move(defined), *bounds);
  else if (defined.size() >= fewest_for_bootstrap_t)
    add_interval(result, values, resampling);
  return result;
}

PaddedMean padded_mean(std::span<const double> differences, double span) {
  std::vector<double> padded(differences.begin(), differences.end());
  padded.insert(padded.end(), {span, -span});
  return {padded.size(), mean(padded), sample_sd(padded) / std::sqrt(static_cast<double>(padded.size()))};
}

MeanOfTasks difference_of_tasks(std::span<const double> differences, const Bounds& bounds,
                                const Resampling& resampling) {
  const std::vector<double> values = resampling.by_observation(differences);
  MeanOfTasks result;
  const std::vector<double> defined = describe(values, result);
  if (!bounds && result.n >= fewest_for_student) add_interval(result, values, resampling);
  if (!bounds || defined.empty()) return result;
  const double span = bounds->high - bounds->low;
  const PaddedMean padded = padded_mean(defined, span);
  const double half = padded.bound(significance / 2.0);
  result.interval = {std::max(-span, padded.mean - half), std::min(span, padded.mean + half)};
  result.p = student_two_sided(padded.n, padded.mean / padded.error);
  return result;
}

double rule_of_three(std::uint32_t n) {
  return n == 0 ? 1.0 : 1.0 - std::pow(0.05, 1.0 / static_cast<double>(n));
}

}  // namespace dmrp::core
