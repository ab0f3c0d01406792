// SPDX-License-Identifier: MIT
// threshold_chart.hpp: the levels that combinations pass half of the time, a panel for each test, as an SVG document.
#pragma once

#include <span>
#include <string>

#include "host/ranking/graded_series.hpp"

namespace dmrp::host {

// Levels from easy on the left to hard on the right, evenly spaced; a dot at the threshold, a line for its interval. A
// triangle at the right end: even the hardest level is passed; a cross at the left end: not even the easiest.
// Combinations have one colour and one row in all panels. Needs at least one series.
std::string threshold_chart(std::span<const GradedSeries> series);

}  // namespace dmrp::host
