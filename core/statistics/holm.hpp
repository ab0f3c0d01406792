// SPDX-License-Identifier: MIT
// holm.hpp: adjusts the p values of a family of tests so that the probability of any false positive stays below the
// significance level.
#pragma once

#include <span>
#include <vector>

namespace dmrp::core {

// Holm: A simple sequentially rejective multiple test procedure, Scandinavian Journal of Statistics 6 (1979): the k-th
// smallest of m is multiplied by m - k + 1, made ascending, at most 1. NaNs do not count as tests and stay NaN.
std::vector<double> holm_adjusted(std::span<const double> p_values);

}  // namespace dmrp::core
