// SPDX-License-Identifier: MIT
// rank_correlation.hpp: Spearman's rank correlation with ties, a clustered interval and a permutation test.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/statistics/bootstrap.hpp"
#include "core/statistics/resampling.hpp"

namespace dmrp::core {

struct RankCorrelation {
  std::uint32_t n;
  double rho;         // NaN for fewer than two pairs, or if all x or all y are equal
  Interval interval;  // 95 %, by the bootstrap over clusters (1,000 resamples); needs at least two clusters
  double p;           // two-sided: the share of permutations of y within its blocks whose correlation is at least as
                      // far from zero
  bool exact;         // p counts all permutations (up to n = 8, one block); otherwise 5,000, with the observed one
  double ties_share;  // of the pairs of observations of a block that are equal in x or in y
};

// `cluster`: the cluster of each pair, a seed. `block`: everything is computed within blocks, so that differences between
// blocks count for nothing; empty: one block. rho is the correlation of the midranks within blocks, each minus its
// block's mean rank. Deterministic: draws come from named streams.
RankCorrelation rank_correlation(std::span<const double> x, std::span<const double> y,
                                 std::span<const std::uint64_t> cluster, std::span<const std::uint32_t> block = {},
                                 std::uint64_t seed = 1);

// Fewer pairs have no correlation.
inline constexpr std::size_t fewest_for_correlation = 6;

// Of two metrics by tasks, x and y [entry][task], NaN where undefined, which leaves out the pair. Ranks are those within
// an entry, so that differences between entries count for nothing. One permutation of tasks holds for all entries: a task
// that is hard for one is hard for all, so that their pairs are no separate evidence. Undefined below six tasks with a
// pair. `n` counts tasks, as does the interval's resampling.
RankCorrelation task_rank_correlation(std::span<const std::vector<double>> x, std::span<const std::vector<double>> y,
                                      const Resampling& resampling, std::uint64_t seed = 1);

}  // namespace dmrp::core
