// SPDX-License-Identifier: MIT
// paired_test.hpp: the tests of paired differences.
#pragma once

#include <cstddef>
#include <span>

namespace dmrp::host {

inline constexpr double significant = 0.05;

// Pairs or values. Fewer give no p below 5 %, and intervals that are too narrow: of them no difference, effect or
// correlation is shown.
inline constexpr std::size_t fewest_observations = 6;

enum class PairedTest { signed_rank, sign_flip };  // core/statistics

struct PairedResult {
  double p = 1.0;          // two-sided; NaN without differences
  double direction = 0.0;  // above zero: the differences are rather positive
};
PairedResult paired_test(std::span<const double> differences, PairedTest test);

}  // namespace dmrp::host
