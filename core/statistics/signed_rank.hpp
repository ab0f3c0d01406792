// SPDX-License-Identifier: MIT
// signed_rank.hpp: rank statistics of paired differences: Wilcoxon's test, its effect size, and the corresponding
// estimate of the shift. Undefined results are NaN.
#pragma once

#include <cstdint>
#include <span>

#include "core/statistics/descriptive.hpp"

namespace dmrp::core {

// Wilcoxon's signed-rank test that the differences are symmetric around zero (Hollander, Wolfe: Nonparametric
// Statistical Methods, section 3.1), two-sided. Zeros are ranked with the others, then removed (Pratt 1959): removing
// them first can turn evidence for no difference into evidence for one. Ties get the mean of their ranks; absolute
// differences that agree to one part in 10^9 of the largest are tied, because rounding would order them at random.
struct SignedRankTest {
  std::uint32_t pairs = 0;
  std::uint32_t zeros = 0;
  double positive_rank_sum = 0.0;  // T+
  double p = 1.0;                  // 1 if all differences are zero; NaN without pairs
  bool exact = true;  // p counts all signs of the ranks, with ties (up to 100 pairs); otherwise it is the normal
                      // approximation with the variance of ties and the continuity correction
  double rank_biserial = 0.0;  // (T+ - T-) / (sum of all ranks, the zeros' too): -1 to 1 (Kerby 2014)
};
SignedRankTest signed_rank_test(std::span<const double> differences);

// The Hodges-Lehmann estimate: the median of the means of all pairs of differences, each also with itself (section
// 3.2), and its 95 % interval from the test's distribution without ties (Tukey; section 3.3), which needs six
// differences.
struct HodgesLehmann {
  double estimate;
  Interval interval;
};
HodgesLehmann hodges_lehmann(std::span<const double> differences);

}  // namespace dmrp::core
