// SPDX-License-Identifier: MIT
#include "core/statistics/betting.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

namespace dmrp::core {
namespace {

// The share of the capital that stays in a bet on each value; the capital is spread over these bets from the start. All
// of it: what few equal values need. Less: what many that vary need.
constexpr std::array<double, 5> stakes = {1.0, 0.7, 0.4, 0.2, 0.1};

// What a capital of 1 becomes by bets that the mean is above `center`. Falls with `center`. Where expectations differ,
// the product's own is at most one, as long as their mean is at most `center` (arithmetic and geometric means).
double capital_against_low(std::span<const double> values, double center) {
  double sum = 0.0;
  for (const double stake : stakes) {
    double capital = 1.0;
    for (const double value : values) capital *= 1.0 - stake + stake * value / center;
    sum += capital;
  }
  return sum / static_cast<double>(stakes.size());
}

std::vector<double> mirrored(std::span<const double> values) {
  std::vector<double> other;
  for (const double value : values) other.push_back(1.0 - value);
  return other;
}

// The largest mean that the bets refute at this level; 0 if they refute none.
double lower_bound(std::span<const double> values, double level) {
  double low = 0.0;
  double high = mean(values);
  for (int step = 0; step < 50; ++step) {
    const double center = 0.5 * (low + high);
    (center > 0.0 && capital_against_low(values, center) >= 1.0 / level ? low : high) = center;
  }
  return low;
}

}  // namespace

Interval betting_interval(std::span<const double> values) {
  assert(std::all_of(values.begin(), values.end(), [](double value) { return value >= 0.0 && value <= 1.0; }));
  if (values.empty()) return {};
  return {lower_bound(values, significance / 2.0), 1.0 - lower_bound(mirrored(values), significance / 2.0)};
}

double betting_lower_bound(std::span<const double> values) {
  return values.empty() ? undefined : lower_bound(values, significance);
}

double betting_p(std::span<const double> values, double center) {
  assert(center > 0.0 && center < 1.0);
  if (values.empty()) return undefined;
  const double most =
      std::max(capital_against_low(values, center), capital_against_low(mirrored(values), 1.0 - center));
  return std::min(1.0, 2.0 / most);
}

}  // namespace dmrp::core
