// SPDX-License-Identifier: MIT
#include "host/ranking/contest.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "core/statistics/descriptive.hpp"
#include "host/results/world_name.hpp"

namespace dmrp::host {
namespace {

CombinationLabels cell_of(const TrialRecord& trial) {
  return {trial.scenario, trial.robots, "", "", trial.pedestrian_model};
}

CombinationLabels contestant_of(const TrialRecord& trial, Contestants contestants) {
  return {"", 0, trial.global_planner, contestants == Contestants::planners ? std::string() : trial.local_controller,
          ""};
}

std::size_t index_in(std::vector<CombinationLabels>& list, const CombinationLabels& labels) {
  const auto found = std::find(list.begin(), list.end(), labels);
  const auto index = static_cast<std::size_t>(found - list.begin());
  if (found == list.end()) list.push_back(labels);
  return index;
}

// Finds the situation of each trial, and the task of each situation.
class Situations {
 public:
  explicit Situations(Contest& contest) : contest_(contest) {}

  std::size_t of(const TrialRecord& trial) {
    const std::size_t cell = index_in(contest_.cells, cell_of(trial));
    const auto [found, added] = index_.try_emplace({cell, trial.seed}, contest_.situations.size());
    if (added) {
      contest_.situations.push_back({cell, trial.seed, 0});
      worlds_.push_back(world_name(trial));
      tasks_.emplace_back();
    }
    if (!trial.task.empty()) tasks_[found->second] = trial.task;
    return found->second;
  }

  void number_tasks() {
    std::map<std::pair<std::string, std::string>, std::size_t> numbers;
    for (std::size_t i = 0; i < tasks_.size(); ++i) {
      if (!tasks_[i].empty()) contest_.tasks_known = true;
      contest_.situations[i].task = numbers.try_emplace({worlds_[i], tasks_[i]}, numbers.size()).first->second;
    }
    contest_.tasks = numbers.size();
  }

 private:
  Contest& contest_;
  std::map<std::pair<std::size_t, std::uint64_t>, std::size_t> index_;
  std::vector<std::string> worlds_;  // by situation, as the next
  std::vector<std::string> tasks_;
};

bool met_all_cells(const Contest& contest, const std::vector<std::vector<std::size_t>>& trials) {
  std::set<std::size_t> cells;
  for (std::size_t i = 0; i < trials.size(); ++i)
    if (!trials[i].empty()) cells.insert(contest.situations[i].cell);
  return cells.size() == contest.cells.size();
}

}  // namespace

RobotValues robot_values(std::span<const TrialRecord> trials, const std::string& metric) {
  RobotValues values(trials.size());
  for (std::size_t i = 0; i < trials.size(); ++i) {
    values[i].resize(trials[i].robots);
    for (const MetricValue& value : trials[i].values)
      if (value.subject_kind == DMRP_SUBJECT_ROBOT && !value.coordinate && value.metric == metric && value.subject &&
          *value.subject < values[i].size())
        values[i][*value.subject] = value.value;
  }
  return values;
}

Contest make_contest(std::span<const TrialRecord> trials, Contestants contestants,
                     const std::function<bool(const CombinationLabels&)>& included) {
  Contest contest;
  Situations situations(contest);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const TrialRecord& trial = trials[i];
    if (trial.robots == 0 || trial.outcome == trial_outcome::skipped || !included(combination_of(trial))) continue;
    const std::size_t contestant = index_in(contest.contestants, contestant_of(trial, contestants));
    const std::size_t situation = situations.of(trial);
    contest.trials.resize(contest.contestants.size());
    contest.trials[contestant].resize(std::max(contest.trials[contestant].size(), situation + 1));
    contest.trials[contestant][situation].push_back(i);
  }
  situations.number_tasks();
  for (std::size_t i = contest.contestants.size(); i-- > 0;) {
    contest.trials[i].resize(contest.situations.size());
    if (met_all_cells(contest, contest.trials[i])) continue;
    contest.contestants.erase(contest.contestants.begin() + static_cast<std::ptrdiff_t>(i));
    contest.trials.erase(contest.trials.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return contest;
}

bool in_general(const Contest& contest) {
  return contest.tasks >= tasks_for_claims_in_general;
}

std::vector<double> paired_differences(const Contest& contest, std::size_t a, std::size_t b,
                                       const Difference& difference) {
  std::map<std::size_t, std::vector<double>> observations;
  for (std::size_t i = 0; i < contest.situations.size(); ++i) {
    if (contest.trials[a][i].empty() || contest.trials[b][i].empty()) continue;
    if (const auto found = difference(contest.trials[a][i], contest.trials[b][i]))
      observations[in_general(contest) ? contest.situations[i].task : i].push_back(*found);
  }
  std::vector<double> differences;
  for (const auto& [observation, values] : observations) differences.push_back(core::mean(values));
  return differences;
}

Difference difference_of(std::function<std::optional<double>(std::size_t trial)> value) {
  const auto mean_of = [value = std::move(value)](std::span<const std::size_t> trials) -> std::optional<double> {
    std::vector<double> values;
    for (const std::size_t trial : trials)
      if (const auto found = value(trial)) values.push_back(*found);
    if (values.empty()) return std::nullopt;
    return core::mean(values);
  };
  return [mean_of](std::span<const std::size_t> a, std::span<const std::size_t> b) -> std::optional<double> {
    const std::optional<double> of_a = mean_of(a);
    const std::optional<double> of_b = mean_of(b);
    if (!of_a || !of_b) return std::nullopt;
    return *of_b - *of_a;
  };
}

}  // namespace dmrp::host
