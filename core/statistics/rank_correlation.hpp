// SPDX-License-Identifier: MIT
// rank_correlation.hpp: Spearman's rank correlation of two metrics over tasks, with ties, an interval and a permutation
// test.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/statistics/resampling.hpp"

namespace dmrp::core {

// Fewer pairs have no correlation.
inline constexpr std::size_t fewest_for_correlation = 6;

struct RankCorrelation {
  std::uint32_t n = 0;  // tasks with a pair
  double rho = undefined;
  Interval interval;     // 95 %, between quantiles over the resampling of tasks
  double p = undefined;  // two-sided: the share of 5,000 permutations and the observed one whose correlation is
                         // at least as far from zero
  double ties_share = undefined;  // of the pairs of an entry's tasks that are equal in x or in y
};

// Of two metrics by tasks, x and y [entry][task], NaN where undefined, which leaves out the pair. rho is the correlation
// of the midranks within an entry, each minus the entry's mean rank, so that differences between entries count for
// nothing. One permutation of tasks holds for all entries: a task that is hard for one is hard for all, so that their
// pairs are no separate evidence. Undefined below six tasks with a pair, and if all x or all y are equal.
RankCorrelation task_rank_correlation(std::span<const std::vector<double>> x, std::span<const std::vector<double>> y,
                                      const Resampling& resampling, std::uint64_t seed = 1);

}  // namespace dmrp::core
