// SPDX-License-Identifier: MIT
// holm.hpp: p values of a family of tests, adjusted so that the chance of any false alarm stays below the level.
#pragma once

#include <span>
#include <vector>

namespace dmrp::core {

// Holm: A simple sequentially rejective multiple test procedure, Scandinavian Journal of Statistics 6 (1979): the k-th
// smallest of m is multiplied by m - k + 1, made ascending, at most 1. NaNs are no tests: they stay NaN.
std::vector<double> holm_adjusted(std::span<const double> p_values);

}  // namespace dmrp::core
