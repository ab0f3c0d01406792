// SPDX-License-Identifier: MIT
#include "host/results/arrivals_by_type.hpp"

#include <dmrp/descriptor.h>

#include <algorithm>

namespace dmrp::host {
namespace {

TypeArrivals& of_type(std::vector<TypeArrivals>& all, const std::string& type) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const TypeArrivals& one) { return one.type == type; });
  return found == all.end() ? all.emplace_back(TypeArrivals{type, 0, 0}) : *found;
}

// Null if unknown: a trial of one of several scenarios that differ in their types alone cannot be told apart.
const std::vector<std::string>* types_of(std::span<const ScenarioFacts> scenarios, const TrialRecord& trial) {
  const std::vector<std::string>* types = nullptr;
  for (const ScenarioFacts& scenario : scenarios) {
    if (scenario.name != trial.scenario || scenario.robots != trial.robots) continue;
    if (types && *types != scenario.robot_types) return nullptr;
    types = &scenario.robot_types;
  }
  return types;
}

}  // namespace

void count_arrivals(const std::string& arrived, std::span<const ScenarioFacts> scenarios, const TrialRecord& trial,
                    std::vector<TypeArrivals>& counts) {
  const std::vector<std::string>* types = types_of(scenarios, trial);
  if (!types) return;
  for (const MetricValue& value : trial.values) {
    if (value.metric != arrived || value.subject_kind != DMRP_SUBJECT_ROBOT || value.coordinate) continue;
    if (!value.subject || *value.subject >= types->size()) continue;
    TypeArrivals& arrivals = of_type(counts, (*types)[*value.subject]);
    ++arrivals.robots;
    if (value.value && *value.value == 1.0) ++arrivals.arrived;
  }
}

std::string arrivals_line(const std::string& arrived, std::span<const ScenarioFacts> scenarios,
                          std::span<const TrialRecord> trials) {
  std::vector<TypeArrivals> counts;
  for (const TrialRecord& trial : trials) count_arrivals(arrived, scenarios, trial, counts);
  if (counts.size() < 2) return "";
  std::string line;
  for (const TypeArrivals& one : counts) {
    if (!line.empty()) line += " · ";
    line += one.type + " " + std::to_string(one.arrived) + " of " + std::to_string(one.robots);
  }
  return line;
}

}  // namespace dmrp::host
