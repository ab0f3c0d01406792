// SPDX-License-Identifier: MIT
#include "core/statistics/threshold.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace dmrp::core {
namespace {

constexpr double half = 0.5;
constexpr double of_rounding = 1e-12;  // of means

// On the scale of positions in the list of levels: i between levels i and i + 1; -1 beyond the hardest, the number of
// levels beyond the easiest.
double half_position(std::span<const double> fit) {
  if (fit.empty()) return -1.0;
  for (std::size_t i = 0; i < fit.size(); ++i) {
    if (fit[i] < half - of_rounding) continue;
    if (i == 0) return -1.0;
    return static_cast<double>(i - 1) + std::min(1.0, (half - fit[i - 1]) / (fit[i] - fit[i - 1]));
  }
  return static_cast<double>(fit.size());
}

// The mean of each level over these repetitions, levels without any left out.
struct Means {
  std::vector<double> values;
  std::vector<double> weights;
  std::vector<std::size_t> levels;
};

template <class Repetitions>
Means means_of(std::span<const LevelOutcomes> levels, const Repetitions& repetitions) {
  Means means;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    double sum = 0.0;
    double count = 0.0;
    for (const std::size_t repetition : repetitions) {
      const double value = levels[level].by_repetition[repetition];
      if (std::isnan(value)) continue;
      sum += value;
      count += 1.0;
    }
    if (count == 0.0) continue;
    means.values.push_back(sum / count);
    means.weights.push_back(count);
    means.levels.push_back(level);
  }
  return means;
}

// The position among all levels of one among those that have means.
double position_of(const Means& means, std::size_t levels) {
  const double among = half_position(isotonic_fit(means.values, means.weights));
  if (among < 0.0) return -1.0;
  if (among >= static_cast<double>(means.levels.size())) return static_cast<double>(levels);
  const auto below = static_cast<std::size_t>(among);
  const double part = among - static_cast<double>(below);
  const auto at = [&](std::size_t i) {
    return static_cast<double>(means.levels[std::min(i, means.levels.size() - 1)]);
  };
  return at(below) + part * (at(below + 1) - at(below));
}

Threshold threshold_at(std::span<const LevelOutcomes> levels, double position) {
  const auto last = static_cast<double>(levels.size() - 1);
  if (position < 0.0) return {levels.front().level, true, false};
  if (position > last) return {levels.back().level, false, true};
  const auto below = std::min(static_cast<std::size_t>(position), levels.size() - 1);
  const std::size_t above = std::min(below + 1, levels.size() - 1);
  const double part = position - static_cast<double>(below);
  return {levels[below].level + part * (levels[above].level - levels[below].level), false, false};
}

std::vector<std::size_t> all_repetitions(std::span<const LevelOutcomes> levels) {
  std::vector<std::size_t> all(levels.front().by_repetition.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

}  // namespace

std::vector<double> isotonic_fit(std::span<const double> values, std::span<const double> weights) {
  assert(weights.size() == values.size());
  assert(std::all_of(weights.begin(), weights.end(), [](double weight) { return weight > 0.0; }));
  struct Block {
    double mean;
    double weight;
    std::size_t count;
  };
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < values.size(); ++i) {
    blocks.push_back({values[i], weights[i], 1});
    while (blocks.size() > 1 && blocks[blocks.size() - 2].mean >= blocks.back().mean) {
      const Block last = blocks.back();
      blocks.pop_back();
      Block& pooled = blocks.back();
      const double weight = pooled.weight + last.weight;
      pooled = {(pooled.mean * pooled.weight + last.mean * last.weight) / weight, weight, pooled.count + last.count};
    }
  }
  std::vector<double> fit;
  for (const Block& block : blocks) fit.insert(fit.end(), block.count, block.mean);
  return fit;
}

Threshold half_threshold(std::span<const LevelOutcomes> levels) {
  assert(!levels.empty() && std::all_of(levels.begin(), levels.end(), [&](const LevelOutcomes& level) {
    return level.by_repetition.size() == levels.front().by_repetition.size();
  }));
  return threshold_at(levels, position_of(means_of(levels, all_repetitions(levels)), levels.size()));
}

namespace {

ThresholdBracket bracket_of(std::span<const LevelOutcomes> levels) {
  const Means means = means_of(levels, all_repetitions(levels));
  const std::vector<double> fit = isotonic_fit(means.values, means.weights);
  const auto passed = std::find_if(fit.begin(), fit.end(), [](double value) { return value >= half - of_rounding; });
  const auto level_at = [&](auto found) {
    return levels[means.levels[static_cast<std::size_t>(found - fit.begin())]].level;
  };
  ThresholdBracket bracket;
  if (passed != fit.begin()) bracket.last_failed = level_at(passed - 1);
  if (passed != fit.end()) bracket.first_passed = level_at(passed);
  bracket.is_steep =
      bracket.last_failed && bracket.first_passed && *(passed - 1)<of_rounding&& * passed> 1.0 - of_rounding;
  return bracket;
}

}  // namespace

ThresholdEstimate estimate_threshold(std::span<const LevelOutcomes> levels, const Resampling& resampling) {
  ThresholdEstimate estimate{half_threshold(levels), {}, {}, bracket_of(levels)};
  std::vector<double> positions;
  std::vector<std::size_t> drawn;
  for (std::size_t i = 0; i < resampling.resamples(); ++i) {
    drawn.clear();
    for (std::size_t task = 0; task < resampling.tasks(); ++task)
      drawn.insert(drawn.end(), resampling.counts(i)[resampling.observation_of_task(task)], task);
    positions.push_back(position_of(means_of(levels, drawn), levels.size()));
  }
  if (positions.empty()) return estimate;
  std::sort(positions.begin(), positions.end());
  // positions themselves, not means of two: between a level and "beyond" there is nothing
  const auto last = static_cast<double>(positions.size() - 1);
  estimate.low = threshold_at(levels, positions[static_cast<std::size_t>(std::floor(0.025 * last))]);
  estimate.high = threshold_at(levels, positions[static_cast<std::size_t>(std::ceil(0.975 * last))]);
  return estimate;
}

}  // namespace dmrp::core
