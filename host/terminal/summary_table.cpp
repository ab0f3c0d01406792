// SPDX-License-Identifier: MIT
#include "host/terminal/summary_table.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "host/terminal/display_width.hpp"
#include "host/terminal/wrapped_text.hpp"

namespace dmrp::host {
namespace {

constexpr std::size_t indent = 2;
constexpr std::size_t gap = 3;
constexpr const char* undefined_cell = "–";
constexpr const char* bold = "\x1b[1m";
constexpr const char* plain = "\x1b[0m";

struct Cell {
  std::string text;
  std::string note;  // behind the text
  bool best = false;
};

struct Column {
  std::string header;
  std::vector<Cell> cells;  // one for each row
  std::size_t width = 0;
};

struct Row {
  const CombinationSummary* summary;
  std::string label;
  std::string group;  // heading of its group
};

std::string fixed(double value, std::uint32_t decimals) {
  std::array<char, 400> buffer;  // the largest double has 309 digits before the point
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed,
                                    static_cast<int>(decimals));
  const std::string text(buffer.data(), result.ptr);
  // zero has no sign
  return text.front() == '-' && text.find_first_not_of("-0.") == std::string::npos ? text.substr(1) : text;
}

std::optional<std::size_t> index_of(std::span<const MetricColumn> metrics, const std::string& name) {
  for (std::size_t i = 0; i < metrics.size(); ++i)
    if (metrics[i].name == name) return i;
  return std::nullopt;
}

std::string group_of(const CombinationLabels& combination, bool several_models) {
  std::string group = combination.scenario + separator +
                      (combination.robots == 0 ? "no" : std::to_string(combination.robots)) +
                      (combination.robots == 1 ? " robot" : " robots");
  if (several_models)
    group += separator + (combination.pedestrian_model.empty() ? "no people" : combination.pedestrian_model);
  return group;
}

std::string label_of(const CombinationLabels& combination) {
  if (combination.robots > 0) return combination.global_planner + " + " + combination.local_controller;
  return combination.pedestrian_model.empty() ? "recorded people" : combination.pedestrian_model;
}

// Rows that can be compared are adjacent, regardless of the order of trials.
std::vector<Row> make_rows(std::span<const CombinationSummary> summaries) {
  const bool several_models = std::any_of(summaries.begin(), summaries.end(), [&](const CombinationSummary& summary) {
    return summary.combination.pedestrian_model != summaries.front().combination.pedestrian_model;
  });
  std::vector<std::vector<Row>> groups;
  for (const CombinationSummary& summary : summaries) {
    const CombinationLabels& combination = summary.combination;
    Row row{&summary, label_of(combination), group_of(combination, several_models)};
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const std::vector<Row>& rows) { return rows.front().group == row.group; });
    if (group == groups.end()) group = groups.emplace(groups.end());
    group->push_back(std::move(row));
  }
  std::vector<Row> rows;
  for (const std::vector<Row>& group : groups) rows.insert(rows.end(), group.begin(), group.end());
  return rows;
}

bool is_partly_defined(const CombinationSummary& summary, std::size_t metric) {
  return summary.metrics[metric].defined > 0 && summary.metrics[metric].defined < summary.trials;
}

// `share`: intervals stand beside the means.
Column make_column(const SummaryTableColumn& layout, std::span<const MetricColumn> metrics, std::size_t metric,
                   bool share, const std::vector<Row>& rows, std::span<const BestMark> marks) {
  Column column;
  const std::string& unit = metrics[metric].unit;
  column.header = unit.empty() || unit == "1" ? layout.header : layout.header + " " + unit;
  const std::optional<std::size_t> spread = index_of(metrics, layout.spread);

  for (const Row& row : rows) {
    const MetricSummary& summary = row.summary->metrics[metric];
    const double shown = layout.median ? summary.median : summary.mean;
    Cell cell{std::isnan(shown) ? undefined_cell : fixed(shown, layout.decimals), "", false};
    if (!std::isnan(shown) && spread && !std::isnan(row.summary->metrics[*spread].mean))
      cell.text += " ±" + fixed(row.summary->metrics[*spread].mean, layout.decimals);
    if (share && summary.n > 1)
      cell.text += " [" + fixed(summary.interval.low, layout.decimals) + ", " +
                   fixed(summary.interval.high, layout.decimals) + "]";
    if (is_partly_defined(*row.summary, metric))
      cell.note = " (" + std::to_string(summary.defined) + "/" + std::to_string(row.summary->trials) + ")";
    cell.best = std::find(marks.begin(), marks.end(), BestMark{row.summary->combination, layout.metric}) != marks.end();
    column.cells.push_back(std::move(cell));
  }
  return column;
}

void set_width(Column& column, const TableStyle& style) {
  const bool marked =
      !style.ansi && std::any_of(column.cells.begin(), column.cells.end(), [](const Cell& cell) { return cell.best; });
  std::size_t note_width = 0;
  for (const Cell& cell : column.cells) note_width = std::max(note_width, cell.note.size());
  column.width = display_width(column.header);
  for (Cell& cell : column.cells) {
    cell.text += pad_right(cell.note, note_width);
    if (marked) cell.text += cell.best ? "*" : " ";
    column.width = std::max(column.width, display_width(cell.text));
  }
}

