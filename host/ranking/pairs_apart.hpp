// SPDX-License-Identifier: MIT
// pairs_apart.hpp: how many pairs of contestants do the tasks of a contest tell apart?
#pragma once

#include <cstdint>

#include "host/ranking/contest.hpp"
#include "host/ranking/measures.hpp"

namespace dmrp::host {

// The smallest differences of interest: of the first share, and of the time relative to the slower contestant's.
inline constexpr double least_share_difference = 0.05;
inline constexpr double least_time_ratio = 0.05;

// Tasks whose first share has a mean outside leave too little room for differences.
inline constexpr double least_mean_share = 0.3;
inline constexpr double most_mean_share = 0.9;

struct PairsApart {
  std::uint32_t pairs = 0;
  std::uint32_t apart = 0;  // in the share or in the time: significant by Holm over all tests, and of interest
};

// The first criterion must be a share.
PairsApart pairs_apart(const Contest& contest, const Measures& measures);

}  // namespace dmrp::host
