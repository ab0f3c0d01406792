// SPDX-License-Identifier: MIT
#include "core/statistics/best_set.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <numeric>

#include "core/statistics/betting.hpp"
#include "core/statistics/descriptive.hpp"
#include "core/statistics/ranks.hpp"

namespace dmrp::core {
namespace {

constexpr std::size_t most_exact_observations = 12;
constexpr std::size_t drawn_flips = 4'095;  // beside the observed signs
constexpr double rounding_error = 1e-9;     // of the largest difference, or of a statistic
constexpr std::size_t fewest_observations = 6;

// Two entries in one criterion: that they are equally good is tested.
struct Contrast {
  std::size_t a = 0;
  std::size_t b = 0;
  std::size_t criterion = 0;
  std::vector<double> scores;  // by observation, above zero if b is better; 0: equal or undefined
  double scale = 0.0;          // the root of the sum of squares
  double statistic = 0.0;      // the sum over the scale: the same scale under all signs
  double gain = 0.0;           // the mean difference, above zero if b is better
  double p = 1.0;
};

std::vector<double> signed_ranks(const std::vector<double>& differences) {
  std::vector<double> sizes;
  for (const double difference : differences) sizes.push_back(std::abs(difference));
  const double tolerance = sizes.empty() ? 0.0 : rounding_error * *std::max_element(sizes.begin(), sizes.end());
  const std::vector<std::int64_t> ranks = doubled_midranks(sizes, tolerance);
  std::vector<double> scores;
  for (std::size_t i = 0; i < ranks.size(); ++i)
    scores.push_back(sizes[i] <= tolerance ? 0.0 : std::copysign(static_cast<double>(ranks[i]), differences[i]));
  return scores;
}

bool is_defined(double value) {
  return !std::isnan(value);
}

// `differences`: by observation.
Contrast contrast_of(std::vector<double> differences, const Criterion& criterion) {
  std::vector<double> defined;
  for (double& difference : differences) {
    if (!criterion.higher_is_better) difference = -difference;
    if (is_defined(difference)) defined.push_back(difference);
  }
  Contrast one;
  one.gain = mean(defined);
  if (criterion.score == PairedScore::ranks) defined = signed_ranks(defined);
  one.scale = std::sqrt(std::inner_product(defined.begin(), defined.end(), defined.begin(), 0.0));
  one.statistic = std::accumulate(defined.begin(), defined.end(), 0.0) / one.scale;
  one.scores.assign(differences.size(), 0.0);
  auto next = defined.begin();
  for (std::size_t i = 0; i < differences.size(); ++i)
    if (is_defined(differences[i])) one.scores[i] = *next++;
  return one;
}

// There is nothing to test where entries differ nowhere.
std::vector<Contrast> contrasts_of(std::size_t entries, std::span<const Criterion> criteria,
                                   const Resampling& resampling, std::uint32_t& observations) {
  std::vector<Contrast> found;
  for (std::size_t criterion = 0; criterion < criteria.size(); ++criterion)
    for (std::size_t a = 0; a < entries; ++a)
      for (std::size_t b = a + 1; b < entries; ++b) {
        auto differences = resampling.by_observation(criteria[criterion].differences(a, b));
        const auto shared = std::count_if(differences.begin(), differences.end(), is_defined);
        observations = std::max(observations, static_cast<std::uint32_t>(shared));
        Contrast one = contrast_of(std::move(differences), criteria[criterion]);
        if (one.scale < rounding_error) continue;
        one.a = a;
        one.b = b;
        one.criterion = criterion;
        found.push_back(std::move(one));
      }
  return found;
}

// Which observations change their sign, in one assignment after another, the first without a change: all assignments but
// for the last observation's (flipping all changes no size), or drawn ones. A byte for eight observations.
struct Flips {
  std::size_t assignments = 0;
  std::size_t bytes = 0;                // of an assignment
  std::vector<std::uint8_t> flipped{};  // [assignment][byte]
};

Flips flips_of(std::size_t observations) {
  const bool is_exact = observations <= most_exact_observations;
  Flips flips{is_exact ? std::size_t{1} << (observations - 1) : drawn_flips + 1, (observations + 7) / 8};
  flips.flipped.reserve(flips.assignments * flips.bytes);
  flips.flipped.assign(flips.bytes, 0);
  toolkit::Stream random(1, "statistics.best_set");
  for (std::size_t assignment = 1; assignment < flips.assignments; ++assignment) {
    std::uint64_t bits = assignment;
    for (std::size_t byte = 0; byte < flips.bytes; ++byte, bits >>= 8) {
      if (!is_exact && byte % 8 == 0) bits = random.next_u64();
      flips.flipped.push_back(static_cast<std::uint8_t>(bits));
    }
  }
  return flips;
}

// The sums of eight scores (fewer at the end) by which of them change their sign.
using SumsOfEight = std::array<double, 256>;

std::vector<SumsOfEight> sums_by_flips(std::span<const double> scores) {
  std::vector<SumsOfEight> sums((scores.size() + 7) / 8);
  for (std::size_t byte = 0; byte < sums.size(); ++byte) {
    const auto own = scores.subspan(8 * byte, std::min<std::size_t>(8, scores.size() - 8 * byte));
    sums[byte][0] = std::accumulate(own.begin(), own.end(), 0.0);
    for (std::size_t flipped = 1; flipped < 256; ++flipped) {
      const auto lowest = static_cast<std::size_t>(std::countr_zero(flipped));
      sums[byte][flipped] = sums[byte][flipped & (flipped - 1)] - (lowest < own.size() ? 2.0 * own[lowest] : 0.0);
    }
  }
  return sums;
}

// Stepdown: a contrast is compared with the largest statistic of those that are not larger than its own.
void adjust_by_stepdown(std::vector<Contrast>& contrasts, std::size_t observations) {
  std::stable_sort(contrasts.begin(), contrasts.end(),
                   [](const Contrast& x, const Contrast& y) { return std::abs(x.statistic) > std::abs(y.statistic); });
  const Flips flips = flips_of(observations);
  std::vector<double> largest(flips.assignments, 0.0);
  for (std::size_t k = contrasts.size(); k-- > 0;) {
    Contrast& one = contrasts[k];
    const std::vector<SumsOfEight> sums = sums_by_flips(one.scores);
    std::size_t as_large = 0;
    const std::uint8_t* flipped = flips.flipped.data();
    for (double& statistic : largest) {
      double sum = 0.0;
      for (const SumsOfEight& of_eight : sums) sum += of_eight[*flipped++];
      statistic = std::max(statistic, std::abs(sum) / one.scale);
      if (statistic >= std::abs(one.statistic) - rounding_error) ++as_large;
    }
    one.p = static_cast<double>(as_large) / static_cast<double>(flips.assignments);
  }
  double at_least = 0.0;
  for (Contrast& one : contrasts) one.p = at_least = std::max(at_least, one.p);
}

bool not_inferior_before(std::size_t better, std::size_t worse, std::size_t criterion,
                         std::span<const Criterion> criteria, const Resampling& resampling) {
  for (std::size_t i = 0; i < criterion; ++i)
    if (!non_inferior(criteria[i].differences(worse, better), criteria[i], resampling)) return false;
  return true;
}

}  // namespace

PairedDifferences differences_of(const std::vector<std::vector<double>>& values) {
  return [&values](std::size_t a, std::size_t b) {
    std::vector<double> differences;
    for (std::size_t i = 0; i < values[a].size(); ++i) differences.push_back(values[b][i] - values[a][i]);
    return differences;
  };
}

bool non_inferior(std::span<const double> differences, const Criterion& criterion, const Resampling& resampling) {
  std::vector<double> values;
  for (const double value : resampling.by_observation(differences))
    if (!std::isnan(value)) values.push_back(criterion.higher_is_better ? value : -value);
  if (values.empty()) return false;
  if (std::all_of(values.begin(), values.end(), [](double value) { return std::abs(value) < rounding_error; }))
    return true;
  if (criterion.bounds) {
    const PaddedMean padded = padded_mean(values, criterion.bounds->high - criterion.bounds->low);
    return padded.mean - padded.bound(significance) > -criterion.margin;
  }
  if (values.size() < fewest_for_bootstrap_t) return false;
  const double error = sample_sd(values) / std::sqrt(static_cast<double>(values.size()));
  return mean(values) - student_quantile(values.size(), significance) * error > -criterion.margin;
}

BestSet best_set(std::size_t entries, std::span<const Criterion> criteria, const Resampling& resampling) {
  BestSet result;
  result.excluded.resize(entries);
  std::vector<Contrast> contrasts = contrasts_of(entries, criteria, resampling, result.observations);
  if (result.observations < fewest_observations) return result;
  adjust_by_stepdown(contrasts, resampling.observations());
  for (std::size_t criterion = 0; criterion < criteria.size(); ++criterion) {
    auto after = result.excluded;  // those excluded by an earlier criterion exclude nobody
    for (const Contrast& one : contrasts) {
      if (one.criterion != criterion || !(one.p < significance)) continue;
      const auto [better, worse] = one.statistic > 0.0 ? std::pair(one.b, one.a) : std::pair(one.a, one.b);
      if (result.excluded[better] || after[worse]) continue;
      const double margin = criteria[criterion].margin;
      if (margin > 0.0 && (one.statistic > 0.0 ? one.gain : -one.gain) <= margin + rounding_error) continue;
      if (not_inferior_before(better, worse, criterion, criteria, resampling))
        after[worse] = Exclusion{better, criterion, one.p};
    }
    // ranks may order three entries in a circle; then this criterion says nothing
    if (std::any_of(after.begin(), after.end(), [](const auto& one) { return !one; })) result.excluded = after;
  }
  return result;
}

std::vector<bool> pareto_set(std::span<const std::vector<double>> means, const std::vector<bool>& higher_is_better) {
  const std::size_t entries = means.empty() ? 0 : means.front().size();
  const auto gain = [&](std::size_t criterion, std::size_t entry) {
    const double value = means[criterion][entry];
    if (std::isnan(value)) return -std::numeric_limits<double>::infinity();
    return higher_is_better[criterion] ? value : -value;
  };
  const auto dominates = [&](std::size_t one, std::size_t other) {
    bool better = false;
    for (std::size_t criterion = 0; criterion < means.size(); ++criterion) {
      if (gain(criterion, one) < gain(criterion, other)) return false;
      better = better || gain(criterion, one) > gain(criterion, other);
    }
    return better;
  };
  std::vector<bool> inside(entries, true);
  for (std::size_t entry = 0; entry < entries; ++entry)
    for (std::size_t other = 0; other < entries; ++other)
      if (other != entry && dominates(other, entry)) inside[entry] = false;
  return inside;
}

}  // namespace dmrp::core
