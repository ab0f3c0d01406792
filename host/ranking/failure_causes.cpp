// SPDX-License-Identifier: MIT
#include "host/ranking/failure_causes.hpp"

#include <algorithm>

namespace dmrp::host {
namespace {

void count(std::vector<FailureCause>& causes, const std::string& cause, std::uint32_t robots, std::uint64_t trial) {
  auto found = std::find_if(causes.begin(), causes.end(), [&](const FailureCause& one) { return one.cause == cause; });
  if (found == causes.end()) found = causes.insert(causes.end(), {cause, 0, {}});
  found->robots += robots;
  if (found->trials.empty() || found->trials.back() != trial) found->trials.push_back(trial);
}

void sort_by_frequency(std::vector<FailureCause>& causes) {
  std::stable_sort(causes.begin(), causes.end(),
                   [](const FailureCause& a, const FailureCause& b) { return a.robots > b.robots; });
}

// "robot 3 failed: deadlock": the cause stands behind the colon.
std::string cause_of(const MetricEvent& event) {
  const std::size_t colon = event.text.find(": ");
  return colon == std::string::npos ? event.text : event.text.substr(colon + 2);
}

// The robots that have this value of a metric.
std::vector<std::uint64_t> robots_with(const TrialRecord& trial, const std::string& metric, double wanted) {
  std::vector<std::uint64_t> robots;
  for (const MetricValue& value : trial.values)
    if (value.subject_kind == DMRP_SUBJECT_ROBOT && !value.coordinate && value.metric == metric && value.subject &&
        value.value == wanted)
      robots.push_back(*value.subject);
  std::sort(robots.begin(), robots.end());
  return robots;
}

void add_trial(CombinationFailures& failures, const SummaryLayout& layout, const TrialRecord& trial) {
  failures.robots += trial.robots;
  if (trial.outcome == trial_outcome::fault) return count(failures.causes, "fault", trial.robots, trial.id);
  for (const MetricEvent& event : trial.events)
    if (event.metric == layout.arrived) count(failures.causes, cause_of(event), 1, trial.id);
  if (layout.answer.shares.empty()) return;
  const auto arrived = robots_with(trial, layout.arrived, 1.0);
  for (const std::uint64_t robot : robots_with(trial, layout.answer.shares.front(), 0.0))
    if (std::binary_search(arrived.begin(), arrived.end(), robot)) {
      ++failures.contact.robots;
      if (failures.contact.trials.empty() || failures.contact.trials.back() != trial.id)
        failures.contact.trials.push_back(trial.id);
    }
}

}  // namespace

std::vector<CombinationFailures> failure_causes(const SummaryLayout& layout, std::span<const TrialRecord> trials) {
  std::vector<CombinationFailures> failures;
  for (const TrialRecord& trial : trials) {
    if (trial.robots == 0 || trial.outcome == trial_outcome::skipped) continue;
    const CombinationLabels labels = combination_of(trial);
    auto found = std::find_if(failures.begin(), failures.end(),
                              [&](const CombinationFailures& one) { return one.combination == labels; });
    if (found == failures.end()) found = failures.insert(failures.end(), {labels, 0, {}, {"contact", 0, {}}});
    add_trial(*found, layout, trial);
  }
  for (CombinationFailures& one : failures) sort_by_frequency(one.causes);
  return failures;
}

void add_cause(std::vector<FailureCause>& causes, const FailureCause& cause) {
  auto found = std::find_if(causes.begin(), causes.end(), [&](const auto& one) { return one.cause == cause.cause; });
  if (found == causes.end()) found = causes.insert(causes.end(), {cause.cause, 0, {}});
  found->robots += cause.robots;
}

std::string cause_words(std::vector<FailureCause> causes) {
  sort_by_frequency(causes);
  std::string words;
  for (const FailureCause& cause : causes)
    if (cause.robots > 0) words += (words.empty() ? "" : ", ") + std::to_string(cause.robots) + " " + cause.cause;
  return words;
}

std::string failures_line(std::span<const CombinationFailures> failures) {
  std::vector<FailureCause> causes;
  std::uint32_t robots = 0;
  for (const CombinationFailures& one : failures)
    for (const FailureCause& cause : one.causes) {
      add_cause(causes, cause);
      robots += cause.robots;
    }
  return robots == 0 ? "" : std::to_string(robots) + " did not arrive: " + cause_words(causes);
}

}  // namespace dmrp::host
