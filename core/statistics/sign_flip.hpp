// SPDX-License-Identifier: MIT
// sign_flip.hpp: a permutation test of the mean of paired differences.
#pragma once

#include <cstdint>
#include <span>

namespace dmrp::core {

// Fisher's randomisation test (The Design of Experiments, 1935, section 21), two-sided: the share of all assignments of
// signs to the differences whose mean is at least as far from zero. With up to 20 differences other than zero all
// assignments are counted; otherwise 10,000 are drawn from a named stream, with the observed one (Phipson, Smyth 2010).
// Means that agree to one part in 10^9 of the sum of absolute differences are equal.
struct SignFlipTest {
  double mean;  // of all differences; NaN without differences, and so is p
  double p;
  bool exact;
};
SignFlipTest sign_flip_test(std::span<const double> differences, std::uint64_t seed = 1);

}  // namespace dmrp::core
