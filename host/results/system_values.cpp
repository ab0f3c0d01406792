// SPDX-License-Identifier: MIT
#include "host/results/system_values.hpp"

#include <map>
#include <string_view>

namespace dmrp::host {

SystemValues system_values(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials) {
  std::map<std::string_view, std::size_t> column_of;
  for (std::size_t i = 0; i < metrics.size(); ++i) column_of.emplace(metrics[i].name, i);
  SystemValues table(trials.size(), std::vector<std::optional<double>>(metrics.size()));
  for (std::size_t i = 0; i < trials.size(); ++i)
    for (const MetricValue& value : trials[i].values) {
      if (value.subject_kind != DMRP_SUBJECT_SYSTEM || value.coordinate) continue;
      if (const auto column = column_of.find(value.metric); column != column_of.end())
        table[i][column->second] = value.value;
    }
  return table;
}

}  // namespace dmrp::host
