// SPDX-License-Identifier: MIT
#include "host/export/trials_table.hpp"

#include <utility>

#include "host/results/csv.hpp"
#include "host/results/system_values.hpp"

namespace dmrp::host {

namespace {

using Text = std::string (*)(const TrialRecord&);
constexpr std::pair<const char*, Text> labels[] = {
    {"trial", [](const TrialRecord& trial) { return std::to_string(trial.id); }},
    {"scenario", [](const TrialRecord& trial) { return trial.scenario; }},
    {"robots", [](const TrialRecord& trial) { return std::to_string(trial.robots); }},
    {"global_planner", [](const TrialRecord& trial) { return trial.global_planner; }},
    {"local_controller", [](const TrialRecord& trial) { return trial.local_controller; }},
    {"pedestrian_model", [](const TrialRecord& trial) { return trial.pedestrian_model; }},
    {"repetition", [](const TrialRecord& trial) { return std::to_string(trial.repetition); }},
    {"seed", [](const TrialRecord& trial) { return std::to_string(trial.seed); }},
    {"outcome", [](const TrialRecord& trial) { return trial.outcome; }},
    {"repeatable", [](const TrialRecord& trial) { return std::string(trial.repeatable ? "1" : "0"); }}};

}  // namespace

std::vector<std::string> label_columns(const RunSettings& settings) {
  std::vector<std::string> columns;
  for (const auto& [name, text] : labels) columns.emplace_back(name);
  columns.insert(columns.end(), settings.names().begin(), settings.names().end());
  return columns;
}

std::string label_text(const std::string& column, const TrialRecord& trial, const RunSettings& settings) {
  for (const auto& [name, text] : labels)
    if (column == name) return text(trial);
  return settings.value(column, trial);
}

std::string trials_table_csv(std::span<const MetricColumn> metrics, std::span<const TrialRecord> trials,
                             const RunSettings& settings) {
  CsvWriter csv;
  const std::vector<std::string> columns = label_columns(settings);
  for (const std::string& column : columns) csv.field(column);
  for (const MetricColumn& metric : metrics)
    csv.field(metric.unit.empty() || metric.unit == "1" ? metric.name : metric.name + " [" + metric.unit + "]");
  csv.end_line();

  const SystemValues values = system_values(metrics, trials);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    for (const std::string& column : columns) csv.field(label_text(column, trials[i], settings));
    for (const std::optional<double>& value : values[i]) csv.field(value);
    csv.end_line();
  }
  return csv.text();
}

}  // namespace dmrp::host
