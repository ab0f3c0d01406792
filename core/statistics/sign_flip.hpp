// SPDX-License-Identifier: MIT
// sign_flip.hpp: a permutation test of the mean of paired differences.
#pragma once

#include <cstdint>
#include <span>

namespace dmrp::core {

// Fisher's randomisation test (The Design of Experiments, 1935, section 21), two-sided: the share of all ways to give
// the differences signs for which their mean is at least as far from zero. All are counted for up to 20 differences
// other than zero; else 10,000 are drawn from a named stream, and the observed one counts among them (Phipson, Smyth
// 2010). Means that agree to one part in 10^9 of the differences' sum are equal.
struct SignFlipTest {
  double mean;  // of all differences; NaN of none, as is p
  double p;
  bool exact;
};
SignFlipTest sign_flip_test(std::span<const double> differences, std::uint64_t seed = 1);

}  // namespace dmrp::core
