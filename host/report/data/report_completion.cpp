// SPDX-License-Identifier: MIT
#include "host/report/data/report_completion.hpp"

#include <algorithm>

#include "host/report/data/report_values.hpp"

namespace dmrp::host {
namespace {

// One for each robot. The robots of a trial that a fault ended before it was measured did not arrive.
void add_robots(const TrialRecord& trial, const std::string& metric, double horizon_s,
                std::vector<core::TimeToEvent>& robots) {
  bool measured = false;
  for (const MetricValue& value : trial.values) {
    if (value.subject_kind != DMRP_SUBJECT_ROBOT || value.coordinate || value.metric != metric) continue;
    robots.push_back({value.value.value_or(horizon_s), value.value.has_value(), trial.seed});
    measured = true;
  }
  if (!measured && trial.outcome == trial_outcome::fault)
    robots.insert(robots.end(), trial.robots, {horizon_s, false, trial.seed});
}

// The time limit, or the end of the longest trial if the manifest has none.
double horizon_of(const ReportFrame& frame, const ExperimentFacts& facts, std::size_t combination) {
  if (const auto limit_s = time_limit_s(facts, frame.combinations[combination])) return *limit_s;
  double longest_s = 0.0;
  for (std::size_t i = 0; i < frame.trials.size(); ++i)
    if (frame.combination_of[i] == combination) longest_s = std::max(longest_s, frame.trials[i].sim_time_s);
  return longest_s;
}

}  // namespace

std::vector<ArrivalTimes> arrival_times(const ReportFrame& frame, const ExperimentFacts& facts,
                                        const ReportLayout& layout) {
  std::vector<ArrivalTimes> found;
  if (!frame.metric(layout.completion)) return found;
  std::vector<std::vector<core::TimeToEvent>> robots_of(frame.combinations.size());
  std::vector<double> horizon_s(frame.combinations.size());
  for (std::size_t i = 0; i < frame.combinations.size(); ++i) horizon_s[i] = horizon_of(frame, facts, i);
  for (std::size_t i = 0; i < frame.trials.size(); ++i) {
    const std::size_t combination = frame.combination_of[i];
    if (frame.trials[i].outcome != trial_outcome::skipped)
      add_robots(frame.trials[i], layout.completion, horizon_s[combination], robots_of[combination]);
  }
  for (std::size_t i = 0; i < robots_of.size(); ++i) {
    const std::vector<core::TimeToEvent>& robots = robots_of[i];
    if (robots.empty()) continue;
    const auto arrived = std::count_if(robots.begin(), robots.end(), [](const auto& robot) { return robot.happened; });
    found.push_back({i, static_cast<std::uint32_t>(robots.size()), horizon_s[i],
                     core::restricted_mean(robots, horizon_s[i]), core::restricted_mean_interval(robots, horizon_s[i]),
                     static_cast<double>(arrived) / static_cast<double>(robots.size()), core::kaplan_meier(robots)});
  }
  return found;
}

}  // namespace dmrp::host
