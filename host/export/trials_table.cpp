// SPDX-License-Identifier: MIT
#include "host/export/trials_table.hpp"

#include "host/results/csv.hpp"
#include "host/results/system_values.hpp"

namespace dmrp::host {

std::string trials_table_csv(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials,
                             const RunSettings& settings) {
  CsvWriter csv;
  for (const char* name : {"trial", "scenario", "robots", "global_planner", "local_controller", "pedestrian_model",
                           "repetition", "seed", "outcome", "repeatable"})
    csv.field(name);
  for (const std::string& name : settings.names()) csv.field(name);
  for (const MetricColumn& metric : metrics)
    csv.field(metric.unit.empty() || metric.unit == "1" ? metric.name : metric.name + " [" + metric.unit + "]");
  csv.end_line();

  const SystemValues values = system_values(metrics, trials);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const TrialRecord& trial = trials[i];
    csv.field(trial.id).field(trial.scenario).field(trial.robots);
    csv.field(trial.global_planner).field(trial.local_controller).field(trial.pedestrian_model);
    csv.field(trial.repetition).field(trial.seed).field(trial.outcome).field(trial.repeatable ? 1 : 0);
    for (const std::string& name : settings.names()) csv.field(settings.value(name, trial));
    for (const std::optional<double>& value : values[i]) csv.field(value);
    csv.end_line();
  }
  return csv.text();
}

}  // namespace dmrp::host
