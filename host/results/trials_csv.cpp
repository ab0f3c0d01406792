// SPDX-License-Identifier: MIT
#include "host/results/trials_csv.hpp"

#include "host/results/csv.hpp"
#include "host/results/system_values.hpp"

namespace dmrp::host {

std::string trials_csv(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials) {
  CsvWriter csv;
  for (const char* name :
       {"trial", "scenario", "robots", "global_planner", "local_controller", "pedestrian_model", "repetition", "seed",
        "outcome", "repeatable", "sim_time_s", "wall_time_s", "task", "task_is_drawn"})
    csv.field(name);
  const std::vector<std::string> swept = swept_columns(trials);
  for (const std::string& name : swept) csv.field(name);
  for (const MetricColumn& metric : metrics) csv.field(metric.name);
  csv.end_line();

  const SystemValues values = system_values(metrics, trials);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const TrialRecord& trial = trials[i];
    csv.field(trial.id).field(trial.scenario).field(trial.robots);
    csv.field(trial.global_planner).field(trial.local_controller).field(trial.pedestrian_model);
    csv.field(trial.repetition).field(trial.seed).field(trial.outcome).field(trial.repeatable ? 1 : 0);
    csv.field(trial.sim_time_s).field(trial.wall_time_s).field(trial.task).field(trial.task_is_drawn ? 1 : 0);
    for (const std::string& name : swept) csv.field(swept_value(trial.swept, name));
    for (const std::optional<double>& value : values[i]) csv.field(value);
    csv.end_line();
  }
  return csv.text();
}

}  // namespace dmrp::host
