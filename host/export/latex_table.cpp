// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <utility>
#include <vector>

#include "host/export/mean_table.hpp"

namespace dmrp::host {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\textbackslash{}";
    else if (c == '~' || c == '^')
      out += fmt::format("\\{}{{}}", c);
    else if (std::string("&%$#_{}").find(c) != std::string::npos)
      out += fmt::format("\\{}", c);
    else
      out += c;
  }
  return out;
}

// "m/s" stays, "m/s2" and "1/m2" get their exponents.
std::string unit_words(const std::string& unit) {
  std::string out;
  for (std::size_t i = 0; i < unit.size(); ++i) {
    const bool exponent = i > 0 && std::isalpha(static_cast<unsigned char>(unit[i - 1])) &&
                          std::isdigit(static_cast<unsigned char>(unit[i]));
    out += exponent ? fmt::format("$^{}$", unit[i]) : escaped(std::string(1, unit[i]));
  }
  return out;
}

std::string latex_number(double value, std::uint32_t decimals) {
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find_first_not_of("-0.") == std::string::npos && text.front() == '-') return text.substr(1);
  return text.front() == '-' ? "$-$" + text.substr(1) : text;
}

std::string latex_cell(const TableCell& cell, const SummaryTableColumn& column) {
  if (!cell.value) return "--";
  std::string text = latex_number(*cell.value, column.decimals);
  if (cell.spread) text += " $\\pm$ " + latex_number(*cell.spread, column.decimals);
  if (cell.interval) text += " " + interval_words(cell, column.decimals);
  if (cell.best) text = "\\textbf{" + text + "}";
  return cell.defined < cell.trials ? fmt::format("{}\\,({}/{})", text, cell.defined, cell.trials) : text;
}

std::string metric_head(const MeanTable& table, std::size_t metric) {
  const std::string& unit = table.units[metric];
  return escaped(table.spec.metrics[metric].header) + (unit.empty() ? "" : " (" + unit_words(unit) + ")");
}

std::string head(const MeanTable& table) {
  const std::size_t per_span = table.spec.metrics.size();
  std::string lines;
  if (!table.spans.empty()) {
    for (const std::string& span : table.spans)
      lines += fmt::format(" & \\multicolumn{{{}}}{{c}}{{{}}}", per_span, escaped(span));
    lines += " \\\\\n";
    for (std::size_t i = 0; i < table.spans.size(); ++i)
      lines += fmt::format("\\cmidrule(lr){{{}-{}}}", 2 + i * per_span, 1 + (i + 1) * per_span);
    lines += "\n";
  }
  for (std::size_t i = 0; i < std::max<std::size_t>(table.spans.size(), 1); ++i)
    for (std::size_t c = 0; c < per_span; ++c) lines += " & " + metric_head(table, c);
  return lines + " \\\\\n";
}

std::string body(const MeanTable& table, std::size_t columns) {
  const std::size_t per_span = table.spec.metrics.size();
  const bool grouped = table.rows.front().group != table.rows.back().group;
  std::string lines;
  const std::string* group = nullptr;
  for (const TableRow& row : table.rows) {
    if (grouped && (!group || *group != row.group)) {
      if (group) lines += "\\addlinespace\n";
      lines += fmt::format("\\multicolumn{{{}}}{{l}}{{\\emph{{{}}}}} \\\\\n", columns + 1, escaped(row.group));
      group = &row.group;
    }
    lines += escaped(row.name);
    for (std::size_t c = 0; c < row.cells.size(); ++c)
      lines += " & " + latex_cell(row.cells[c], table.spec.metrics[c % per_span]);
    lines += " \\\\\n";
  }
  return lines;
}

// A digit of \footnotesize is 4.25 pt wide, a page of two columns 470 pt (article) to 516 pt (IEEEtran).
constexpr std::size_t page_letters = 108;
constexpr std::size_t gap_letters = 3;  // between columns: 12 pt

// A command counts as a letter.
std::size_t letters_in(const std::string& latex) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < latex.size(); ++i) {
    const auto c = static_cast<unsigned char>(latex[i]);
    if (c == '\\') {
      ++count;
      for (++i; i + 1 < latex.size() && std::isalpha(static_cast<unsigned char>(latex[i])) &&
                std::isalpha(static_cast<unsigned char>(latex[i + 1]));)
        ++i;
    } else if (c != '{' && c != '}' && c != '$' && (c & 0xC0) != 0x80) {
      ++count;
    }
  }
  return count;
}

