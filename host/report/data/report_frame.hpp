// SPDX-License-Identifier: MIT
// report_frame.hpp: the trials of a run, sorted out once for all parts of the report's data.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "host/results/summary.hpp"
#include "host/results/system_values.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

struct ReportFrame {
  std::span<const MetricColumn> metrics;
  std::span<const TrialRecord> trials;
  std::vector<CombinationLabels> combinations;  // in the order in which they first appear; of skipped trials too
  std::vector<std::size_t> combination_of;      // of each trial
  SystemValues values;                          // [trial][metric]

  // None where no such metric was measured.
  std::optional<std::size_t> metric(std::string_view name) const;
};

// The frame refers to both lists.
ReportFrame make_report_frame(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials);

}  // namespace dmrp::host
