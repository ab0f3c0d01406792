// SPDX-License-Identifier: MIT
#include "core/statistics/rank_correlation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <dmrp/toolkit/random.hpp>
#include <limits>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "core/statistics/ranks.hpp"

namespace dmrp::core {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_exact = 8;
constexpr std::uint64_t draws = 5'000;
constexpr std::uint32_t resamples = 1'000;
constexpr double equal_within = 1e-12;  // rounding of the mean of products, which is zero with one block

using Ranks = std::vector<std::int64_t>;

// Doubled midranks minus their mean, n + 1: integers, so that sums of products are exact.
Ranks centered_ranks(std::span<const double> values) {
  Ranks ranks = doubled_midranks(values);
  for (std::int64_t& rank : ranks) rank -= static_cast<std::int64_t>(values.size()) + 1;
  return ranks;
}

std::int64_t product(const Ranks& a, const Ranks& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), std::int64_t{0});
}

// Clamped to [-1, 1] against rounding.
double correlation_of(std::int64_t xx, std::int64_t xy, std::int64_t yy) {
  if (xx == 0 || yy == 0) return undefined;
  const double spread = std::sqrt(static_cast<double>(xx)) * std::sqrt(static_cast<double>(yy));
  return std::clamp(static_cast<double>(xy) / spread, -1.0, 1.0);
}

double correlation(const Ranks& x, const Ranks& y) {
  return correlation_of(product(x, x), product(x, y), product(y, y));
}

double exact_p(const Ranks& x, Ranks y) {
  const std::int64_t observed = std::abs(product(x, y));
  std::vector<std::size_t> order(y.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::uint64_t as_far = 0;
  std::uint64_t orders = 0;
  do {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[order[i]];
    if (std::abs(sum) >= observed) ++as_far;
    ++orders;
  } while (std::next_permutation(order.begin(), order.end()));
  return static_cast<double>(as_far) / static_cast<double>(orders);
}

// Both are ordered by block. The mean product over all permutations within blocks is that of the blocks' means.
double drawn_p(const std::vector<Ranks>& x, std::vector<Ranks> y, std::uint64_t seed) {
  const auto product_of_all = [&] {
    std::int64_t sum = 0;
    for (std::size_t block = 0; block < x.size(); ++block) sum += product(x[block], y[block]);
    return static_cast<double>(sum);
  };
  double mean = 0.0;
  for (std::size_t block = 0; block < x.size(); ++block)
    mean += static_cast<double>(std::accumulate(x[block].begin(), x[block].end(), std::int64_t{0})) *
            static_cast<double>(std::accumulate(y[block].begin(), y[block].end(), std::int64_t{0})) /
            static_cast<double>(x[block].size());
  const double observed = std::abs(product_of_all() - mean);
  const double as_good_as = observed - equal_within * (observed + std::abs(mean));
  toolkit::Stream random(seed, "statistics.rank_correlation");
  std::uint64_t as_far = 1;
  for (std::uint64_t draw = 0; draw < draws; ++draw) {
    for (Ranks& of_block : y) random.shuffle(of_block);
    if (std::abs(product_of_all() - mean) >= as_good_as) ++as_far;
  }
  return static_cast<double>(as_far) / static_cast<double>(draws + 1);
}

std::vector<Ranks> by_block(const Ranks& ranks, std::span<const std::uint32_t> block) {
  if (block.empty()) return {ranks};
  std::map<std::uint32_t, Ranks> found;
  for (std::size_t i = 0; i < ranks.size(); ++i) found[block[i]].push_back(ranks[i]);
  std::vector<Ranks> blocks;
  for (auto& [id, of_block] : found) blocks.push_back(std::move(of_block));
  return blocks;
}

// The index of each value among the distinct values; the ranks of a resample then follow by counting.
std::vector<std::uint32_t> places(std::span<const double> values) {
  std::vector<double> distinct(values.begin(), values.end());
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  std::vector<std::uint32_t> found;
  for (const double value : values)
    found.push_back(
        static_cast<std::uint32_t>(std::lower_bound(distinct.begin(), distinct.end(), value) - distinct.begin()));
  return found;
}

// Centred doubled midranks of values with multiplicities `count`.
void rank_by_counts(const std::vector<std::uint32_t>& place, const std::vector<std::uint32_t>& count, Ranks& ranks) {
  std::vector<std::int64_t> at(place.size() + 1, 0);  // the number of each distinct value
  for (std::size_t i = 0; i < place.size(); ++i) at[place[i]] += count[i];
  std::int64_t below = 0;
  const std::int64_t total = std::accumulate(at.begin(), at.end(), std::int64_t{0});
  for (std::int64_t& here : at) {
    const std::int64_t number = here;
    here = 2 * below + number + 1 - (total + 1);
    below += number;
  }
  for (std::size_t i = 0; i < place.size(); ++i) ranks[i] = at[place[i]];
}

double weighted_correlation(const Ranks& x, const Ranks& y, const std::vector<std::uint32_t>& count) {
  std::int64_t xx = 0;
  std::int64_t xy = 0;
  std::int64_t yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += count[i] * x[i] * x[i];
    xy += count[i] * x[i] * y[i];
    yy += count[i] * y[i] * y[i];
  }
  return correlation_of(xx, xy, yy);
}

