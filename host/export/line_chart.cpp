// SPDX-License-Identifier: MIT
#include "host/export/line_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/svg.hpp>

namespace dmrp::host {
namespace {

constexpr double width = 640.0;
constexpr double plot_height = 300.0;
constexpr double left = 64.0;
constexpr double top = 16.0;
constexpr double right = 16.0;
constexpr double axis_height = 48.0;
constexpr double legend_row = 18.0;

struct Axis {
  double low = 0.0;
  double high = 1.0;
  double step = 0.2;
  double from = 0.0;  // in the picture
  double to = 1.0;

  double at(double value) const { return from + (value - low) / (high - low) * (to - from); }
};

// Ends at round numbers, with four to eight steps.
Axis round_axis(double low, double high, double from, double to) {
  if (!(high > low)) {
    low -= 0.5;
    high += 0.5;
  }
  const double rough = (high - low) / 5.0;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = power;
  for (const double factor : {2.0, 5.0, 10.0})
    if (step < rough * 0.8) step = factor * power;
  return {std::floor(low / step + 1e-9) * step, std::ceil(high / step - 1e-9) * step, step, from, to};
}

std::string tick_text(double value, double step) {
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  return text.find_first_not_of("-0.") == std::string::npos && text.front() == '-' ? text.substr(1) : text;
}

std::pair<Axis, Axis> axes_of(const LineChart& chart) {
  double x_low = INFINITY, x_high = -INFINITY, y_low = INFINITY, y_high = -INFINITY;
  for (const ChartLine& line : chart.lines)
    for (const ChartPoint& point : line.points) {
      x_low = std::min(x_low, point.x);
      x_high = std::max(x_high, point.x);
      for (const double y : {point.mean, point.interval.low, point.interval.high})
        if (!std::isnan(y)) {
          y_low = std::min(y_low, y);
          y_high = std::max(y_high, y);
        }
    }
  return {round_axis(x_low, x_high, left, width - right), round_axis(y_low, y_high, top + plot_height, top)};
}

std::string ticks(const Axis& x, const Axis& y) {
  std::string svg;
  const auto count = [](const Axis& axis) { return std::lround((axis.high - axis.low) / axis.step); };
  for (long i = 0; i <= count(y); ++i) {
    const double value = y.low + static_cast<double>(i) * y.step;
    svg += fmt::format("<path class=\"grid\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>", x.from, y.at(value), x.to);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", x.from - 6.0,
                       y.at(value) + 4.0, tick_text(value, y.step));
  }
  for (long i = 0; i <= count(x); ++i) {
    const double value = x.low + static_cast<double>(i) * x.step;
    svg += fmt::format("<path class=\"axis\" d=\"M{:.1f} {:.1f}v4\"/>", x.at(value), y.from);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n", x.at(value), y.from + 17.0,
                       tick_text(value, x.step));
  }
  return svg + fmt::format("<path class=\"axis\" d=\"M{:.1f} {:.1f}V{:.1f}H{:.1f}\"/>\n", x.from, y.to, y.from, x.to);
}

const char* dash_of(std::size_t index) {
  static constexpr const char* dashes[] = {"", "7 4", "2 3"};
  return dashes[index % 3];
}

std::string line_svg(const ChartLine& line, std::size_t index, const Axis& x, const Axis& y) {
  const std::string_view color = toolkit::series_color(index);
  std::string path;
  std::string svg =
      fmt::format("<g stroke=\"{}\" fill=\"{}\"><title>{}</title>", color, color, toolkit::escape_xml(line.name));
  for (const ChartPoint& point : line.points) {
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x.at(point.x), y.at(point.mean));
    if (!std::isnan(point.interval.low))
      svg += fmt::format("<path d=\"M{:.1f} {:.1f}V{:.1f}\"/>", x.at(point.x), y.at(point.interval.low),
                         y.at(point.interval.high));
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\"/>", x.at(point.x), y.at(point.mean));
  }
  return svg + fmt::format("<path class=\"line\" stroke-dasharray=\"{}\" d=\"{}\"/></g>\n", dash_of(index), path);
}

std::string legend(const LineChart& chart, double y_px) {
  std::string svg;
  for (std::size_t i = 0; i < chart.lines.size(); ++i) {
    const double row = y_px + static_cast<double>(i / 2) * legend_row;
    const double column = left + (i % 2 == 0 ? 0.0 : 0.5 * (width - left));
    svg += fmt::format("<path class=\"line\" stroke=\"{}\" stroke-dasharray=\"{}\" d=\"M{:.1f} {:.1f}h24\"/>",
                       toolkit::series_color(i), dash_of(i), column, row - 4.0);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", column + 30.0, row,
                       toolkit::escape_xml(chart.lines[i].name));
  }
  return svg;
}

}  // namespace

std::string svg_document(const LineChart& chart) {
  const bool named = chart.lines.size() > 1;
  const double legend_y = top + plot_height + axis_height + legend_row;
  const double legend_rows = named ? static_cast<double>((chart.lines.size() + 1) / 2) : 0.0;
  const auto [x, y] = axes_of(chart);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<style>.grid{{stroke:#ddd}}.axis{{stroke:#333;fill:none}}"
      ".line{{fill:none;stroke-width:2}}</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      width, legend_y + legend_rows * legend_row);
  svg += ticks(x, y);
  for (std::size_t i = 0; i < chart.lines.size(); ++i) svg += line_svg(chart.lines[i], i, x, y);
  svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n", 0.5 * (x.from + x.to),
                     y.from + 38.0, toolkit::escape_xml(chart.x_title));
  svg += fmt::format("<text transform=\"translate(16 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                     0.5 * (y.from + y.to), toolkit::escape_xml(chart.y_title));
  if (named) svg += legend(chart, legend_y);
  return svg + "</svg>\n";
}

}  // namespace dmrp::host
