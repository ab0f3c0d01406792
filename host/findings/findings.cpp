// SPDX-License-Identifier: MIT
#include "host/findings/findings.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "core/statistics/descriptive.hpp"
#include "host/results/world_name.hpp"

namespace dmrp::host {
namespace {

// Groups of indices that are joined in pairs.
class Joined {
 public:
  explicit Joined(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

  std::size_t first_of(std::size_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    const std::size_t first = std::min(first_of(a), first_of(b));
    parent_[std::max(first_of(a), first_of(b))] = first;
  }

 private:
  std::vector<std::size_t> parent_;
};

// Finds the index of a key, and gives new keys the next one.
template <class Key>
std::size_t index_of(std::map<Key, std::size_t>& indices, const Key& key) {
  return indices.try_emplace(key, indices.size()).first->second;
}

}  // namespace

CombinationLabels combination_of(const TrialRecord& trial) {
  return {trial.scenario, trial.robots, trial.global_planner, trial.local_controller, trial.pedestrian_model};
}

Observations observations_of(std::span<const TrialRecord> trials, Unit unit) {
  using InWorld = std::pair<std::size_t, std::string>;
  Observations found;
  std::map<std::string, std::size_t> worlds;
  std::map<InWorld, std::size_t> crowds;  // of a world: trials with one seed
  std::map<InWorld, std::size_t> tasks;
  std::vector<std::size_t> world_of_crowd;
  for (const TrialRecord& trial : trials) {
    const std::size_t world = index_of(worlds, world_name(trial));
    found.crowd_of_.push_back(index_of(crowds, {world, std::to_string(trial.seed)}));
    if (found.crowd_of_.back() == world_of_crowd.size()) world_of_crowd.push_back(world);
    // a trial that does not know its task has that of its number of robots, or of its crowd if tasks are drawn
    const std::string unknown = std::to_string(trial.robots) + (trial.task_is_drawn ? std::to_string(trial.seed) : "");
    found.task_of_.push_back(index_of(tasks, {world, trial.task.empty() ? " " + unknown : trial.task}));
    found.is_drawn_.push_back(trial.task_is_drawn);
    found.has_people_ |= !trial.pedestrian_model.empty();
  }
  Joined joined(world_of_crowd.size());
  std::map<std::size_t, std::size_t> first_with;  // the first crowd that met a task
  for (std::size_t i = 0; i < trials.size(); ++i)
    if ((trials[i].task_is_drawn && !trials[i].task.empty()) || unit == Unit::plan)
      joined.join(found.crowd_of_[i], first_with.try_emplace(found.task_of_[i], found.crowd_of_[i]).first->second);

  std::map<std::size_t, std::size_t> numbers;
  for (const std::size_t crowd : found.crowd_of_) {
    found.of_trial.push_back(index_of(numbers, joined.first_of(crowd)));
    if (found.of_trial.back() == found.world_of.size())
      found.world_of.push_back(static_cast<std::uint32_t>(world_of_crowd[crowd]));
  }
  found.resampling = core::Resampling(found.world_of, core::Scope::these_worlds);
  return found;
}

Met Observations::met_by(std::span<const std::size_t> trials) const {
  std::set<std::size_t> tasks, drawn, crowds;
  std::set<std::pair<std::size_t, std::size_t>> meetings;
  for (const std::size_t trial : trials) {
    tasks.insert(task_of_[trial]);
    crowds.insert(crowd_of_[trial]);
    meetings.insert({task_of_[trial], crowd_of_[trial]});
    if (is_drawn_[trial]) drawn.insert(task_of_[trial]);
  }
  const auto size = [](const auto& set) { return static_cast<std::uint32_t>(set.size()); };
  return {size(tasks), size(drawn), size(crowds), size(meetings), has_people_};
}

std::optional<Split> by_planner_and_controller(const TrialRecord& trial) {
  if (trial.robots == 0) return std::nullopt;
  return Split{{"", 0, trial.global_planner, trial.local_controller, ""},
               {trial.scenario, trial.robots, "", "", trial.pedestrian_model}};
}

std::optional<Split> by_planner(const TrialRecord& trial) {
  if (trial.robots == 0) return std::nullopt;
  return Split{{"", 0, trial.global_planner, "", ""}, {trial.scenario, trial.robots, "", "", ""}};
}

Findings make_findings(std::span<const TrialRecord> trials, const Observations& observations, const SplitTrial& split) {
  Findings findings;
  std::map<CombinationLabels, std::size_t> entries;
  std::map<std::pair<CombinationLabels, std::uint64_t>, std::size_t> situations;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (!has_result(trials[i])) continue;
    const std::optional<Split> labels = split(i);
    if (!labels) continue;
    const std::size_t entry = index_of(entries, labels->entry);
    const std::size_t situation = index_of(situations, {labels->cell, trials[i].seed});
    if (entry == findings.entries.size()) {
      findings.entries.push_back(labels->entry);
      findings.trials.emplace_back();
    }
    if (situation == findings.situations.size())
      findings.situations.push_back({labels->cell, trials[i].seed, observations.of_trial[i]});
    auto& of_entry = findings.trials[entry];
    of_entry.resize(std::max(of_entry.size(), situation + 1));
    of_entry[situation].push_back(i);
  }
  for (auto& of_entry : findings.trials) of_entry.resize(findings.situations.size());
  return findings;
}

JointValues means_of(TrialValue value) {
  return [value = std::move(value)](auto trials) -> std::optional<std::vector<double>> {
    std::vector<double> means;
    for (const std::span<const std::size_t> of_member : trials) {
      std::vector<double> values;
      for (const std::size_t trial : of_member)
        if (const auto found = value(trial)) values.push_back(*found);
      if (values.empty()) return std::nullopt;
      means.push_back(core::mean(values));
    }
    return means;
  };
}

std::vector<double> JointFindings::differences(std::size_t a, std::size_t b) const {
  std::vector<double> found;
  for (std::size_t task = 0; task < values[a].size(); ++task) found.push_back(values[b][task] - values[a][task]);
  return found;
}

JointFindings joint_findings(const Findings& findings, const Observations& observations,
                             std::span<const std::size_t> members, const JointValues& values) {
  std::vector<std::vector<std::vector<double>>> found(members.size());  // [member][task]
  for (auto& of_member : found) of_member.resize(observations.world_of.size());
  JointFindings joint;
  for (std::size_t i = 0; i < findings.situations.size(); ++i) {
    std::vector<std::span<const std::size_t>> trials;
    for (const std::size_t member : members)
      if (!findings.trials[member][i].empty()) trials.emplace_back(findings.trials[member][i]);
    if (trials.size() < members.size()) continue;
    const auto of_situation = values(trials);
    if (!of_situation) continue;
    ++joint.situations;
    for (std::size_t member = 0; member < members.size(); ++member)
      found[member][findings.situations[i].observation].push_back((*of_situation)[member]);
  }
  for (const auto& of_member : found) {
    std::vector<double>& means = joint.values.emplace_back();
    for (const std::vector<double>& of_task : of_member) means.push_back(core::mean(of_task));
  }
  return joint;
}

std::vector<double> observation_means(const Observations& observations, std::span<const std::size_t> trials,
                                      const TrialValue& value) {
  std::vector<std::vector<double>> by_task(observations.world_of.size());
  for (const std::size_t trial : trials)
    if (const auto found = value(trial)) by_task[observations.of_trial[trial]].push_back(*found);
  std::vector<double> means;
  for (const std::vector<double>& values : by_task) means.push_back(core::mean(values));
  return means;
}

}  // namespace dmrp::host
