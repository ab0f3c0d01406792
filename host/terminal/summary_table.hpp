// SPDX-License-Identifier: MIT
// summary_table.hpp: the table that a run prints at its end.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "host/results/summary.hpp"
#include "host/results/summary_layout.hpp"

namespace dmrp::host {

struct TableStyle {
  std::size_t width = 0;  // columns of the terminal; 0: as wide as need be
  bool ansi = false;      // bold for the best values of a column; else they are marked by an asterisk
};

// A row a combination, in groups of those that can be compared (same scenario, robots and people); the mean over
// trials, "–" where no trial has a value. Columns that don't fit go below, with the labels again.
std::string summary_table(const SummaryLayout& layout, std::span<const MetricColumn> metrics,
                          std::span<const CombinationSummary> summaries, const TableStyle& style);

}  // namespace dmrp::host