std::size_t label_letters(const MeanTable& table) {
  std::size_t most = 0;
  for (const TableRow& row : table.rows) most = std::max(most, letters_in(escaped(row.name)));
  return most;
}

std::size_t column_letters(const MeanTable& table, std::size_t column) {
  const std::size_t metric = column % table.spec.metrics.size();
  std::size_t most = letters_in(metric_head(table, metric));
  for (const TableRow& row : table.rows)
    most = std::max(most, letters_in(latex_cell(row.cells[column], table.spec.metrics[metric])));
  return most + gap_letters;
}

// The first and the end of each part, so that each has at most `room` letters, or one item.
std::vector<std::pair<std::size_t, std::size_t>> divided(const std::vector<std::size_t>& widths, std::size_t room) {
  std::vector<std::pair<std::size_t, std::size_t>> parts;
  std::size_t width = 0;
  for (std::size_t i = 0; i < widths.size(); ++i) {
    if (parts.empty() || width + widths[i] > room) {
      parts.emplace_back(i, i);
      width = 0;
    }
    width += widths[i];
    parts.back().second = i + 1;
  }
  return parts;
}

template <class Item>
std::vector<Item> slice(const std::vector<Item>& items, std::pair<std::size_t, std::size_t> range) {
  return {items.begin() + static_cast<std::ptrdiff_t>(range.first),
          items.begin() + static_cast<std::ptrdiff_t>(range.second)};
}

}  // namespace

std::string latex_table(const MeanTable& table) {
  if (table.rows.empty() || table.spec.metrics.empty()) return "";
  const std::size_t columns = table.rows.front().cells.size();
  return fmt::format(
      "\\begin{{table*}}\n\\centering\n\\footnotesize\n\\caption{{{}}}\n\\label{{tab:{}}}\n\\begin{{tabular}}{{l{}}}"
      "\n\\toprule\n"
      "{}\\midrule\n{}\\bottomrule\n\\end{{tabular}}\n\\end{{table*}}\n",
      escaped(table_caption(table)), table.spec.id, std::string(columns, 'r'), head(table), body(table, columns));
}

std::vector<MeanTable> latex_parts(const MeanTable& table) {
  if (table.rows.empty() || table.spec.metrics.empty()) return {};
  const std::size_t labels = label_letters(table);
  const std::size_t room = page_letters - std::min(labels, page_letters);
  const std::size_t per_span = table.spec.metrics.size();
  std::vector<std::size_t> of_spans(std::max<std::size_t>(table.spans.size(), 1));
  for (std::size_t s = 0; s < of_spans.size(); ++s) {
    for (std::size_t c = 0; c < per_span; ++c) of_spans[s] += column_letters(table, s * per_span + c);
    if (!table.spans.empty()) of_spans[s] = std::max(of_spans[s], letters_in(escaped(table.spans[s])) + gap_letters);
  }
  std::vector<MeanTable> parts;
  for (const auto& spans : divided(of_spans, room)) {
    std::vector<std::size_t> of_metrics(per_span);  // a part of several spans fits
    for (std::size_t c = 0; c < per_span && spans.second - spans.first == 1; ++c)
      of_metrics[c] = column_letters(table, spans.first * per_span + c);
    for (const auto& metrics : divided(of_metrics, room)) {
      MeanTable part = table;
      part.spec.metrics = slice(table.spec.metrics, metrics);
      part.units = slice(table.units, metrics);
      if (!table.spans.empty()) part.spans = slice(table.spans, spans);
      for (TableRow& row : part.rows) {
        std::vector<TableCell> cells;
        for (std::size_t s = spans.first; s < spans.second; ++s)
          for (std::size_t c = metrics.first; c < metrics.second; ++c) cells.push_back(row.cells[s * per_span + c]);
        row.cells = std::move(cells);
      }
      parts.push_back(std::move(part));
    }
  }
  for (std::size_t i = 0; i < parts.size() && parts.size() > 1; ++i) {
    parts[i].spec.title += fmt::format(", part {} of {}", i + 1, parts.size());
    if (i > 0) parts[i].spec.id += fmt::format("-{}", i + 1);
  }
  return parts;
}

}  // namespace dmrp::host
