// SPDX-License-Identifier: MIT
#include "core/statistics/signed_rank.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/statistics/descriptive.hpp"
#include "core/statistics/ranks.hpp"

namespace dmrp::core {
namespace {

constexpr std::size_t most_exact_pairs = 100;
constexpr double tied_within = 1e-9;  // of the largest difference

// The probability of each sum of positive ranks if all signs are equally likely.
std::vector<double> signed_rank_distribution(std::span<const std::int64_t> ranks) {
  const auto total = static_cast<std::size_t>(std::accumulate(ranks.begin(), ranks.end(), std::int64_t{0}));
  std::vector<double> probability(total + 1, 0.0);
  probability[0] = 1.0;
  std::size_t reached = 0;
  for (const std::int64_t rank : ranks) {
    const auto step = static_cast<std::size_t>(rank);
    reached += step;
    for (std::size_t sum = reached + 1; sum-- > 0;)
      probability[sum] = 0.5 * (probability[sum] + (sum >= step ? probability[sum - step] : 0.0));
  }
  return probability;
}

double exact_p(std::span<const std::int64_t> ranks, std::int64_t positive) {
  const std::vector<double> probability = signed_rank_distribution(ranks);
  const auto total = static_cast<std::int64_t>(probability.size()) - 1;
  const auto tail = static_cast<std::ptrdiff_t>(std::min(positive, total - positive));
  const double below = std::accumulate(probability.begin(), probability.begin() + tail + 1, 0.0);
  return std::min(1.0, 2.0 * below);  // the distribution is symmetric
}

// For doubled ranks: mean and deviation are doubled, and so is the correction of one half.
double normal_p(std::span<const std::int64_t> ranks, std::int64_t positive) {
  double sum = 0.0;
  double squares = 0.0;
  for (const std::int64_t rank : ranks) {
    sum += static_cast<double>(rank);
    squares += static_cast<double>(rank) * static_cast<double>(rank);
  }
  const double distance = std::max(0.0, std::abs(static_cast<double>(positive) - 0.5 * sum) - 1.0);
  const boost::math::normal standard;
  return std::min(1.0, 2.0 * boost::math::cdf(boost::math::complement(standard, distance / std::sqrt(0.25 * squares))));
}

}  // namespace

SignedRankTest signed_rank_test(std::span<const double> differences) {
  SignedRankTest test;
  test.pairs = static_cast<std::uint32_t>(differences.size());
  if (differences.empty()) {
    test.p = test.rank_biserial = undefined;
    return test;
  }
  std::vector<double> sizes;
  for (const double difference : differences) sizes.push_back(std::abs(difference));
  const double tolerance = tied_within * *std::max_element(sizes.begin(), sizes.end());
  const std::vector<std::int64_t> all_ranks = doubled_midranks(sizes, tolerance);

  std::vector<std::int64_t> ranks;  // of the differences other than zero
  std::int64_t positive = 0;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    if (sizes[i] <= tolerance) continue;
    ranks.push_back(all_ranks[i]);
    if (differences[i] > 0.0) positive += all_ranks[i];
  }
  test.zeros = static_cast<std::uint32_t>(differences.size() - ranks.size());
  test.positive_rank_sum = 0.5 * static_cast<double>(positive);
  if (ranks.empty()) return test;
  test.exact = ranks.size() <= most_exact_pairs;
  test.p = test.exact ? exact_p(ranks, positive) : normal_p(ranks, positive);
  const std::int64_t signed_sum = 2 * positive - std::accumulate(ranks.begin(), ranks.end(), std::int64_t{0});
  const std::int64_t total = std::accumulate(all_ranks.begin(), all_ranks.end(), std::int64_t{0});
  test.rank_biserial = static_cast<double>(signed_sum) / static_cast<double>(total);
  return test;
}

HodgesLehmann hodges_lehmann(std::span<const double> differences) {
  const std::size_t n = differences.size();
  if (n == 0) return {undefined, {undefined, undefined}};
  std::vector<double> walsh;
  walsh.reserve(n * (n + 1) / 2);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i; j < n; ++j) walsh.push_back(0.5 * (differences[i] + differences[j]));
  std::sort(walsh.begin(), walsh.end());

  // The number of Walsh averages to skip at either end.
  std::size_t left_out = 0;
  if (n <= most_exact_pairs) {
    std::vector<std::int64_t> ranks(n);
    std::iota(ranks.begin(), ranks.end(), 1);
    const std::vector<double> probability = signed_rank_distribution(ranks);
    double below = probability[0];
    while (below <= 0.5 * significance) below += probability[++left_out];
  } else {
    const auto count = static_cast<double>(n);
    const double z = boost::math::quantile(boost::math::normal(), 1.0 - 0.5 * significance);
    left_out = static_cast<std::size_t>(0.5 * static_cast<double>(walsh.size()) -
                                        z * std::sqrt(count * (count + 1.0) * (2.0 * count + 1.0) / 24.0));
  }
  const double center = quantile_of_sorted(walsh, 0.5);
  if (left_out == 0) return {center, {undefined, undefined}};
  return {center, {walsh[left_out - 1], walsh[walsh.size() - left_out]}};
}

}  // namespace dmrp::core
