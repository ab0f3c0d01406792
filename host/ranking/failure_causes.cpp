// SPDX-License-Identifier: MIT
#include "host/ranking/failure_causes.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace dmrp::host {
namespace {

FailureCause& found_or_added(std::vector<FailureCause>& causes, const std::string& cause) {
  const auto found =
      std::find_if(causes.begin(), causes.end(), [&](const FailureCause& one) { return one.cause == cause; });
  return found != causes.end() ? *found : causes.emplace_back(FailureCause{cause});
}

void count(FailureCause& cause, std::uint32_t robots, std::uint64_t trial) {
  cause.robots += robots;
  if (cause.trials.empty() || cause.trials.back() != trial) cause.trials.push_back(trial);
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

// The robots with such a value of a metric, ascending.
template <class Wanted>
std::vector<std::uint64_t> robots_with(const TrialRecord& trial, const std::string& metric, Wanted wanted) {
  std::vector<std::uint64_t> robots;
  for (const MetricValue& value : trial.values)
    if (value.subject_kind == DMRP_SUBJECT_ROBOT && !value.coordinate && value.metric == metric && value.subject &&
        value.value && wanted(*value.value))
      robots.push_back(*value.subject);
  std::sort(robots.begin(), robots.end());
  return robots;
}

bool is_yes(double value) {
  return value == 1.0;
}

bool is_no(double value) {
  return value == 0.0;
}

void add_trial(CombinationFailures& failures, const SummaryLayout& layout, const TrialRecord& trial) {
  failures.robots += trial.robots;
  if (trial.outcome == trial_outcome::fault)
    return count(found_or_added(failures.causes, "fault"), trial.robots, trial.id);
  const auto in_contact = robots_with(trial, layout.at_fault, [](double contacts) { return contacts > 0.0; });
  std::set<std::pair<std::string, std::uint32_t>> roots;  // by cause
  for (const MetricEvent& event : trial.events) {
    if (event.metric != layout.arrived) continue;
    FailureCause& cause = found_or_added(failures.causes, cause_of(event));
    count(cause, 1, trial.id);
    if (!event.robots.empty() && std::binary_search(in_contact.begin(), in_contact.end(), event.robots[0]))
      ++cause.after_contact;
    if (event.robots.size() > 1 && roots.emplace(cause.cause, event.robots[1]).second) ++cause.roots;
  }
  if (layout.answer.safe.empty()) return;
  const auto arrived = robots_with(trial, layout.arrived, is_yes);
  for (const std::uint64_t robot : robots_with(trial, layout.answer.safe, is_no))
    if (std::binary_search(arrived.begin(), arrived.end(), robot)) count(failures.contact, 1, trial.id);
}

}  // namespace

std::vector<CombinationFailures> failure_causes(const SummaryLayout& layout, std::span<const TrialRecord> trials) {
  std::vector<CombinationFailures> failures;
  for (const TrialRecord& trial : trials) {
    if (trial.robots == 0 || !has_result(trial)) continue;
    const CombinationLabels labels = combination_of(trial);
    auto found = std::find_if(failures.begin(), failures.end(),
                              [&](const CombinationFailures& one) { return one.combination == labels; });
    if (found == failures.end()) found = failures.insert(failures.end(), {labels, 0, {}, {"contact"}});
    add_trial(*found, layout, trial);
  }
  for (CombinationFailures& one : failures) sort_by_frequency(one.causes);
  return failures;
}

bool is_exclusion(std::string_view cause) {
  return cause.starts_with("excluded for ");
}

std::uint32_t excluded_robots(const std::string& arrived, const TrialRecord& trial) {
  return static_cast<std::uint32_t>(
      std::count_if(trial.events.begin(), trial.events.end(),
                    [&](const MetricEvent& one) { return one.metric == arrived && is_exclusion(cause_of(one)); }));
}

void add_cause(std::vector<FailureCause>& causes, const FailureCause& cause) {
  FailureCause& sum = found_or_added(causes, cause.cause);
  sum.robots += cause.robots;
  sum.after_contact += cause.after_contact;
  sum.roots += cause.roots;
}

std::string cause_words(std::vector<FailureCause> causes) {
  sort_by_frequency(causes);
  std::string words;
  for (const FailureCause& cause : causes) {
    if (cause.robots == 0) continue;
    words += (words.empty() ? "" : ", ") + std::to_string(cause.robots) + " " + cause.cause;
    std::string more =
        cause.roots > 0 ? "by " + std::to_string(cause.roots) + (cause.roots == 1 ? " robot" : " robots") : "";
    if (cause.after_contact > 0)
      more += (more.empty() ? "" : "; ") + std::to_string(cause.after_contact) + " after a contact";
    if (!more.empty()) words += " (" + more + ")";
  }
  return words;
}

std::string failures_line(std::span<const CombinationFailures> failures) {
  std::vector<FailureCause> causes;
  std::uint32_t robots = 0;
  for (const CombinationFailures& one : failures)
    for (const FailureCause& cause : one.causes) {
      if (is_exclusion(cause.cause)) continue;
      add_cause(causes, cause);
      robots += cause.robots;
    }
  return robots == 0 ? "" : std::to_string(robots) + " did not arrive: " + cause_words(causes);
}

std::string standstills_line(const SummaryLayout& layout, std::span<const TrialRecord> trials) {
  std::size_t arrived = 0;
  std::size_t robots = 0;
  for (const TrialRecord& trial : trials) {
    const std::size_t after_all = robots_with(trial, layout.after_standstill, is_yes).size();
    arrived += after_all;
    robots += after_all + robots_with(trial, layout.after_standstill, is_no).size();
  }
  if (robots == 0) return "";
  return "Of " + std::to_string(robots) + (robots == 1 ? " robot" : " robots") +
         " at standstills that ran on to the time limit, " + std::to_string(arrived) + " arrived after all";
}

}  // namespace dmrp::host
