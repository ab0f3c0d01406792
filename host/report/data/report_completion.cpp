// SPDX-License-Identifier: MIT
#include "host/report/data/report_completion.hpp"

#include <algorithm>

#include "host/report/data/report_values.hpp"

namespace dmrp::host {
namespace {

// One for each robot. The robots of a trial that a fault ended before it was measured did not arrive.
std::vector<core::TimeToEvent> robots_of(const TrialRecord& trial, const std::string& metric, double horizon_s) {
  std::vector<core::TimeToEvent> robots;
  for (const MetricValue& value : trial.values) {
    if (value.subject_kind != DMRP_SUBJECT_ROBOT || value.coordinate || value.metric != metric) continue;
    robots.push_back({value.value.value_or(horizon_s), value.value.has_value()});
  }
  if (robots.empty() && trial.outcome == trial_outcome::fault) robots.resize(trial.robots, {horizon_s, false});
  return robots;
}

// Nobody is censored before the horizon: the area under the curve is a mean.
core::MeanOfTasks restricted_mean(const Tasks& tasks, std::span<const std::size_t> trials,
                                  const std::vector<std::vector<core::TimeToEvent>>& by_trial, double horizon_s) {
  const auto mean_of = [&](std::size_t trial) -> std::optional<double> {
    if (by_trial[trial].empty()) return std::nullopt;
    double sum_s = 0.0;
    for (const core::TimeToEvent& robot : by_trial[trial]) sum_s += std::min(robot.time, horizon_s);
    return sum_s / static_cast<double>(by_trial[trial].size());
  };
  return core::mean_of_tasks(task_means(tasks, trials, mean_of), core::Interval{0.0, horizon_s}, tasks.resampling);
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
  std::vector<std::vector<core::TimeToEvent>> by_trial(frame.trials.size());
  for (std::size_t i = 0; i < frame.combinations.size(); ++i) {
    const double horizon_s = horizon_of(frame, facts, i);
    std::vector<std::size_t> trials;
    std::vector<core::TimeToEvent> robots;
    for (std::size_t trial = 0; trial < frame.trials.size(); ++trial) {
      if (frame.combination_of[trial] != i || !has_result(frame.trials[trial])) continue;
      trials.push_back(trial);
      by_trial[trial] = robots_of(frame.trials[trial], layout.completion, horizon_s);
      robots.insert(robots.end(), by_trial[trial].begin(), by_trial[trial].end());
    }
    if (robots.empty()) continue;
    const auto arrived = std::count_if(robots.begin(), robots.end(), [](const auto& robot) { return robot.happened; });
    found.push_back({i, static_cast<std::uint32_t>(robots.size()), horizon_s,
                     restricted_mean(frame.tasks, trials, by_trial, horizon_s),
                     static_cast<double>(arrived) / static_cast<double>(robots.size()), core::kaplan_meier(robots)});
  }
  return found;
}

}  // namespace dmrp::host
