// SPDX-License-Identifier: MIT
// paired_difference.hpp: what the differences of two entries on the same tasks say.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/statistics/mean_of_tasks.hpp"
#include "core/statistics/resampling.hpp"

namespace dmrp::host {

inline constexpr double significant = 0.05;

// Fewer tasks give no p.
inline constexpr std::size_t fewest_observations = 5;

enum class PairedTest { signed_rank, mean };  // core/statistics: signed_rank.hpp, or the interval of the mean

struct PairedDifference {
  core::MeanOfTasks over_tasks{};
  double p = core::undefined;       // of the test, two-sided; NaN below the fewest tasks, or if nothing differs
  double p_holm = core::undefined;  // over the comparisons that are made together: adjust_by_holm()
  bool equal = true;                // in every task
};
// `by_task`: NaN where undefined. `bounds`: of the values that differ.
PairedDifference paired_difference(std::span<const double> by_task, PairedTest test, const core::Bounds& bounds,
                                   const core::Resampling& resampling);

void adjust_by_holm(std::span<PairedDifference* const> family);

}  // namespace dmrp::host
