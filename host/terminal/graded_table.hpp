// SPDX-License-Identifier: MIT
// graded_table.hpp: the thresholds of tests with levels, in lines for the terminal.
#pragma once

#include <span>
#include <string>

#include "host/ranking/graded_series.hpp"

namespace dmrp::host {

// A block for each series: its levels from hard to easy, then a line for each combination with its threshold and its
// success at every level.
std::string graded_table(std::span<const GradedSeries> series);

}  // namespace dmrp::host
