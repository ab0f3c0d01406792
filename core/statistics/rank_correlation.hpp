// SPDX-License-Identifier: MIT
// rank_correlation.hpp: Spearman's rank correlation with what makes it believable: ties, seeds, chance.
#pragma once

#include <cstdint>
#include <span>

#include "core/statistics/bootstrap.hpp"

namespace dmrp::core {

// Pearson's correlation of midranks: exact under ties. NaN of fewer than two pairs, or where all x or all y are equal.
double spearman(std::span<const double> x, std::span<const double> y);

struct RankCorrelation {
  std::uint32_t n;
  double rho;
  Interval interval;  // 95 %, by the bootstrap over clusters (1,000 resamples); of two clusters or more
  double p;           // two-sided: orders of y within its blocks with a correlation at least as far from their mean,
                      // which is zero where there is one block
  bool exact;  // all orders were counted (to n = 8, one block); else 5,000 are drawn, the observed one among them
  double ties_share;  // of the pairs of observations that are equal in x or in y
};

// `cluster`: what each pair belongs to: a seed. `block`: within what chance may have exchanged it, so that differences
// between blocks alone give no small p; empty: all are one. rho is of all together. Deterministic: draws come from named
// streams.
RankCorrelation rank_correlation(std::span<const double> x, std::span<const double> y,
                                 std::span<const std::uint64_t> cluster, std::span<const std::uint32_t> block = {},
                                 std::uint64_t seed = 1);

}  // namespace dmrp::core
