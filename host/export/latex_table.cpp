// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

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
    for (std::size_t c = 0; c < per_span; ++c) {
      lines += " & " + escaped(table.spec.metrics[c].header);
      if (!table.units[c].empty()) lines += " (" + unit_words(table.units[c]) + ")";
    }
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

}  // namespace

std::string latex_table(const MeanTable& table) {
  if (table.rows.empty() || table.spec.metrics.empty()) return "";
  const std::size_t columns = table.rows.front().cells.size();
  return fmt::format(
      "\\begin{{table*}}\n\\centering\n\\caption{{{}}}\n\\label{{tab:{}}}\n\\begin{{tabular}}{{l{}}}\n\\toprule\n"
      "{}\\midrule\n{}\\bottomrule\n\\end{{tabular}}\n\\end{{table*}}\n",
      escaped(table_caption(table)), table.spec.id, std::string(columns, 'r'), head(table), body(table, columns));
}

}  // namespace dmrp::host
