// SPDX-License-Identifier: MIT
#include "host/terminal/graded_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/terminal/display_width.hpp"

namespace dmrp::host {

std::string graded_table(std::span<const GradedSeries> all) {
  if (all.empty()) return "";
  std::size_t name_width = 0;
  std::size_t words_width = 0;
  for (const GradedSeries& series : all)
    for (const GradedResult& result : series.results) {
      name_width = std::max(name_width, display_width(combination_name(all, result)));
      words_width = std::max(words_width, display_width(threshold_words(series, result.estimate)));
    }
  std::string out;
  for (const GradedSeries& series : all) {
    out += fmt::format("  {} · {}{}{}\n", series.title, series.quantity, series.unit == "1" ? "" : ", " + series.unit,
                       tells_apart(series) ? "" : " · sanity only: no level has a mean in [0.2, 0.8]");
    out += fmt::format("    {}  {}", pad_right("", name_width), pad_right("passes half", words_width));
    for (const double level : series.levels) out += fmt::format("  {:>5}", fmt::format("{:.3g}", level));
    out += "\n";
    for (const GradedResult& result : series.results) {
      out += fmt::format("    {}  {}", pad_right(combination_name(all, result), name_width),
                         pad_right(threshold_words(series, result.estimate), words_width));
      for (const double mean : result.means)
        out += fmt::format("  {:>5}", std::isnan(mean) ? "–" : fmt::format("{:.2f}", mean));
      out += "\n";
    }
    out += "\n";
  }
  return out;
}

}  // namespace dmrp::host
