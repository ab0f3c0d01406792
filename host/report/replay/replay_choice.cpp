// SPDX-License-Identifier: MIT
#include "host/report/replay/replay_choice.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <tuple>

namespace dmrp::host {
namespace {

using Group = std::vector<std::size_t>;  // trials of one combination, by id

auto labels(const TrialRecord& trial) {
  return std::tie(trial.scenario, trial.robots, trial.global_planner, trial.local_controller, trial.pedestrian_model);
}

// In order of first appearance.
std::vector<Group> combinations(std::span<const TrialRecord> trials) {
  std::vector<Group> groups;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (!has_result(trials[i])) continue;
    const auto found = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
      return labels(trials[group.front()]) == labels(trials[i]);
    });
    (found == groups.end() ? groups.emplace_back() : *found).push_back(i);
  }
  return groups;
}

bool higher_is_better(std::span<const MetricColumn> metrics, std::string_view name) {
  const auto found =
      std::find_if(metrics.begin(), metrics.end(), [name](const MetricColumn& metric) { return metric.name == name; });
  return found != metrics.end() && found->direction == DMRP_DIRECTION_HIGHER;
}

// Best first; empty if no metric of `rank_by` has a value.
Group ranked(std::span<const TrialRecord> trials, const Group& group, std::span<const MetricColumn> metrics,
             std::span<const std::string> rank_by) {
  for (const std::string& metric : rank_by) {
    Group defined;
    for (const std::size_t trial : group)
      if (system_value(trials[trial], metric)) defined.push_back(trial);
    if (defined.empty()) continue;
    const double sign = higher_is_better(metrics, metric) ? -1.0 : 1.0;
    std::stable_sort(defined.begin(), defined.end(), [&](std::size_t a, std::size_t b) {
      return sign * *system_value(trials[a], metric) < sign * *system_value(trials[b], metric);
    });
    return defined;
  }
  return {};
}

void add_by_outcome(std::span<const TrialRecord> trials, const std::vector<Group>& groups, std::string_view outcome,
                    const char* why, std::vector<ReplayCandidate>& candidates) {
  std::vector<Group> matching(groups.size());
  std::size_t rounds = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    std::copy_if(groups[g].begin(), groups[g].end(), std::back_inserter(matching[g]),
                 [&](std::size_t trial) { return trials[trial].outcome == outcome; });
    rounds = std::max(rounds, matching[g].size());
  }
  for (std::size_t round = 0; round < rounds; ++round)
    for (const Group& group : matching)
      if (round < group.size()) candidates.push_back({group[round], why});
}

}  // namespace

std::vector<ReplayCandidate> replay_candidates(std::span<const TrialRecord> trials,
                                               std::span<const MetricColumn> metrics,
                                               std::span<const std::string> rank_by,
                                               std::span<const std::uint64_t> asked) {
  std::vector<ReplayCandidate> candidates;
  for (const std::uint64_t id : asked)
    for (std::size_t i = 0; i < trials.size(); ++i)
      if (trials[i].id == id) candidates.push_back({i, "asked"});

  const std::vector<Group> groups = combinations(trials);
  std::vector<ReplayCandidate> worst;
  for (const Group& group : groups) {
    const Group best_first = ranked(trials, group, metrics, rank_by);
    if (best_first.empty()) continue;
    candidates.push_back({best_first[(best_first.size() - 1) / 2], "median"});
    worst.push_back({best_first.back(), "worst"});
  }
  candidates.insert(candidates.end(), worst.begin(), worst.end());
  add_by_outcome(trials, groups, trial_outcome::fault, "fault", candidates);
  add_by_outcome(trials, groups, trial_outcome::failed, "failure", candidates);
  return candidates;
}

}  // namespace dmrp::host
