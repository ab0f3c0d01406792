// SPDX-License-Identifier: MIT
// ranks.hpp: ranks of values, ties sharing the mean of theirs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace dmrp::core {

// Twice the midrank of each value, so that it is a whole number: 2 for the least of distinct values. Values that lie
// within `tolerance` above the least of their group count as equal.
std::vector<std::int64_t> doubled_midranks(std::span<const double> values, double tolerance = 0.0);

}  // namespace dmrp::core
