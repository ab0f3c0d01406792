// SPDX-License-Identifier: MIT
// summary_table.hpp: the table at the end of a run.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "host/findings/summary.hpp"
#include "host/ranking/best_marks.hpp"
#include "host/results/summary_layout.hpp"

namespace dmrp::host {

struct TableStyle {
  std::size_t width = 0;  // columns of the terminal; 0: unlimited
  bool ansi = false;      // bold for marked values; else an asterisk
};

// One row for each combination, in groups that can be compared (same scenario, robots and pedestrian model). Cells are
// means over tasks, those of shares with their intervals from two tasks on (or medians of trials, by the layout); "–"
// if no trial has a value, with "(19/20)" if only some have one. Columns that do not fit follow below, with the labels
// repeated.
// `marks`: of planners and controllers (best_marks.hpp).
std::string summary_table(const SummaryLayout& layout, std::span<const MetricColumn> metrics,
                          std::span<const CombinationSummary> summaries, std::span<const BestMark> marks,
                          const TableStyle& style);

// The number of tasks, and what the headers and signs of that table stand for, in lines of at most style.width columns
// (0: one line).
std::string table_legend(const SummaryLayout& layout, std::span<const MetricColumn> metrics,
                         std::span<const CombinationSummary> summaries, const Met& met, std::span<const BestMark> marks,
                         const TableStyle& style);

}  // namespace dmrp::host
