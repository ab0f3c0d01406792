// SPDX-License-Identifier: MIT
// paired_test.hpp: the tests of paired differences.
#pragma once

#include <span>

namespace dmrp::host {

inline constexpr double significant = 0.05;

enum class PairedTest { signed_rank, sign_flip };  // core/statistics

struct PairedResult {
  double p = 1.0;          // two-sided; NaN without differences
  double direction = 0.0;  // above zero: the differences are rather positive
};
PairedResult paired_test(std::span<const double> differences, PairedTest test);

}  // namespace dmrp::host
