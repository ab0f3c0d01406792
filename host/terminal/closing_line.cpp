// SPDX-License-Identifier: MIT
#include "host/terminal/closing_line.hpp"

#include <dmrp/descriptor.h>

#include <cmath>
#include <cstdint>
#include <optional>

#include "host/ranking/failure_causes.hpp"
#include "host/terminal/wrapped_text.hpp"

namespace dmrp::host {
namespace {

std::string counted(std::uint64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace

std::string drawn_tasks_line(std::span<const ScenarioFacts> scenarios) {
  std::string line;
  for (std::size_t i = 0; i < scenarios.size(); ++i) {
    const ScenarioFacts& facts = scenarios[i];
    if (!facts.tasks_drawn) continue;
    const bool goes_on = i > 0 && scenarios[i - 1].tasks_drawn && scenarios[i - 1].name == facts.name;
    const bool ends = i + 1 == scenarios.size() || !scenarios[i + 1].tasks_drawn || scenarios[i + 1].name != facts.name;
    line += goes_on ? ", " : (line.empty() ? "drawn tasks: " : "; ") + facts.name + " with ";
    line += std::to_string(facts.robots);
    if (ends) line += facts.robots == 1 ? " robot" : " robots";
  }
  return line;
}

std::string closing_line(const SummaryLayout& layout, std::span<const TrialRecord> trials) {
  std::uint64_t robots = 0;
  std::uint64_t arrived = 0;
  std::uint64_t excluded = 0;
  bool arrival_measured = false;
  std::uint64_t faults = 0;
  std::uint64_t skipped = 0;
  std::uint64_t unsupported = 0;
  std::uint64_t not_repeatable = 0;
  std::optional<double> contacts;
  for (const TrialRecord& trial : trials) {
    if (trial.outcome == trial_outcome::unsupported) {
      ++unsupported;
      continue;
    }
    faults += trial.faults.size();
    if (trial.outcome == trial_outcome::skipped) {
      ++skipped;
      continue;
    }
    robots += trial.robots;
    excluded += excluded_robots(layout.arrived, trial);
    if (!trial.repeatable) ++not_repeatable;
    for (const MetricValue& value : trial.values) {
      if (value.metric != layout.arrived || value.subject_kind != DMRP_SUBJECT_ROBOT || value.coordinate) continue;
      arrival_measured = true;
      if (value.value && *value.value == 1.0) ++arrived;
    }
    if (const std::optional<double> count = system_value(trial, layout.contacts))
      contacts = contacts.value_or(0.0) + *count;
  }

  std::string line;
  if (arrival_measured && robots > 0) {
    line += std::to_string(arrived + excluded) + " of " + counted(robots, "robot") + " arrived";
    if (excluded > 0)
      line += "; " + std::to_string(excluded) + (excluded == 1 ? " of them is" : " of them are") +
              " excluded for oscillation";
    line += separator;
  }
  if (contacts) line += counted(static_cast<std::uint64_t>(std::llround(*contacts)), "contact") + separator;
  line += counted(faults, "fault") + separator;
  if (unsupported > 0) line += counted(unsupported, "trial") + " unsupported" + separator;
  if (skipped > 0) line += counted(skipped, "trial") + " skipped" + separator;
  line += not_repeatable == 0 ? "repeatable" : counted(not_repeatable, "trial") + " not repeatable";
  return line;
}

std::string files_line(const std::filesystem::path& run_directory, std::span<const std::string> files) {
  std::string line = run_directory.string() + " ";
  for (const std::string& file : files) line += "  " + file;
  return line;
}

}  // namespace dmrp::host
