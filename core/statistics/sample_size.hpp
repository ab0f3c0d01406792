// SPDX-License-Identifier: MIT
// sample_size.hpp: how many pairs a comparison needs.
#pragma once

#include <cstdint>
#include <optional>

namespace dmrp::core {

// The number of pairs from which a two-sided test at this level finds a mean difference with a probability of 80 %, if
// the paired differences deviate by `sd`: Guenther's approximation to the paired t test (The American Statistician 35,
// 1981). None if sd is not above zero: then the pairs say nothing about how much others would differ.
std::optional<std::uint64_t> pairs_needed(double sd, double difference, double level);

}  // namespace dmrp::core
