// SPDX-License-Identifier: MIT
// report_frame.hpp: the trials of a run with indices of their combinations and values, shared by all parts of the data.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "host/findings/summary.hpp"
#include "host/results/system_values.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

struct ReportFrame {
  std::span<const MetricColumn> metrics;
  std::span<const TrialRecord> trials;
  std::vector<CombinationLabels> combinations;  // in order of first appearance, including those of skipped trials
  std::vector<std::size_t> combination_of;      // of each trial
  SystemValues values;                          // [trial][metric]
  Observations observations;

  std::size_t combination(const CombinationLabels& labels) const;  // its index

  // The index of a metric; none if it was not measured.
  std::optional<std::size_t> metric(std::string_view name) const;
};

// The frame keeps references to both lists.
ReportFrame make_report_frame(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials);

}  // namespace dmrp::host