std::string print_cell(const Cell& cell, const Column& column, const TableStyle& style) {
  const std::string padded = pad_left(cell.text, column.width);
  return style.ansi && cell.best ? bold + padded + plain : padded;
}

std::string without_trailing_spaces(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

// Prints the columns with labels and groups.
std::string print_block(const std::vector<Row>& rows, std::span<const Column> columns, std::size_t label_width,
                        bool with_groups, const TableStyle& style) {
  std::string text;
  std::string line(indent + label_width, ' ');
  for (const Column& column : columns) line += std::string(gap, ' ') + pad_left(column.header, column.width);
  text += without_trailing_spaces(line) + "\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (with_groups && (i == 0 || rows[i].group != rows[i - 1].group))
      text += std::string(indent, ' ') + rows[i].group + "\n";
    line = std::string(indent, ' ') + pad_right((with_groups ? "  " : "") + rows[i].label, label_width);
    for (const Column& column : columns) line += std::string(gap, ' ') + print_cell(column.cells[i], column, style);
    text += without_trailing_spaces(line) + "\n";
  }
  return text;
}

// The number of columns from `begin` that fit in the width, at least one.
std::size_t columns_that_fit(std::span<const Column> columns, std::size_t begin, std::size_t label_width,
                             const TableStyle& style) {
  std::size_t width = indent + label_width;
  std::size_t end = begin;
  while (end < columns.size()) {
    width += gap + columns[end].width;
    if (style.width != 0 && width > style.width && end > begin) break;
    ++end;
  }
  return end - begin;
}

// "on cells of {cell_size}" with the means of that metric in all combinations: "on cells of 0.05, 1 m".
std::string with_values(const std::string& legend, std::span<const MetricColumn> metrics,
                        std::span<const CombinationSummary> summaries) {
  const std::size_t begin = legend.find('{'), end = legend.find('}');
  if (begin == std::string::npos || end == std::string::npos) return legend;
  const std::optional<std::size_t> metric = index_of(metrics, legend.substr(begin + 1, end - begin - 1));
  std::set<double> values;
  for (const CombinationSummary& summary : summaries)
    if (metric && !std::isnan(summary.metrics[*metric].mean)) values.insert(summary.metrics[*metric].mean);
  const std::string shown =
      values.empty() ? "?" : fmt::format("{:.3g} {}", fmt::join(values, ", "), metrics[*metric].unit);
  return legend.substr(0, begin) + shown + legend.substr(end + 1);
}

}  // namespace

std::string summary_table(const SummaryLayout& layout, std::span<const MetricColumn> metrics,
                          std::span<const CombinationSummary> summaries, std::span<const BestMark> marks,
                          const TableStyle& style) {
  if (summaries.empty()) return {};
  const std::vector<Row> rows = make_rows(summaries);
  const bool with_groups = rows.front().group != rows.back().group;
  std::size_t label_width = 0;
  for (const Row& row : rows) label_width = std::max(label_width, display_width(row.label) + (with_groups ? 2 : 0));

  std::vector<Column> columns;
  for (const SummaryTableColumn& column : layout.columns) {
    const std::optional<std::size_t> metric = index_of(metrics, column.metric);
    if (!metric) continue;
    const bool share = std::find(layout.counts_failures.begin(), layout.counts_failures.end(), column.metric) !=
                       layout.counts_failures.end();
    columns.push_back(make_column(column, metrics, *metric, share, rows, marks));
    set_width(columns.back(), style);
  }

  std::string text;
  std::size_t begin = 0;
  do {
    const std::size_t count = columns_that_fit(columns, begin, label_width, style);
    if (begin > 0) text += "\n";
    text += print_block(rows, std::span<const Column>(columns).subspan(begin, count), label_width, with_groups, style);
    begin += count;
  } while (begin < columns.size());
  return text;
}

std::string table_legend(const SummaryLayout& layout, std::span<const MetricColumn> metrics,
                         std::span<const CombinationSummary> summaries, const Met& met, std::span<const BestMark> marks,
                         const TableStyle& style) {
  std::vector<std::string> parts = {"means over " + met_words(met)};
  bool spread = false;
  bool marked = false;
  bool partly = false;
  for (const SummaryTableColumn& column : layout.columns) {
    const std::optional<std::size_t> metric = index_of(metrics, column.metric);
    if (!metric) continue;
    partly = partly || std::any_of(summaries.begin(), summaries.end(),
                                   [&](const CombinationSummary& one) { return is_partly_defined(one, *metric); });
    if (!column.legend.empty()) parts.push_back(column.header + ": " + with_values(column.legend, metrics, summaries));
    spread = spread || index_of(metrics, column.spread);
    marked = marked || std::any_of(marks.begin(), marks.end(),
                                   [&](const BestMark& mark) { return mark.metric == column.metric; });
  }
  if (partly) parts.push_back("(1/3): 1 of 3 trials has the value");
  if (spread) parts.push_back("±: deviation over time");
  if (marked) parts.push_back(std::string(style.ansi ? "bold" : "*") + ": better than all others");
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : separator) + part;
  return text.empty() ? text : wrapped_text(text, style.width, std::string(indent, ' '));
}

}  // namespace dmrp::host
