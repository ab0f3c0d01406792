// SPDX-License-Identifier: MIT
// thresholds_table.hpp: the levels that combinations pass half of the time, as CSV.
#pragma once

#include <span>
#include <string>

#include "host/ranking/graded_series.hpp"

namespace dmrp::host {

// A line a test and combination. `levels`: from the hardest to the easiest, with spaces between them. Thresholds and ends
// of intervals are levels, or inf and -inf where they lie beyond all levels of the test; `shown`: threshold_words.
std::string thresholds_table_csv(std::span<const GradedSeries> all);

}  // namespace dmrp::host
