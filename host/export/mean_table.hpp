// SPDX-License-Identifier: MIT
// mean_table.hpp: means (or medians) of metrics by the labels of trials, as tables of papers have them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/statistics/descriptive.hpp"
#include "host/export/people_counts.hpp"
#include "host/findings/findings.hpp"
#include "host/ranking/best_marks.hpp"
#include "host/results/summary_layout.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

enum class Label { scenario, robots, people, global_planner, local_controller, pedestrian_model };

// "planner" and "global_planner" and so on; none if unknown.
std::optional<Label> label_named(const std::string& name);
inline constexpr const char* label_names = "scenario, robots, people, planner, controller, pedestrian_model";

// What a table shows. Trials that agree in the labels of rows and columns are averaged.
struct TableSpec {
  std::string id;     // for the LaTeX label
  std::string title;  // the caption
  std::vector<Label> rows;
  std::vector<Label> columns;               // each of their values has all metrics; may be empty
  std::vector<SummaryTableColumn> metrics;  // without those that were not measured
  PeopleCounts people{};                    // for Label::people
  std::string conditions{};                 // of the run, for the caption
};

struct TableCell {
  std::optional<double>
      value;  // the mean over observations, or the trials' median by the column; none: undefined or no trial
  std::optional<double> spread;
  std::optional<core::Interval> interval;  // of the mean, from two observations on
  double at_most = core::undefined;        // MetricSummary
  std::uint32_t defined = 0;
  std::uint32_t trials = 0;
  bool best = false;  // best_marks.hpp
};

struct TableRow {
  std::string group;  // scenario and robots, if rows have them
  std::string name;   // the other labels
  std::vector<TableCell> cells;
};

struct MeanTable {
  TableSpec spec;
  std::vector<std::string> units;  // by metric
  std::vector<std::string> spans;  // titles of `columns`; empty without
  std::vector<TableRow> rows;      // those of a group stand together
  bool solved_alone = false;       // by controller: over the tasks for which every planner of the row has a plan
  Met met{};                       // by all trials of the table
};

MeanTable make_mean_table(TableSpec spec, const SummaryLayout& layout, std::span<const MetricColumn> metrics,
                          std::span<const TrialRecord> trials);

// The title, and what the marks in the cells mean.
std::string table_caption(const MeanTable& table);

// "[0.21, 0.83]" of a cell with an interval, else "".
std::string interval_words(const TableCell& cell, std::uint32_t decimals);

// A table environment with booktabs, for \input.
std::string latex_table(const MeanTable& table);

// The table in parts as wide as a page with two columns at most, by spans, then by metrics. All have its rows.
std::vector<MeanTable> latex_parts(const MeanTable& table);

}  // namespace dmrp::host
