// SPDX-License-Identifier: MIT
#include "core/statistics/level_effects.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <limits>

namespace dmrp::core {
namespace {

constexpr std::size_t most_for_all_signs = 12;
constexpr std::size_t drawn_signs = 4095;  // and the observed ones
constexpr double level = 0.95;
constexpr double rounding = 1e-9;  // sums in another order differ by less

// [level][observation]: a level minus the mean of the others, where all are defined.
std::vector<std::vector<double>> from_the_others(const std::vector<std::vector<double>>& values) {
  std::vector<std::vector<double>> differences(values.size());
  const auto others = static_cast<double>(values.size() - 1);
  for (std::size_t i = 0; i < values.front().size(); ++i) {
    double sum = 0.0;
    for (const std::vector<double>& of_level : values) sum += of_level[i];
    if (std::isnan(sum)) continue;
    for (std::size_t l = 0; l < values.size(); ++l)
      differences[l].push_back(values[l][i] - (sum - values[l][i]) / others);
  }
  return differences;
}

struct Mean {
  double mean;
  double error;  // its standard error
  double t() const {
    if (error > 0.0) return std::fabs(mean) / error;
    return mean == 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
  }
};

Mean mean_with(const std::vector<double>& differences, const std::vector<double>& signs) {
  const auto n = static_cast<double>(differences.size());
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    sum += signs[i] * differences[i];
    squares += differences[i] * differences[i];
  }
  const double mean = std::fabs(sum) > rounding ? sum / n : 0.0;
  const double variance = (squares - n * mean * mean) / (n - 1.0);
  return {mean, variance > rounding * rounding ? std::sqrt(variance / n) : 0.0};
}

// The largest t of the levels for each assignment of signs, in order; the observed one is among them.
std::vector<double> largest_by_signs(const std::vector<std::vector<double>>& differences, std::uint64_t seed) {
  const std::size_t n = differences.front().size();
  const bool all = n <= most_for_all_signs;
  const std::size_t count = all ? std::size_t{1} << n : drawn_signs + 1;
  toolkit::Stream stream(seed, "statistics.level_effects");
  std::vector<double> largest;
  std::vector<double> signs(n, 1.0);
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < n && k > 0; ++i)
      signs[i] = (all ? (k >> i & 1u) != 0 : stream.below(2) != 0) ? -1.0 : 1.0;
    double most = 0.0;
    for (const std::vector<double>& of_level : differences) most = std::max(most, mean_with(of_level, signs).t());
    largest.push_back(most);
  }
  std::sort(largest.begin(), largest.end());
  return largest;
}

}  // namespace

std::vector<LevelEffect> level_effects(const std::vector<std::vector<double>>& values, std::uint64_t seed) {
  if (values.size() < 2) return {};
  const auto differences = from_the_others(values);
  const std::size_t n = differences.front().size();
  if (n < fewest_for_effects) return {};
  const std::vector<double> largest = largest_by_signs(differences, seed);
  const auto count = static_cast<double>(largest.size());
  // as few signs as 5 % have a larger one
  const double quantile = largest[static_cast<std::size_t>(std::ceil(level * count)) - 1];
  std::vector<LevelEffect> effects;
  for (const std::vector<double>& of_level : differences) {
    const Mean found = mean_with(of_level, std::vector<double>(n, 1.0));
    const auto at_least = std::lower_bound(largest.begin(), largest.end(), found.t() * (1.0 - rounding));
    const double half = found.error > 0.0 ? quantile * found.error : 0.0;
    effects.push_back(
        {found.mean, {found.mean - half, found.mean + half}, static_cast<double>(largest.end() - at_least) / count});
  }
  return effects;
}

}  // namespace dmrp::core
