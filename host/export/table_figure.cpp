// SPDX-License-Identifier: MIT
#include "host/export/table_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <dmrp/toolkit/svg.hpp>
#include <string_view>
#include <vector>

namespace dmrp::host {
namespace {

// Pixels.
constexpr double margin = 14.0;
constexpr double font_size = 12.0;
constexpr double letter_width = 0.6 * font_size;  // of a wide sans-serif: the reader's font is not known here
constexpr double column_gap = 18.0;
constexpr double row_height = 19.0;
constexpr double caption_height = 16.0;
constexpr double group_indent = 12.0;

std::size_t letters_in(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

double width_of(std::string_view text) {
  return static_cast<double>(letters_in(text)) * letter_width;
}

std::string number(double value, std::uint32_t decimals) {
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.front() != '-') return text;
  return text.find_first_not_of("-0.") == std::string::npos ? text.substr(1) : "\u2212" + text.substr(1);
}

std::string cell_words(const TableCell& cell, const SummaryTableColumn& column) {
  if (!cell.value) return "\u2013";
  std::string text = number(*cell.value, column.decimals);
  if (cell.spread) text += " \u00b1 " + number(*cell.spread, column.decimals);
  if (cell.interval) text += " " + interval_words(cell, column.decimals);
  return cell.defined < cell.trials ? fmt::format("{} ({}/{})", text, cell.defined, cell.trials) : text;
}

// Where the columns of the picture end, and how far down it is drawn.
class Sheet {
 public:
  explicit Sheet(const MeanTable& table) : table_(table), grouped_(has_groups(table)) {
    double right = margin;
    for (const TableRow& row : table.rows)
      right = std::max(right, margin + (grouped_ ? group_indent : 0.0) + width_of(row.name));
    for (std::size_t c = 0; c < columns(); ++c) {
      double widest = std::max(width_of(column(c).header), width_of(unit(c)));
      for (const TableRow& row : table.rows) widest = std::max(widest, width_of(cell_words(row.cells[c], column(c))));
      begins_.push_back(right + column_gap);
      right = begins_.back() + std::max(widest, span_width(c));
      ends_.push_back(right);
    }
    width_ = right + margin;
  }

  std::string document() {
    draw_head();
    draw_rows();
    draw_caption();
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
        "{1:.0f}\" font-family=\"sans-serif\" font-size=\"{2:.0f}\">\n<style>.rule{{stroke:#222;fill:none}}"
        ".thin{{stroke-width:0.5}}.best{{font-weight:bold}}.group{{font-style:italic}}.unit{{fill:#666;font-size:10px}}"
        ".caption{{fill:#444;font-size:11px}}</style>\n<rect width=\"100%\" height=\"100%\" "
        "fill=\"#fff\"/>\n{3}</svg>\n",
        width_, y_ + margin, font_size, svg_);
  }

 private:
  static bool has_groups(const MeanTable& table) { return table.rows.front().group != table.rows.back().group; }

  std::size_t columns() const { return table_.rows.front().cells.size(); }
  std::size_t per_span() const { return table_.spec.metrics.size(); }
  const SummaryTableColumn& column(std::size_t c) const { return table_.spec.metrics[c % per_span()]; }
  const std::string& unit(std::size_t c) const { return table_.units[c % per_span()]; }

  // What a column needs so that the title above its span fits.
  double span_width(std::size_t c) const {
    if (table_.spans.empty()) return 0.0;
    const double all = width_of(table_.spans[c / per_span()]) - static_cast<double>(per_span() - 1) * column_gap;
    return all / static_cast<double>(per_span());
  }

  void text(double x, const char* anchor, const char* look, std::string_view words) {
    svg_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" class=\"{}\">{}</text>\n", x, y_ - 5.0,
                        anchor, look, toolkit::escape_xml(words));
  }

  void rule(const char* look, double from, double to) {
    svg_ += fmt::format("<path class=\"rule {}\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>\n", look, from, y_, to);
  }

  void draw_head() {
    rule("", margin, width_ - margin);
    for (std::size_t s = 0; s < table_.spans.size(); ++s) {
      if (s == 0) y_ += row_height;
      const double from = begins_[s * per_span()];
      const double to = ends_[(s + 1) * per_span() - 1];
      text(0.5 * (from + to), "middle", "", table_.spans[s]);
      rule("thin", from, to);
    }
    y_ += row_height;
    for (std::size_t c = 0; c < columns(); ++c) text(ends_[c], "end", "", column(c).header);
    y_ += 0.75 * row_height;
    for (std::size_t c = 0; c < columns(); ++c) text(ends_[c], "end", "unit", unit(c));
    rule("thin", margin, width_ - margin);
  }

  void draw_rows() {
    const std::string* group = nullptr;
    for (const TableRow& row : table_.rows) {
      if (grouped_ && (!group || *group != row.group)) {
        y_ += group ? 1.25 * row_height : row_height;
        text(margin, "start", "group", row.group);
        group = &row.group;
      }
      y_ += row_height;
      text(margin + (grouped_ ? group_indent : 0.0), "start", "", row.name);
      for (std::size_t c = 0; c < columns(); ++c)
        text(ends_[c], "end", row.cells[c].best ? "best" : "", cell_words(row.cells[c], column(c)));
    }
    y_ += 2.0;
    rule("", margin, width_ - margin);
  }

  void draw_caption() {
    const auto most = static_cast<std::size_t>((width_ - 2.0 * margin) / letter_width);
    std::string line;
    const auto put = [&] {
      y_ += caption_height;
      text(margin, "start", "caption", line);
      line.clear();
    };
    y_ += 6.0;
    const std::string words = table_caption(table_);
    for (std::size_t at = 0; at < words.size();) {
      const std::size_t end = std::min(words.find(' ', at), words.size());
      const std::string word = words.substr(at, end - at);
      if (!line.empty() && letters_in(line) + 1 + letters_in(word) > most) put();
      line += (line.empty() ? "" : " ") + word;
      at = end + 1;
    }
    if (!line.empty()) put();
  }

  const MeanTable& table_;
  const bool grouped_;
  std::vector<double> begins_;  // the edges of each column
  std::vector<double> ends_;
  double width_ = 0.0;
  double y_ = margin;
  std::string svg_;
};

}  // namespace

std::string table_figure(const MeanTable& table) {
  return Sheet(table).document();
}

}  // namespace dmrp::host
