// SPDX-License-Identifier: MIT
#include "host/report/data/report_values.hpp"

namespace dmrp::host {

std::optional<double> time_limit_s(const ExperimentFacts& facts, const CombinationLabels& combination) {
  for (const ScenarioFacts& scenario : facts.scenarios)
    if (scenario.name == combination.scenario && scenario.robots == combination.robots) return scenario.time_limit_s;
  return std::nullopt;
}

std::optional<double> counted_value(const ReportFrame& frame, const ExperimentFacts& facts, const CountedValue& rule,
                                    std::size_t trial) {
  const TrialRecord& record = frame.trials[trial];
  if (!has_result(record)) return std::nullopt;
  if (rule.successes_only && record.outcome != trial_outcome::succeeded) return std::nullopt;
  if (const std::optional<double>& value = frame.values[trial][rule.metric]) return value;
  if (rule.counts_failures && record.outcome == trial_outcome::fault) return 0.0;
  if (rule.censored && record.robots > 0) return time_limit_s(facts, frame.combinations[frame.combination_of[trial]]);
  return std::nullopt;
}

}  // namespace dmrp::host