Interval bootstrap(std::span<const double> x, std::span<const double> y, std::span<const std::uint64_t> cluster,
                   std::uint64_t seed) {
  std::map<std::uint64_t, std::uint32_t> index_of;
  for (const std::uint64_t id : cluster) index_of.emplace(id, 0);
  if (index_of.size() < 2) return {undefined, undefined};
  std::uint32_t next = 0;
  for (auto& [id, index] : index_of) index = next++;
  std::vector<std::uint32_t> cluster_of;
  for (const std::uint64_t id : cluster) cluster_of.push_back(index_of.at(id));
  const BootstrapDraws drawn(index_of.size(), {resamples, seed});
  const auto place_x = places(x);
  const auto place_y = places(y);
  std::vector<std::uint32_t> of_cluster(index_of.size());
  std::vector<std::uint32_t> count(x.size());
  Ranks ranks_x(x.size());
  Ranks ranks_y(y.size());
  std::vector<double> correlations;
  for (std::size_t i = 0; i < drawn.resamples(); ++i) {
    std::fill(of_cluster.begin(), of_cluster.end(), 0);
    for (const std::uint32_t draw : drawn.resample(i)) ++of_cluster[draw];
    for (std::size_t k = 0; k < count.size(); ++k) count[k] = of_cluster[cluster_of[k]];
    rank_by_counts(place_x, count, ranks_x);
    rank_by_counts(place_y, count, ranks_y);
    correlations.push_back(weighted_correlation(ranks_x, ranks_y, count));
  }
  return percentile_interval(std::move(correlations));
}

double share_of_ties(std::span<const double> x, std::span<const double> y) {
  std::uint64_t tied = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (x[i] == x[j] || y[i] == y[j]) ++tied;
  return static_cast<double>(2 * tied) / (static_cast<double>(x.size()) * static_cast<double>(x.size() - 1));
}

}  // namespace

double spearman(std::span<const double> x, std::span<const double> y) {
  return correlation(centered_ranks(x), centered_ranks(y));
}

RankCorrelation rank_correlation(std::span<const double> x, std::span<const double> y,
                                 std::span<const std::uint64_t> cluster, std::span<const std::uint32_t> block,
                                 std::uint64_t seed) {
  RankCorrelation result{
      static_cast<std::uint32_t>(x.size()), undefined, {undefined, undefined}, undefined, true, undefined};
  if (x.size() < 2) return result;
  result.ties_share = share_of_ties(x, y);
  const Ranks ranks_x = centered_ranks(x);
  const Ranks ranks_y = centered_ranks(y);
  result.rho = correlation(ranks_x, ranks_y);
  if (std::isnan(result.rho)) return result;
  const std::vector<Ranks> blocks_x = by_block(ranks_x, block);
  result.exact = x.size() <= most_exact && blocks_x.size() == 1;
  result.p = result.exact ? exact_p(ranks_x, ranks_y) : drawn_p(blocks_x, by_block(ranks_y, block), seed);
  result.interval = bootstrap(x, y, cluster, seed);
  return result;
}

}  // namespace dmrp::core
