// SPDX-License-Identifier: MIT
#include "core/statistics/descriptive.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cassert>
#include <cmath>
#include <numeric>

namespace dmrp::core {
namespace {

double sum(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

bool nonzero(double value) {
  return value != 0.0;
}

}  // namespace

double mean(std::span<const double> values) {
  return values.empty() ? undefined : sum(values) / static_cast<double>(values.size());
}

double sample_sd(std::span<const double> values) {
  if (values.size() < 2) return undefined;
  const double center = mean(values);
  double squares = 0.0;
  for (const double value : values) squares += (value - center) * (value - center);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

double median(std::span<const double> values) {
  std::vector<double> ascending(values.begin(), values.end());
  std::sort(ascending.begin(), ascending.end());
  return quantile_of_sorted(ascending, 0.5);
}

double student_quantile(std::size_t n, double probability) {
  assert(n >= 2 && probability > 0.0 && probability < 1.0);
  const boost::math::students_t distribution(static_cast<double>(n - 1));
  return boost::math::quantile(boost::math::complement(distribution, probability));
}

double student_two_sided(std::size_t n, double t) {
  assert(n >= 2);
  if (std::isnan(t)) return 1.0;
  if (std::isinf(t)) return 0.0;
  const boost::math::students_t distribution(static_cast<double>(n - 1));
  return 2.0 * boost::math::cdf(boost::math::complement(distribution, std::abs(t)));
}

double quantile_of_sorted(std::span<const double> ascending, double p) {
  assert(std::is_sorted(ascending.begin(), ascending.end()) && p >= 0.0 && p <= 1.0);
  if (ascending.empty()) return undefined;
  const double position = p * static_cast<double>(ascending.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, ascending.size() - 1);
  return ascending[below] + (position - static_cast<double>(below)) * (ascending[above] - ascending[below]);
}

TrimmedMean paper_mean(std::span<const double> values_of_successful_trials) {
  std::vector<double> kept(values_of_successful_trials.begin(), values_of_successful_trials.end());
  if (kept.size() >= 5) {
    const double center = mean(kept);
    const double reach = 2.0 * sample_sd(kept);
    kept.erase(std::remove_if(kept.begin(), kept.end(), [&](double value) { return std::abs(value - center) > reach; }),
               kept.end());
  }
  const bool all_vanished =
      std::any_of(values_of_successful_trials.begin(), values_of_successful_trials.end(), nonzero) &&
      std::none_of(kept.begin(), kept.end(), nonzero);
  return {mean(kept), static_cast<std::uint32_t>(kept.size()), all_vanished};
}

}  // namespace dmrp::core
