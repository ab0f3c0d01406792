// SPDX-License-Identifier: MIT
#include "host/verify/trial_differences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "host/results/csv.hpp"

namespace dmrp::host {

namespace {

std::string shown(const std::optional<double>& value) {
  return value ? shortest_number(*value) : "undefined";
}

// "path_length of robot 2 at 0.5"
std::string name_of(const MetricValue& value) {
  std::string name = value.metric;
  if (value.subject_kind != DMRP_SUBJECT_SYSTEM)
    name += fmt::format(" of {}", subject_kind_names.at(value.subject_kind));
  if (value.subject) name += fmt::format(" {}", *value.subject);
  if (value.coordinate) name += " at " + shortest_number(*value.coordinate);
  return name;
}

// Each value's text by its name, without those of clocks. The shortest text that reads back as a number is its bits.
std::map<std::string, std::string> values_by_name(const TrialRecord& trial, std::span<const MetricColumn> metrics) {
  std::set<std::string> measured_by_clock;
  for (const MetricColumn& metric : metrics)
    if (metric.wall_clock) measured_by_clock.insert(metric.name);
  std::map<std::string, std::string> values;
  for (const MetricValue& value : trial.values)
    if (!measured_by_clock.contains(value.metric)) values[name_of(value)] = shown(value.value);
  return values;
}

std::string text_of(const MetricEvent& event) {
  std::string text =
      fmt::format("event of {} from {} to {} ns: {} (severity {}, robots {}, people {}", event.metric, event.from_ns,
                  event.to_ns, event.text, event.severity, fmt::join(event.robots, " "), fmt::join(event.people, " "));
  if (event.place) text += fmt::format(", at {}, {}", shortest_number(event.place->x), shortest_number(event.place->y));
  return text + ")";
}

std::multiset<std::string> event_texts(const TrialRecord& trial) {
  std::multiset<std::string> texts;
  for (const MetricEvent& event : trial.events) texts.insert(text_of(event));
  return texts;
}

std::multiset<std::string> fault_texts(const TrialRecord& trial) {
  std::multiset<std::string> texts;
  for (const FaultRecord& fault : trial.faults)
    texts.insert(fmt::format("fault {} in {} {}(): {}", fault.kind, fault.plugin, fault.function, fault.detail));
  return texts;
}

void compare_sets(std::vector<std::string>& out, const std::multiset<std::string>& before,
                  const std::multiset<std::string>& now) {
  std::vector<std::string> only;
  std::set_difference(before.begin(), before.end(), now.begin(), now.end(), std::back_inserter(only));
  for (const std::string& text : only) out.push_back(text + " is missing");
  only.clear();
  std::set_difference(now.begin(), now.end(), before.begin(), before.end(), std::back_inserter(only));
  for (const std::string& text : only) out.push_back(text + " is new");
}

void compare_texts(std::vector<std::string>& out, const std::string& what, const std::string& before,
                   const std::string& now) {
  if (before != now) out.push_back(fmt::format("{} is {}, was {}", what, now, before));
}

}  // namespace

std::vector<std::string> trial_differences(const TrialRecord& before, const TrialRecord& now,
                                           std::span<const MetricColumn> metrics) {
  std::vector<std::string> out;
  compare_texts(out, "the seed", std::to_string(before.seed), std::to_string(now.seed));
  compare_texts(out, "the outcome", before.outcome, now.outcome);
  compare_texts(out, "the simulated time in s", shortest_number(before.sim_time_s), shortest_number(now.sim_time_s));
  const auto values_before = values_by_name(before, metrics);
  const auto values_now = values_by_name(now, metrics);
  for (const auto& [name, value] : values_before) {
    const auto other = values_now.find(name);
    compare_texts(out, name, value, other == values_now.end() ? "missing" : other->second);
  }
  for (const auto& [name, value] : values_now)
    if (!values_before.contains(name)) compare_texts(out, name, "missing", value);
  compare_sets(out, event_texts(before), event_texts(now));
  compare_sets(out, fault_texts(before), fault_texts(now));
  return out;
}

}  // namespace dmrp::host
