// SPDX-License-Identifier: MIT
#include "host/export/thresholds_table.hpp"

#include <limits>

#include "host/results/csv.hpp"

namespace dmrp::host {
namespace {

double level_of(const GradedSeries& series, const core::Threshold& threshold) {
  if (!threshold.beyond_hardest && !threshold.beyond_easiest) return threshold.level;
  const bool above = threshold.beyond_hardest == series.harder_when_higher;
  return above ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
}

std::string levels_of(const GradedSeries& series) {
  std::string levels;
  for (const double level : series.levels) levels += (levels.empty() ? "" : " ") + shortest_number(level);
  return levels;
}

}  // namespace

std::string thresholds_table_csv(std::span<const GradedSeries> all) {
  CsvWriter csv;
  for (const char* name : {"series", "title", "quantity", "unit", "harder", "levels", "global_planner",
                           "local_controller", "pedestrian_model", "threshold", "ci_low", "ci_high", "shown"})
    csv.field(name);
  csv.end_line();
  for (const GradedSeries& series : all)
    for (const GradedResult& result : series.results) {
      const core::ThresholdEstimate& estimate = result.estimate;
      const bool higher = series.harder_when_higher;
      csv.field(series.name).field(series.title).field(series.quantity).field(series.unit);
      csv.field(higher ? "higher" : "lower").field(levels_of(series));
      csv.field(result.global_planner).field(result.local_controller).field(result.pedestrian_model);
      csv.field(level_of(series, estimate.threshold));
      csv.field(level_of(series, higher ? estimate.high : estimate.low));
      csv.field(level_of(series, higher ? estimate.low : estimate.high));
      csv.field(threshold_words(series, estimate)).end_line();
    }
  return csv.text();
}

}  // namespace dmrp::host
