// SPDX-License-Identifier: MIT
// level_effects.hpp: how the levels of a factor differ, each from the mean of the others, in one procedure for all.
#pragma once

#include <cstdint>
#include <vector>

#include "core/statistics/descriptive.hpp"

namespace dmrp::core {

// Fewer observations cannot show an effect at 95 %.
inline constexpr std::size_t fewest_for_effects = 6;

// A level's mean difference from the mean of the others. With 95 % confidence all intervals of a factor hold; one excludes
// zero just where p, adjusted for the levels, is below 0.05.
struct LevelEffect {
  double mean = undefined;
  Interval interval{};
  double p = undefined;
};

// `values`: [level][observation], NaN where undefined; observations count in which all levels are defined. The largest
// |t| of the levels is compared with its distribution when the signs of whole observations are flipped (Westfall, Young:
// Resampling-Based Multiple Testing, 1993, section 2.3): all signs up to 12 observations, else 4,095 drawn ones and the
// observed; the intervals are as wide as its 95 % quantile says. Empty below the fewest observations.
std::vector<LevelEffect> level_effects(const std::vector<std::vector<double>>& values, std::uint64_t seed = 1);

}  // namespace dmrp::core
