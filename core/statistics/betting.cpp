// SPDX-License-Identifier: MIT
#include "core/statistics/betting.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace dmrp::core {
namespace {

// The capital is spread over this many bets, each of which stakes another share of what it has on every value.
constexpr std::size_t bets = 4;

// What a capital of 1 becomes by bets that the mean is above `center`. The shares go up to all that there is, which is
// best where values hardly vary, from the one that is best for n values that vary as much as values with this mean can.
// Where expectations differ, that of each product is at most one if their mean is at most `center`, since an arithmetic
// mean is at least the geometric one.
double capital_against_low(std::span<const double> values, double center, double level) {
  const auto n = static_cast<double>(values.size());
  const double least_stake = std::min(1.0, std::sqrt(2.0 * std::log(1.0 / level) * center / (n * (1.0 - center))));
  double sum = 0.0;
  for (std::size_t bet = 0; bet < bets; ++bet) {
    const double stake = std::pow(least_stake, static_cast<double>(bet) / static_cast<double>(bets - 1));
    double capital = 1.0;
    for (const double value : values) capital *= 1.0 - stake + stake * value / center;
    sum += capital;
  }
  return sum / static_cast<double>(bets);
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
    (center > 0.0 && capital_against_low(values, center, level) >= 1.0 / level ? low : high) = center;
  }
  return low;
}

}  // namespace

Interval betting_interval(std::span<const double> values) {
  assert(std::all_of(values.begin(), values.end(), [](double value) { return value >= 0.0 && value <= 1.0; }));
  if (values.empty()) return {};
  return {lower_bound(values, significance / 2.0), 1.0 - lower_bound(mirrored(values), significance / 2.0)};
}

}  // namespace dmrp::core
