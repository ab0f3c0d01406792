// SPDX-License-Identifier: MIT
// ranks.hpp: midranks: ties get the mean of their ranks.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace dmrp::core {

// Twice the midrank of each value, an integer: 2 for the least of distinct values. Values that lie within `tolerance`
// above the least of their group count as equal.
std::vector<std::int64_t> doubled_midranks(std::span<const double> values, double tolerance = 0.0);

}  // namespace dmrp::core
