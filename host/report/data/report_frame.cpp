// SPDX-License-Identifier: MIT
#include "host/report/data/report_frame.hpp"

#include <algorithm>

namespace dmrp::host {

std::optional<std::size_t> ReportFrame::metric(std::string_view name) const {
  const auto found =
      std::find_if(metrics.begin(), metrics.end(), [&](const auto& column) { return column.name == name; });
  if (found == metrics.end()) return std::nullopt;
  return static_cast<std::size_t>(found - metrics.begin());
}

std::size_t ReportFrame::combination(const CombinationLabels& labels) const {
  return static_cast<std::size_t>(std::find(combinations.begin(), combinations.end(), labels) - combinations.begin());
}

ReportFrame make_report_frame(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials) {
  ReportFrame frame{metrics, trials, {}, {}, system_values(metrics, trials), observations_of(trials)};
  for (const TrialRecord& trial : trials) {
    const CombinationLabels labels = combination_of(trial);
    frame.combination_of.push_back(frame.combination(labels));
    if (frame.combination_of.back() == frame.combinations.size()) frame.combinations.push_back(labels);
  }
  return frame;
}

}  // namespace dmrp::host
