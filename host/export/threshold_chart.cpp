// SPDX-License-Identifier: MIT
#include "host/export/threshold_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <dmrp/toolkit/svg.hpp>
#include <vector>

namespace dmrp::host {
namespace {

constexpr std::size_t columns = 2;
constexpr double name_width = 118.0;
constexpr double axis_width = 270.0;
constexpr double gap = 26.0;     // between panels, and around all
constexpr double beyond = 14.0;  // of the axis at both ends, for what lies beyond the levels
constexpr double title_height = 22.0;
constexpr double bar_height = 15.0;
constexpr double ticks_height = 34.0;

// The combinations of all series, in order of first appearance.
std::vector<std::string> names_of(std::span<const GradedSeries> all) {
  std::vector<std::string> names;
  for (const GradedSeries& series : all)
    for (const GradedResult& result : series.results) {
      const std::string name = combination_name(all, result);
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  return names;
}

// A panel with its upper left corner, and where a level lies in it.
struct Panel {
  const GradedSeries& series;
  double left;
  double top;

  double axis_from() const { return left + name_width; }
  double axis_to() const { return axis_from() + axis_width; }

  // `i`: a position in the list of levels, which begins with the hardest.
  double at_position(double i) const {
    const auto last = static_cast<double>(std::max<std::size_t>(series.levels.size(), 2) - 1);
    return axis_to() - beyond - i / last * (axis_width - 2.0 * beyond);
  }

  double at(const core::Threshold& threshold) const {
    if (threshold.beyond_hardest) return axis_to();
    if (threshold.beyond_easiest) return axis_from();
    std::size_t next = 0;
    const auto is_harder = [&](double a, double b) { return series.harder_when_higher ? a > b : a < b; };
    while (next + 1 < series.levels.size() && is_harder(series.levels[next], threshold.level)) ++next;
    if (next == 0) return at_position(0.0);
    const double from = series.levels[next - 1];
    const double part = (threshold.level - from) / (series.levels[next] - from);
    return at_position(static_cast<double>(next - 1) + std::clamp(part, 0.0, 1.0));
  }
};

std::string mark(const core::Threshold& threshold, double x, double y) {
  if (threshold.beyond_hardest)
    return fmt::format("<path stroke=\"none\" d=\"M{:.1f} {:.1f}l9 4.5l-9 4.5z\"/>", x - 9.0, y - 4.5);
  if (threshold.beyond_easiest) return fmt::format("<path d=\"M{:.1f} {:.1f}l7 7m0 -7l-7 7\"/>", x, y - 3.5);
  return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"/>", x, y);
}

std::string row_svg(const Panel& panel, const GradedResult& result, const std::string& name, std::size_t index,
                    double y) {
  const std::string_view color = toolkit::series_color(index);
  const core::ThresholdEstimate& estimate = result.estimate;
  const std::string words = threshold_words(panel.series, estimate);
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text><g stroke=\"{}\" fill=\"{}\"><title>{}: {}</title>"
      "<path class=\"interval\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>{}</g>\n",
      panel.axis_from() - 8.0, y + 4.0, toolkit::escape_xml(name), color, color, toolkit::escape_xml(name),
      toolkit::escape_xml(words), panel.at(estimate.low), y, panel.at(estimate.high),
      mark(estimate.threshold, panel.at(estimate.threshold), y));
}

std::string panel_svg(const Panel& panel, std::span<const GradedSeries> all, const std::vector<std::string>& names) {
  const GradedSeries& series = panel.series;
  const double rows_top = panel.top + title_height;
  const double rows_end = rows_top + static_cast<double>(names.size()) * bar_height;
  std::string svg = fmt::format("<text class=\"title\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", panel.left,
                                panel.top + 12.0, toolkit::escape_xml(series.title));
  for (std::size_t i = 0; i < series.levels.size(); ++i) {
    const double x = panel.at_position(static_cast<double>(i));
    svg += fmt::format(
        "<path class=\"grid\" d=\"M{:.1f} {:.1f}V{:.1f}\"/><text x=\"{:.1f}\" y=\"{:.1f}\" "
        "text-anchor=\"middle\">{:.3g}</text>\n",
        x, rows_top, rows_end, x, rows_end + 13.0, series.levels[i]);
  }
  const std::string unit = series.unit == "1" ? "" : ", " + series.unit;
  svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", panel.axis_to(),
                     rows_end + 27.0, toolkit::escape_xml(series.quantity + unit));
  for (const GradedResult& result : series.results) {
    const std::string name = combination_name(all, result);
    const auto index = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    svg += row_svg(panel, result, name, index, rows_top + (static_cast<double>(index) + 0.5) * bar_height);
  }
  return svg;
}

}  // namespace

std::string threshold_chart(std::span<const GradedSeries> all) {
  const std::vector<std::string> names = names_of(all);
  const double panel_width = name_width + axis_width;
  const double panel_height = title_height + static_cast<double>(names.size()) * bar_height + ticks_height;
  const std::size_t rows = (all.size() + columns - 1) / columns;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"sans-serif\" "
      "font-size=\"11\">\n<style>.grid{{stroke:#ddd}}.title{{font-weight:bold;font-size:12px}}"
      ".interval{{stroke-width:2}}</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      gap + static_cast<double>(columns) * (panel_width + gap), gap + static_cast<double>(rows) * (panel_height + gap));
  for (std::size_t i = 0; i < all.size(); ++i)
    svg += panel_svg({all[i], gap + static_cast<double>(i % columns) * (panel_width + gap),
                      gap + static_cast<double>(i / columns) * (panel_height + gap)},
                     all, names);
  return svg + "</svg>\n";
}

}  // namespace dmrp::host
